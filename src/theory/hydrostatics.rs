//! Water at rest under a linear, weakly compressible state equation.

/// A still column of depth h with p = c0² (ρ - ρ_s).
///
/// ρ(y) = ρ_s e^{g (h - y)/c0²} balances gravity exactly. With the surface density ρ_s = ρ0 x²/(2
/// (eˣ - 1 - x)), x = g h/c0², the force of the column on its wall is exactly ρ0 g h²/2. The column
/// then weighs x/6 more than ρ0 g h. With the exact weight, the force would be x/6 too small: 0.26
/// % at c0 = 8 √(g h).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StillColumn {
    /// ρ_s, kg/m³.
    pub surface_density: f64,
    depth: f64,
    gravity: f64,
    sound_speed: f64,
}

impl StillColumn {
    /// A column of depth h (m) in place of incompressible water of density ρ0 (kg/m³), with gravity
    /// (m/s²) and c0 (m/s).
    pub fn new(depth: f64, density: f64, gravity: f64, sound_speed: f64) -> StillColumn {
        let x = gravity * depth / (sound_speed * sound_speed);
        StillColumn { surface_density: density / force_excess(x), depth, gravity, sound_speed }
    }

    /// ρ at the height y above the bed, kg/m³.
    pub fn density(&self, y: f64) -> f64 {
        let c = self.sound_speed;
        self.surface_density * libm::exp(self.gravity * (self.depth - y) / (c * c))
    }
}

/// 2 (eˣ - 1 - x)/x²: the force of a column with ρ_s = ρ0 over ρ0 g h²/2.
fn force_excess(x: f64) -> f64 {
    if x < 1e-4 {
        // The difference would lose its digits.
        return 1.0 + x / 3.0 + x * x / 12.0;
    }
    2.0 * (libm::expm1(x) - x) / (x * x)
}

/// Hydrostatic force on a vertical wall, ρ0 g h²/2, N per metre of width.
pub fn wall_force(depth: f64, density: f64, gravity: f64) -> f64 {
    0.5 * density * gravity * depth * depth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_column_presses_as_it_should_and_is_in_balance() {
        let (h, rho, g) = (0.2, 1000.0, 9.81);
        for c in [4.0, 11.0, 14.0, 90.0, 2000.0] {
            let column = StillColumn::new(h, rho, g, c);
            let pressure = |y: f64| c * c * (column.density(y) - column.surface_density);
            let n = 20_000;
            let dy = h / f64::from(n);
            let middles = (0..n).map(|k| (f64::from(k) + 0.5) * dy);
            let [mut force, mut mass] = [0.0; 2];
            for y in middles {
                force += pressure(y) * dy;
                mass += column.density(y) * dy;
            }
            let exact = wall_force(h, rho, g);
            assert!((force - exact).abs() < 1e-8 * exact, "{force} at {c}");
            let x = g * h / (c * c);
            assert!((mass / (rho * h) - 1.0 - x / 6.0).abs() < 0.05 * x * x + 1e-9);
            assert!((column.density(h) - column.surface_density).abs() < 1e-9);
        }
        let c = 14.0;
        let column = StillColumn::new(h, rho, g, c);
        let pressure = |y: f64| c * c * (column.density(y) - column.surface_density);
        for y in [0.01, 0.1, 0.19] {
            let gradient = (pressure(y + 1e-5) - pressure(y - 1e-5)) / 2e-5;
            assert!((gradient + column.density(y) * g).abs() < 1e-3);
        }
    }
}
