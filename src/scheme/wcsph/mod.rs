//! Weakly compressible δ-SPH (Huang et al. 2019, Eqs. 1-7).
//!
//! A step is symplectic Euler in two halves, so that the caller can find the motion of walls in
//! between. [`Wcsph::prepare`] finds forces at the old places. [`Wcsph::finish`] kicks the
//! velocities, finds the density rates with the new velocities at the old places, and drifts.
//!
//! Of every `acoustic_substeps` steps only the first is full. The others follow the sound alone:
//! new pressures and velocities over pairs with held geometry and corrections. Their forces are
//! found at the end of the step before, together with its densities and places.

mod acoustic;
mod balance;
mod continuity;
mod contract;
mod correction;
mod diffusion;
mod laminar;
mod lists;
mod momentum;
mod motion;
mod options;
mod outflow;
mod pack;
mod passes;
mod pressing;
mod response;
mod shifting;
mod state;
mod step;
mod support;
mod tension;
mod viscosity;
mod volume;

pub use crate::pairs::Precision;
pub use options::{DensityDiffusion, Shifting, WcsphOptions};
pub use state::{Wcsph, WcsphState};

use serde::{Deserialize, Serialize};

use crate::boundary::Water;
use crate::pairs::{Double, Here, Record, Tally};
use momentum::FOUND;

/// Data that one step hands to the next, besides the fluid itself; one entry per (padded) particle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Carried {
    /// The kernel gradient's correction, xx, xy, yy.
    correction_xx: Vec<f64>,
    correction_xy: Vec<f64>,
    correction_yy: Vec<f64>,
    /// Share of a negative pressure that acts.
    tension: Vec<f64>,
    /// Accelerations of the step before a full one.
    last_acceleration_x: Vec<f64>,
    last_acceleration_y: Vec<f64>,
    density_rate: Vec<f64>,
    /// tr (∇u)², 1/s²: see [`continuity::Continuity`].
    turning: Vec<f64>,
    /// The correction as it was found last, xx, xy, yy, where the correction is extrapolated; empty
    /// before.
    found_correction: [Vec<f64>; 3],
}

impl Carried {
    fn correction(&self) -> [&[f64]; 3] {
        [&self.correction_xx, &self.correction_xy, &self.correction_yy]
    }

    /// All fields in use, for a change of order.
    fn all_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let [xx, xy, yy] =
            [&mut self.correction_xx, &mut self.correction_xy, &mut self.correction_yy];
        let [x, y] = [&mut self.last_acceleration_x, &mut self.last_acceleration_y];
        let always =
            [xx, xy, yy, &mut self.tension, x, y, &mut self.density_rate, &mut self.turning];
        let found = self.found_correction.iter_mut().filter(|field| !field.is_empty());
        always.into_iter().chain(found)
    }
}

/// Arrays that steps fill, one entry per (padded) fluid particle.
#[derive(Debug, Clone, Default)]
struct Workspace {
    carried: Carried,
    /// x over R.
    scaled_x: Vec<f64>,
    /// y over R.
    scaled_y: Vec<f64>,
    pressure: Vec<f64>,
    acceleration_x: Vec<f64>,
    acceleration_y: Vec<f64>,
    /// 1/ρ of the last full step.
    inverse_density: Vec<f64>,
    /// Share of each particle in the density diffusion.
    diffused_share: Vec<f64>,
    /// Σ g times the neighbours' shares, from the last full step.
    shares: Vec<f64>,
    /// R ∇ρ.
    gradient_x: Vec<f64>,
    gradient_y: Vec<f64>,
    /// Σ g Δ = ∇C.
    concentration_x: Vec<f64>,
    concentration_y: Vec<f64>,
    /// Smallest eigenvalue of Σ V (x_j - x_i) ⊗ ∇W: 1 inside, less near the surface.
    completeness: Vec<f64>,
    /// The kernel gradient's correction of the next step, xx, xy, yy.
    next_correction_xx: Vec<f64>,
    next_correction_xy: Vec<f64>,
    next_correction_yy: Vec<f64>,
    /// Volume per second that the particles give to the ghosts of the bed, m²/s.
    given: Vec<f64>,
    /// Per body: force on it along x, N/m, and its added mass, kg/m.
    loads: Vec<[f64; 2]>,
    /// The viscous part of the force, which acoustic steps hold.
    held_loads: Vec<f64>,
}

impl Workspace {
    fn new(padded: usize, bodies: usize) -> Workspace {
        let zeros = || vec![0.0; padded];
        Workspace {
            carried: Carried {
                correction_xx: vec![1.0; padded],
                correction_xy: zeros(),
                correction_yy: vec![1.0; padded],
                tension: vec![1.0; padded],
                last_acceleration_x: zeros(),
                last_acceleration_y: zeros(),
                density_rate: zeros(),
                turning: zeros(),
                found_correction: Default::default(),
            },
            scaled_x: zeros(),
            scaled_y: zeros(),
            pressure: zeros(),
            acceleration_x: zeros(),
            acceleration_y: zeros(),
            inverse_density: zeros(),
            diffused_share: zeros(),
            shares: zeros(),
            gradient_x: zeros(),
            gradient_y: zeros(),
            concentration_x: zeros(),
            concentration_y: zeros(),
            completeness: vec![1.0; padded],
            next_correction_xx: vec![1.0; padded],
            next_correction_xy: zeros(),
            next_correction_yy: vec![1.0; padded],
            given: zeros(),
            loads: vec![[0.0; 2]; bodies],
            held_loads: vec![0.0; bodies],
        }
    }

    /// The data of the water that the ghosts read.
    fn water<'a>(&'a self, records: &'a [Record], corrected: bool) -> Water<'a> {
        let correction = corrected.then(|| self.carried.correction());
        let acceleration = [&*self.carried.last_acceleration_x, &self.carried.last_acceleration_y];
        Water { records, pressure: &self.pressure, correction, acceleration }
    }

    /// The kernel gradient's correction: xx, xy, yy.
    #[inline(always)]
    fn correction<D: Double>(&self, here: Here) -> [D; 3] {
        here.all(self.carried.correction())
    }

    /// The fields that the pass of a full step writes and does not read.
    fn found_mut(&mut self) -> [&mut Vec<f64>; FOUND] {
        [
            &mut self.inverse_density,
            &mut self.acceleration_x,
            &mut self.acceleration_y,
            &mut self.gradient_x,
            &mut self.gradient_y,
            &mut self.concentration_x,
            &mut self.concentration_y,
            &mut self.completeness,
            &mut self.next_correction_xx,
            &mut self.next_correction_xy,
            &mut self.next_correction_yy,
        ]
    }

    fn acceleration_mut(&mut self) -> [&mut Vec<f64>; 2] {
        [&mut self.acceleration_x, &mut self.acceleration_y]
    }

    /// Adds loads on bodies, in the order of the particles.
    fn add_loads<'a>(&mut self, tallies: impl Iterator<Item = &'a Tally>) {
        for &(body, [force, viscous, added_mass]) in tallies.flat_map(|tally| &tally.loads) {
            self.loads[body][0] += force;
            self.loads[body][1] += added_mass;
            self.held_loads[body] += viscous;
        }
    }
}
