//! The particles and all data about their surroundings.

use serde::{Deserialize, Serialize};

use super::exact::Exact;
use super::images::Point;
use super::lattice::{Even, even_water};
use super::operators::Operators;
use super::options::IsphOptions;
use super::system::System;
use crate::boundary::{Ghosts, Plane};
use crate::math::simd::SimdPath;
use crate::math::team::{Growing, Team};
use crate::pairs::{Fluid, Near};
use crate::scheme::{Load, Phases};
use crate::water::Shortfall;

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
    /// Response of the pressure to the wall's acceleration; empty before it was first asked for.
    pub response: Vec<f64>,
}

/// What must be kept to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IsphState {
    pub(super) fluid: Fluid,
    pub(super) carried: Carried,
    pub(super) tally: Tally,
}

const PHASES: [&str; 5] = ["neighbours", "operators", "assembly", "solver", "integration"];

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
    /// The tally, including the step under way.
    pub(super) pending: Tally,
    /// Offsets of the bodies at r*.
    pub(super) face_offsets: Vec<f64>,
    pub(super) planes: Vec<Plane>,
    /// The water and its images, before they are sorted.
    pub(super) loose: Vec<Point>,
    /// Adds the images to the points.
    pub(super) growing: Growing<Point>,
    /// The same points in the order of the neighbourhood, with some padding between.
    pub(super) points: Vec<Point>,
    pub(super) near: Near,
    pub(super) operators: Operators,
    /// L of every point, turned as its image is.
    pub(super) turned: Vec<[f64; 3]>,
    pub(super) system: System,
    pub(super) exact: Exact,
    /// The volume's shortfall under a level surface, and the rate at which the volume's error is
    /// corrected, 1/s.
    pub(super) shortfall: Option<(Shortfall, f64)>,
    /// Dynamic pressure of the step under way, Pa, without the responding wall's acceleration; and
    /// the pressure whose gradient was taken last.
    pub(super) pressure: Vec<f64>,
    pub(super) own_pressure: Vec<f64>,
    /// Dynamic and whole pressure of the water with that acceleration, Pa: see [`Isph::settle_pressures`].
    pub(super) dynamic: Vec<f64>,
    pub(super) whole: Vec<f64>,
    /// Velocities of which the divergence is taken, and the result.
    pub(super) velocities: Vec<[f64; 2]>,
    pub(super) divergence: Vec<f64>,
    pub(super) strain: Vec<[f64; 2]>,
    /// Viscous accelerations, and the viscous forces on the bodies.
    pub(super) drag: Vec<[f64; 2]>,
    pub(super) drag_on_bodies: Vec<f64>,
    /// The loss of every particle in a step by viscosity, W, and by shifting, J.
    pub(super) spent: [Vec<f64>; 2],
    /// Accelerations by the pressure that was asked for last, and by that of the step under way.
    pub(super) accelerations: Vec<[f64; 2]>,
    pub(super) settled: Vec<[f64; 2]>,
    pub(super) forces: Vec<f64>,
    pub(super) loads: Vec<Load>,
    pub(super) responded: bool,
    /// The responding wall's acceleration, m/s²; 0 until it is known.
    pub(super) answer: f64,
    pub(super) phases: Phases<5>,
}

impl Isph {
    /// Particles at their start between walls. The acceleration of the body number `responds` is
    /// found together with its force.
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
            growing: Growing::of(&Team::default()),
            points: Vec::new(),
            near: Near::new(path, options.kernel, options.support_radius, options.spacing),
            operators: Operators::default(),
            turned: Vec::new(),
            exact: Exact::default(),
            shortfall: (options.volume_rate > 0.0 && options.gravity > 0.0).then(|| {
                let support = options.support_radius / options.spacing;
                (Shortfall::of(options.kernel, support), options.volume_rate)
            }),
            pressure: none.clone(),
            own_pressure: none.clone(),
            dynamic: none.clone(),
            whole: none.clone(),
            velocities: Vec::new(),
            divergence: none,
            strain: vec![[0.0; 2]; n],
            drag: Vec::new(),
            drag_on_bodies: vec![0.0; bodies],
            spent: Default::default(),
            accelerations: vec![[0.0; 2]; n],
            settled: Vec::new(),
            forces: vec![0.0; bodies],
            loads: vec![Load::default(); bodies],
            responded: false,
            answer: 0.0,
            phases: Phases::new(PHASES),
            options,
            path,
            ghosts,
            responds,
            fluid,
        }
    }
}
