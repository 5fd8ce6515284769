//! The spring-mounted seawall of Liang et al. 2017, Eqs. 16-18 (Huang et al. 2019, Eqs. 26-28).

mod held;
mod kick;

use serde::{Deserialize, Serialize};

use super::{Restraint, WallLaw, WallState, WallStep};

/// m a = s · max(F - F_th, 0) - k X, with X ≥ 0.
///
/// One continuous law in place of the papers' two branches. F is the full force of the water per
/// metre of width, hydrostatics included. s is 1 in the law as printed. At the stop X = 0 and the
/// velocity is zero too (a perfectly inelastic stop). The water's reaction to the wall's
/// acceleration, F = F0 - A a, is solved together with a. So a wall stays stable even if it is
/// lighter than the water it moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SpringWall {
    /// m, kg per metre of width.
    pub mass: f64,
    /// k, N/m per metre of width.
    pub stiffness: f64,
    /// F_th, N per metre of width.
    pub threshold: f64,
    /// s.
    pub force_coupling: f64,
    /// X, metres.
    pub displacement: f64,
    /// V, m/s; with kicks the mean over the step before.
    pub velocity: f64,
    /// How often the wall came back onto its stop.
    pub stops: u32,
}

impl SpringWall {
    /// A wall at rest on its stop.
    pub fn at_rest(mass: f64, stiffness: f64, threshold: f64, force_coupling: f64) -> SpringWall {
        SpringWall {
            mass,
            stiffness,
            threshold,
            force_coupling,
            displacement: 0.0,
            velocity: 0.0,
            stops: 0,
        }
    }

    /// Comes onto the stop at this speed, m/s, and loses this energy there, J per metre of width.
    fn stop(&mut self, loss: f64, stop_speed: f64) -> WallStep {
        let travel = -self.displacement;
        self.displacement = 0.0;
        self.velocity = 0.0;
        self.stops += 1;
        WallStep { travel, stop_loss: loss, stop_speed, ..WallStep::default() }
    }
}

impl WallLaw for SpringWall {
    fn state(&self) -> Option<WallState> {
        let SpringWall { displacement, velocity, stops, .. } = *self;
        Some(WallState { displacement, velocity, stops })
    }

    fn lets_go(&self, force: f64) -> bool {
        force > self.threshold
    }

    fn rests(&self) -> bool {
        self.displacement == 0.0 && self.velocity == 0.0
    }

    fn has_moved(&self) -> bool {
        !self.rests() || self.stops > 0
    }

    fn kick(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        self.kicked(force, added_mass, dt)
    }

    fn advance(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        self.advanced(force, added_mass, dt)
    }

    fn driving(&self, force: f64, _: f64) -> f64 {
        self.force_coupling * (force - self.threshold).max(0.0)
    }

    /// ½ m V².
    fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }

    /// ½ k X².
    fn spring_energy(&self) -> f64 {
        0.5 * self.stiffness * self.displacement * self.displacement
    }

    fn restraint(&self) -> Option<Restraint> {
        let [mass, stiffness] = [self.mass, self.stiffness].map(|of| of / self.force_coupling);
        Some(Restraint { threshold: self.threshold, mass, stiffness })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn added_mass_slows_the_wall_and_keeps_the_balance() {
        let mut wall = SpringWall::at_rest(1.0, 0.0, 200.0, 1.0);
        let step = wall.advance(300.0, 9.0, 0.01);
        assert!((step.acceleration - 10.0).abs() < 1e-12);
        let felt = 300.0 - 9.0 * step.acceleration;
        assert!((wall.mass * step.acceleration - (felt - 200.0)).abs() < 1e-12);
    }

    /// The law for water that is kicked, and the law for water that is advanced.
    type Law = fn(&mut SpringWall, f64, f64, f64) -> WallStep;
    const LAWS: [Law; 2] = [SpringWall::kick, SpringWall::advance];

    #[test]
    fn the_acceleration_balances_the_force_that_it_leads_to() {
        // Well resolved, so that the spring pulls with k X.
        let from = SpringWall { displacement: 0.1, ..SpringWall::at_rest(2.0, 8.0, 200.0, 1.0) };
        for law in LAWS {
            for force in [195.0, 199.0, 201.0, 300.0] {
                let a = law(&mut { from }, force, 5.0, 1e-6).acceleration;
                let felt = force - 5.0 * a;
                assert!((2.0 * a - (felt - 200.0).max(0.0) + 0.8).abs() < 1e-6, "{force}");
            }
            let lone = law(&mut { from }, 195.0, 5.0, 1e-6).acceleration;
            assert!((lone + 0.4).abs() < 1e-6); // below the threshold only the spring acts
            let felt = 199.0 - 5.0 * law(&mut { from }, 199.0, 5.0, 1e-6).acceleration;
            assert!(felt > 200.0); // a returning wall may lift the force above the threshold
            let mut coupled = SpringWall::at_rest(10.0, 0.0, 200.0, 0.4);
            assert!((law(&mut coupled, 300.0, 0.0, 0.01).acceleration - 4.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_stop_takes_all_velocity_and_books_the_loss() {
        for (law, steps, off) in [(LAWS[0], 2000, 2e-3), (LAWS[1], 200, 1e-12)] {
            let mut wall =
                SpringWall { displacement: 0.3, ..SpringWall::at_rest(2.0, 8.0, 200.0, 1.0) };
            let dt = 2.0 / f64::from(steps);
            let loss: f64 = (0..steps).map(|_| law(&mut wall, 0.0, 0.0, dt).stop_loss).sum();
            assert_eq!((wall.displacement, wall.velocity, wall.stops), (0.0, 0.0, 1));
            let exact = 0.5 * 8.0 * 0.3 * 0.3; // all of the spring's energy
            assert!((loss - exact).abs() < off * exact, "{loss}");
        }
    }
}
