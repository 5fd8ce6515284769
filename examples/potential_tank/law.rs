//! The seawall's law: m a = s max(F - F_th, 0) - k X with F = F0 - A a, X ≥ 0.

/// Density of water, kg/m³.
pub const DENSITY: f64 = 1000.0;
/// Gravity, m/s².
pub const GRAVITY: f64 = 9.81;
/// Still depth h, metres.
pub const DEPTH: f64 = 0.2;
/// Length of the tank at rest, metres.
pub const LENGTH: f64 = 2.5;
/// F_th over the hydrostatic force.
pub const THRESHOLD: f64 = 1.1;

/// ρ g h²/2, N per metre of width.
pub const STATIC_FORCE: f64 = 0.5 * DENSITY * GRAVITY * DEPTH * DEPTH;

/// Mass and spring of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// m, kg per metre of width.
    pub mass: f64,
    /// k, N/m per metre of width.
    pub stiffness: f64,
}

impl Spring {
    /// Acceleration at displacement X (m) under F = `force` - `added_mass` a. Both branches of the
    /// law are tried in turn; it is monotone in a, so exactly one is consistent with its force.
    /// A wall `on_stop` is not pulled inwards.
    pub fn acceleration(&self, x: f64, on_stop: bool, force: f64, added_mass: f64) -> f64 {
        let excess = force - THRESHOLD * STATIC_FORCE;
        let driven = (excess - self.stiffness * x) / (self.mass + added_mass);
        let a = if excess - added_mass * driven > 0.0 {
            driven
        } else {
            -self.stiffness * x / self.mass
        };
        if on_stop { a.max(0.0) } else { a }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_branch_fits_the_force_it_leads_to() {
        let threshold = THRESHOLD * STATIC_FORCE;
        let wall = Spring { mass: 2.0, stiffness: 8.0 };
        for (x, force) in [(0.0, 50.0), (0.1, -1.0), (0.1, -0.1), (0.1, 0.3), (0.4, 3.0)] {
            let a = wall.acceleration(x, false, threshold + force, 5.0);
            let felt = force - 5.0 * a;
            assert!((wall.mass * a - (felt.max(0.0) - wall.stiffness * x)).abs() < 1e-12);
        }
        assert_eq!(wall.acceleration(0.0, true, threshold - 1.0, 5.0), 0.0);
    }
}
