//! Stops a sick run early, with the reason, the time and the particle.

use super::failure::{Failure, FailureKind};
use crate::particles::Fluid;

/// Bounds that a healthy run keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HealthBounds {
    /// m/s.
    pub speed: f64,
    /// Largest |ρ/ρ_s - 1|.
    pub density_change: f64,
    /// ρ_s, kg/m³.
    pub surface_density: f64,
    /// Share of particles that may leave the tank.
    pub lost_share: f64,
}

impl HealthBounds {
    /// Checks the water between the faces `left` and `right`, from the bed up to `top`; returns
    /// the number of particles outside.
    ///
    /// # Errors
    /// The first bound that is broken.
    pub fn check(
        &self,
        fluid: &Fluid,
        time_s: f64,
        [left, right, top]: [f64; 3],
    ) -> Result<u32, Failure> {
        let fail = |kind, detail| Err(Failure { kind, time_s, detail });
        let mut lost = 0_u32;
        for k in 0..fluid.len() {
            let (x, y, density) = (fluid.x[k], fluid.y[k], fluid.density[k]);
            let speed = fluid.vx[k].hypot(fluid.vy[k]);
            let at = || format!("particle {} at x = {x:.4} m, y = {y:.4} m", fluid.id[k]);
            if !(speed.is_finite() && density.is_finite() && x.is_finite() && y.is_finite()) {
                return fail(FailureKind::NotANumber, at());
            }
            if speed > self.speed {
                let bound = self.speed;
                let detail = format!("{} moves at {speed:.2} m/s, bound {bound:.2} m/s", at());
                return fail(FailureKind::RunawaySpeed, detail);
            }
            let change = density / self.surface_density - 1.0;
            if change.abs() > self.density_change {
                let detail = format!(
                    "{} is compressed by {:.2} %, bound {:.2} %",
                    at(),
                    100.0 * change,
                    100.0 * self.density_change
                );
                return fail(FailureKind::DensityOutOfBounds, detail);
            }
            if x < left || x > right || y < 0.0 || y > top {
                lost += 1;
            }
        }
        if f64::from(lost) > self.lost_share * fluid.len() as f64 {
            let detail = format!("{lost} of {} particles have left the tank", fluid.len());
            return fail(FailureKind::ParticlesLost, detail);
        }
        Ok(lost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: HealthBounds =
        HealthBounds { speed: 3.0, density_change: 0.1, surface_density: 1000.0, lost_share: 0.3 };

    fn check(spoil: impl Fn(&mut Fluid)) -> Result<u32, FailureKind> {
        let points = (0..10).map(|k| [0.1 * f64::from(k) + 0.05, 0.1, 1000.0, 1.0]);
        let mut fluid = Fluid::at_rest(points);
        spoil(&mut fluid);
        BOUNDS.check(&fluid, 1.0, [0.0, 1.0, 1.0]).map_err(|failure| failure.kind)
    }

    #[test]
    fn each_bound_has_its_reason() {
        assert_eq!(check(|_| ()), Ok(0));
        assert_eq!(check(|f| f.x[3] = -0.1), Ok(1));
        assert_eq!(check(|f| f.vx[3] = f64::NAN), Err(FailureKind::NotANumber));
        assert_eq!(check(|f| f.vy[3] = -4.0), Err(FailureKind::RunawaySpeed));
        assert_eq!(check(|f| f.density[3] = 1200.0), Err(FailureKind::DensityOutOfBounds));
        assert_eq!(check(|f| f.y[..5].fill(-1.0)), Err(FailureKind::ParticlesLost));
    }
}
