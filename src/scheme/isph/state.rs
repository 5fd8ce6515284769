//! The particles with all that surrounds them.

use serde::{Deserialize, Serialize};

use super::exact::Exact;
use super::images::Point;
use super::lattice::{Even, even_water};
use super::lists::{Near, Numbers};
use super::options::IsphOptions;
use super::system::System;
use crate::boundary::{Ghosts, Plane};
use crate::math::simd::SimdPath;
use crate::pairs::Fluid;
use crate::scheme::Load;

/// What the solver has done so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    pub steps: u64,
    pub solves: u64,
    pub iterations: u64,
    pub worst_residual: f64,
    pub pair_evaluations: u64,
    /// Largest root mean square of Δt ∇·u over a step's interior particles.
    pub worst_divergence: f64,
    /// Largest mean of |Σ V W - 1| over a step's interior particles.
    pub worst_volume_drift: f64,
}

/// Fields that one step hands to the next, besides the fluid itself.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Carried {
    /// Dynamic pressure of the last step, Pa, and of the one before.
    pub pressure: Vec<f64>,
    pub older_pressure: Vec<f64>,
    /// Divergence at mid-step that the last step aimed at, 1/s.
    pub aim: Vec<f64>,
    /// Response of the pressure to the wall's acceleration; empty until it was asked for.
    pub response: Vec<f64>,
}

/// What must be kept to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IsphState {
    pub(super) fluid: Fluid,
    pub(super) carried: Carried,
    pub(super) tally: Tally,
}

/// Operators at r*, one entry per fluid particle.
#[derive(Debug, Clone, Default)]
pub(super) struct Operators {
    /// Σ V W, itself included.
    pub coverage: Vec<f64>,
    /// Σ F.
    pub weight: Vec<f64>,
    /// s = Σ F Δ.
    pub sway: Vec<[f64; 2]>,
    /// Σ F ΔΔᵀ: xx, xy, yy.
    pub moment: Vec<[f64; 3]>,
    /// Its inverse, faded to the identity where it is near singular.
    pub correction: Vec<[f64; 3]>,
    /// Its smallest eigenvalue: 1 inside the water, 1/2 at a flat surface.
    pub completeness: Vec<f64>,
    /// Its surface: whether ∇·r < 1.5, and for those near it what the zero pressure adds to the
    /// diagonal.
    pub at_surface: Vec<bool>,
    pub grip: Vec<f64>,
}

impl Operators {
    /// κ_i = ½ tr (Σ F ΔΔᵀ)⁻¹, Schwaiger's (2008) normalisation of a support that is cut off, which
    /// takes the compact Laplacian to the size of the exact one; its bound below a completeness.
    pub fn kappa(&self, i: usize, least: f64) -> f64 {
        const FULLEST: f64 = 3.0;
        let [xx, xy, yy] = self.moment[i];
        let determinant = xx * yy - xy * xy;
        if determinant > 0.0 && self.completeness[i] > least {
            (0.5 * (xx + yy) / determinant).clamp(1.0 / FULLEST, FULLEST)
        } else {
            FULLEST
        }
    }

    /// By how much the water around a particle is too dense: Σ V W over its value in even water. Zero
    /// near the surface.
    pub fn crowding(&self, i: usize, even: &Even) -> f64 {
        const INSIDE: f64 = 0.9;
        let counts = self.completeness[i] > INSIDE && self.grip[i] == 0.0;
        if counts { self.coverage[i] - even.coverage } else { 0.0 }
    }
}

/// ISPH particles with their walls.
#[derive(Debug)]
pub struct Isph {
    pub(super) options: IsphOptions,
    pub(super) path: SimdPath,
    /// The bodies' faces; their ghosts only serve readings.
    pub(super) ghosts: Ghosts,
    pub(super) responds: usize,
    pub(super) even: Even,
    pub(super) fluid: Fluid,
    pub(super) carried: Carried,
    pub(super) tally: Tally,
    /// The tally with the step under way.
    pub(super) pending: Tally,
    /// Offsets of the bodies at r*.
    pub(super) face_offsets: Vec<f64>,
    pub(super) planes: Vec<Plane>,
    /// The water and its images, before these are sorted.
    pub(super) loose: Vec<Point>,
    pub(super) near: Near,
    /// Of the points, what pair loops read.
    pub(super) numbers: Vec<Numbers>,
    pub(super) operators: Operators,
    /// L of every point, turned as its image is.
    pub(super) turned: Vec<[f64; 3]>,
    pub(super) system: System,
    pub(super) exact: Exact,
    /// Dynamic pressure of the step under way, Pa, the pressure that accelerates, and the whole.
    pub(super) pressure: Vec<f64>,
    pub(super) own_pressure: Vec<f64>,
    pub(super) total: Vec<f64>,
    /// Velocities whose divergence is taken, and that.
    pub(super) velocities: Vec<[f64; 2]>,
    pub(super) divergence: Vec<f64>,
    pub(super) strain: Vec<[f64; 2]>,
    /// Viscous accelerations, and what they do to the bodies.
    pub(super) drag: Vec<[f64; 2]>,
    pub(super) drag_on_bodies: Vec<f64>,
    /// By the pressure that was asked for last, and by that of the step under way.
    pub(super) accelerations: Vec<[f64; 2]>,
    pub(super) settled: Vec<[f64; 2]>,
    pub(super) forces: Vec<f64>,
    pub(super) loads: Vec<Load>,
    pub(super) responded: bool,
    /// Phases of a step with the seconds spent in each.
    pub(super) phases: [(&'static str, f64); 5],
}

impl Isph {
    /// Particles at their start between walls; the body number `responds` has its acceleration
    /// solved together with its force.
    pub fn new(
        options: IsphOptions,
        ghosts: Ghosts,
        fluid: Fluid,
        responds: usize,
        path: SimdPath,
    ) -> Isph {
        let (n, bodies) = (fluid.len(), ghosts.bodies.len());
        let none = vec![0.0; n];
        Isph {
            even: even_water(&options),
            system: System::new(options.preconditioner),
            carried: Carried {
                pressure: none.clone(),
                older_pressure: none.clone(),
                aim: none.clone(),
                response: Vec::new(),
            },
            tally: Tally::default(),
            pending: Tally::default(),
            face_offsets: Vec::new(),
            planes: Vec::new(),
            loose: Vec::new(),
            near: Near::default(),
            numbers: Vec::new(),
            operators: Operators::default(),
            turned: Vec::new(),
            exact: Exact::default(),
            pressure: none.clone(),
            own_pressure: none.clone(),
            total: none.clone(),
            velocities: Vec::new(),
            divergence: none,
            strain: vec![[0.0; 2]; n],
            drag: Vec::new(),
            drag_on_bodies: vec![0.0; bodies],
            accelerations: vec![[0.0; 2]; n],
            settled: Vec::new(),
            forces: vec![0.0; bodies],
            loads: vec![Load::default(); bodies],
            responded: false,
            phases: ["neighbours", "operators", "assembly", "solver", "integration"]
                .map(|phase| (phase, 0.0)),
            options,
            path,
            ghosts,
            responds,
            fluid,
        }
    }
}
