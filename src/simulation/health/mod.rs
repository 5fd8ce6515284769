//! Stops an unstable run early, with the reason, the time and the particle. Also records how close
//! a healthy run came to each bound.

mod bounds;
mod crowding;

pub use bounds::{HealthBounds, LASTING_GAP};
pub use crowding::Crowding;

use serde::{Deserialize, Serialize};

use super::failure::{Failure, FailureKind};
use crate::pairs::Fluid;

/// Particles closer than this, over the spacing, count as clustered.
const CLUSTERED: f64 = 0.25;
/// The force gap is a mean over about this many looks.
const GAP_MEMORY: f64 = 10.0;

/// The largest share of each bound that a run has reached; 1 is at the bound.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct HealthMargins {
    /// Of the speed.
    pub speed: f64,
    /// Of the change of density.
    pub density: f64,
    /// Of the particles outside.
    pub lost: f64,
    /// Of the particles clustered.
    pub clustered: f64,
    /// Of the mean force gap.
    pub force_gap: f64,
    /// Of the energy from nowhere.
    pub energy: f64,
}

impl HealthMargins {
    /// The share of the bound that came closest, and its name.
    pub fn closest(&self) -> (f64, &'static str) {
        let all = [
            (self.speed, "speed"),
            (self.density, "density"),
            (self.lost, "particles lost"),
            (self.clustered, "clustering"),
            (self.force_gap, "force gap"),
            (self.energy, "energy growth"),
        ];
        all.into_iter().fold((0.0, "none"), |best, one| if one.0 > best.0 { one } else { best })
    }
}

/// Health data of a run, from the start to the end.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct HealthState {
    /// How close it came to each bound.
    pub margins: HealthMargins,
    /// Largest number of particles seen outside.
    pub lost: u32,
    mean_gap: f64,
}

/// The data of one check, besides the particles.
#[derive(Debug, Clone, Copy)]
pub struct Vitals {
    /// Simulated time, seconds.
    pub time_s: f64,
    /// Toes of paddle and wall, bed, top of the walls, metres.
    pub extent: [f64; 4],
    /// Gain of the right wall's x per height; 0 for a vertical wall.
    pub lean: f64,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// Work done on the water less all other terms of the budget, J per metre of width.
    pub energy_residual: f64,
    /// That work.
    pub work: f64,
    /// Whether to look for clusters too: the most expensive part.
    pub clusters: bool,
}

impl HealthState {
    /// Takes a reading of the force gap, relative to the larger of the force and the hydrostatic
    /// one.
    pub fn see_gap(&mut self, gap: f64) {
        self.mean_gap += (gap - self.mean_gap) / GAP_MEMORY;
    }

    /// The largest mean force gap at any check.
    pub fn largest_gap(&self, bounds: &HealthBounds) -> f64 {
        self.margins.force_gap * bounds.force_gap
    }

    /// Checks the water.
    pub fn check(
        &mut self,
        bounds: &HealthBounds,
        fluid: &Fluid,
        vitals: &Vitals,
        crowding: &mut Crowding,
    ) -> Result<(), Failure> {
        let time_s = vitals.time_s;
        let fail = |kind, detail| Err(Failure { kind, time_s, detail });
        self.check_particles(bounds, fluid, vitals)?;
        if vitals.clusters {
            let (share, particle) = crowding.look(fluid, CLUSTERED * vitals.spacing);
            if is_past(&mut self.margins.clustered, share, bounds.clustered_share) {
                let detail = format!(
                    "{:.0} % of the particles are closer than {CLUSTERED} of the spacing, bound \
                     {:.0} %, the closest {}",
                    100.0 * share,
                    100.0 * bounds.clustered_share,
                    place(fluid, particle)
                );
                return fail(FailureKind::Clustering, detail);
            }
        }
        if is_past(&mut self.margins.force_gap, self.mean_gap, bounds.force_gap) {
            let detail = format!(
                "the pressure on the wall's face is {:.0} % off the force, bound {:.0} %",
                100.0 * self.mean_gap,
                100.0 * bounds.force_gap
            );
            return fail(FailureKind::ForceGap, detail);
        }
        let found = -vitals.energy_residual;
        let allowed = bounds.energy_floor + bounds.energy_growth * vitals.work.abs();
        if is_past(&mut self.margins.energy, found, allowed) {
            let fastest =
                (0..fluid.len()).max_by(|&a, &b| speed(fluid, a).total_cmp(&speed(fluid, b)));
            let detail = format!(
                "{found:.2} J/m have come from nowhere, bound {allowed:.2} J/m, the fastest {}",
                place(fluid, fastest.unwrap_or(0))
            );
            return fail(FailureKind::EnergyGrowth, detail);
        }
        Ok(())
    }

    /// Speed, density and place of every particle.
    fn check_particles(
        &mut self,
        bounds: &HealthBounds,
        fluid: &Fluid,
        vitals: &Vitals,
    ) -> Result<(), Failure> {
        let fail = |kind, detail| Err(Failure { kind, time_s: vitals.time_s, detail });
        let [left, right, bottom, top] = vitals.extent;
        let mut outside = 0_u32;
        // A particle that is clearly slower than the fastest so far needs no exact speed.
        let slow = |margin: f64| (0.999_999 * margin * bounds.speed).powi(2);
        let mut floor = slow(self.margins.speed);
        for k in 0..fluid.len() {
            let (x, y, density) = (fluid.x[k], fluid.y[k], fluid.density[k]);
            let square = fluid.vx[k] * fluid.vx[k] + fluid.vy[k] * fluid.vy[k];
            let speed = if square < floor { 0.0 } else { speed(fluid, k) };
            if !(speed.is_finite() && density.is_finite() && x.is_finite() && y.is_finite()) {
                return fail(FailureKind::NotANumber, place(fluid, k));
            }
            if speed / bounds.speed > self.margins.speed {
                self.margins.speed = speed / bounds.speed;
                floor = slow(self.margins.speed);
            }
            if speed > bounds.speed {
                let (at, bound) = (place(fluid, k), bounds.speed);
                let detail = format!("{at} moves at {speed:.2} m/s, bound {bound:.2} m/s");
                return fail(FailureKind::RunawaySpeed, detail);
            }
            let change = match bounds.surface_density {
                0.0 => 0.0,
                surface => density / surface - 1.0,
            };
            if is_past(&mut self.margins.density, change.abs(), bounds.density_change) {
                let detail = format!(
                    "{} is compressed by {:.2} %, bound {:.2} %",
                    place(fluid, k),
                    100.0 * change,
                    100.0 * bounds.density_change
                );
                return fail(FailureKind::DensityOutOfBounds, detail);
            }
            outside += u32::from(x < left || x > right + vitals.lean * y || y < bottom || y > top);
        }
        self.lost = self.lost.max(outside);
        let allowed = bounds.lost_share * fluid.len() as f64;
        if is_past(&mut self.margins.lost, f64::from(outside), allowed) {
            let detail = format!("{outside} of {} particles have left the tank", fluid.len());
            return fail(FailureKind::ParticlesLost, detail);
        }
        Ok(())
    }
}

/// Records the share of a bound that a value reaches. Returns whether the value is above the bound.
fn is_past(margin: &mut f64, value: f64, bound: f64) -> bool {
    *margin = margin.max(value / bound);
    value > bound
}

fn speed(fluid: &Fluid, k: usize) -> f64 {
    fluid.vx[k].hypot(fluid.vy[k])
}

fn place(fluid: &Fluid, k: usize) -> String {
    format!("particle {} at x = {:.4} m, y = {:.4} m", fluid.id[k], fluid.x[k], fluid.y[k])
}

#[cfg(test)]
mod tests;
