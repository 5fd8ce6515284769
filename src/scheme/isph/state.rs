//! The particles with all that surrounds them.

use super::assembly::{Reached, Rows};
use super::exact::Exact;
use super::images::{Point, Points};
use super::kept::{Carried, Tally};
use super::lattice::lattice_sums;
use super::lists::Numbers;
use super::options::IsphOptions;
use crate::boundary::{Ghosts, Plane};
use crate::math::simd::{LANES, SimdPath};
use crate::math::sparse::{Csr, Krylov, Preconditioner};
use crate::pairs::Fluid;
use crate::pairs::{PairList, Strips};
use crate::scheme::Load;

/// Seconds spent in each phase.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Timings {
    pub neighbours: f64,
    pub operators: f64,
    pub assembly: f64,
    pub solver: f64,
    pub integration: f64,
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
    /// ∇·u.
    pub divergence: Vec<f64>,
    /// Its surface: whether ∇·r < 1.5, and for those near it what the zero pressure adds to the
    /// diagonal.
    pub at_surface: Vec<bool>,
    pub grip: Vec<f64>,
}

/// ISPH particles with their walls.
#[derive(Debug)]
pub struct Isph {
    pub(super) options: IsphOptions,
    pub(super) path: SimdPath,
    /// The bodies' faces; their ghosts only serve readings.
    pub(super) ghosts: Ghosts,
    /// Pressures of the fluid, Pa.
    pub(super) total: Vec<f64>,
    pub(super) responds: usize,
    pub(super) forces: Vec<f64>,
    /// Velocities whose divergence is taken.
    pub(super) velocities: Vec<[f64; 2]>,
    pub(super) change: Vec<f64>,
    pub(super) strips: Strips,
    pub(super) image_strips: Strips,
    pub(super) order: Vec<u32>,
    /// 0, 1, 2, ...: images of one height keep their order.
    pub(super) ties: Vec<u32>,
    pub(super) scratch: Vec<f64>,
    /// Places to be sorted.
    pub(super) ahead: [Vec<f64>; 2],
    pub(super) planes: Vec<Plane>,
    pub(super) fluid: Fluid,
    pub(super) carried: Carried,
    pub(super) tally: Tally,
    /// The tally with the step under way.
    pub(super) pending: Tally,
    /// Dynamic pressure of the step under way, Pa.
    pub(super) pressure: Vec<f64>,
    /// The water and its images, before these are sorted.
    pub(super) loose: Vec<Point>,
    pub(super) points: Points,
    pub(super) numbers: Vec<Numbers>,
    pub(super) pairs: PairList,
    /// F of every entry with the eight.
    pub(super) weights: Vec<[f64; LANES]>,
    pub(super) exact: Exact,
    /// Viscous accelerations, their power and what they do to the bodies.
    pub(super) drag: Vec<[f64; 2]>,
    pub(super) strain: Vec<[f64; 2]>,
    pub(super) drag_on_bodies: Vec<f64>,
    pub(super) operators: Operators,
    /// Σ F of a particle with full support.
    pub(super) full_weight: f64,
    /// Σ V W of such a particle.
    pub(super) full_coverage: f64,
    /// Least V_i V_j F of a pair that the narrow Laplacian takes, and what it is scaled by.
    pub(super) narrow: (f64, f64),
    /// Offsets of the bodies at r*.
    pub(super) face_offsets: Vec<f64>,
    pub(super) matrix: Csr,
    pub(super) right: Vec<f64>,
    pub(super) preconditioner: Preconditioner,
    pub(super) krylov: Krylov,
    pub(super) loads: Vec<Load>,
    pub(super) responded: bool,
    pub(super) timings: Timings,
    pub(super) rows: Rows,
    pub(super) reached: Reached,
    /// p of the fluid.
    pub(super) own_pressure: Vec<f64>,
    /// L of every point, turned as its image is.
    pub(super) turned: Vec<[f64; 3]>,
    pub(super) accelerations: Vec<[f64; 2]>,
    /// Accelerations by the pressure of the step under way.
    pub(super) settled: Vec<[f64; 2]>,
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
        let bodies = ghosts.bodies.len();
        let n = fluid.len();
        let sums = lattice_sums(&options);
        Isph {
            full_weight: sums.weight,
            full_coverage: sums.coverage,
            narrow: sums.narrow,
            face_offsets: Vec::new(),
            preconditioner: Preconditioner::new(options.preconditioner),
            carried: Carried {
                pressure: vec![0.0; n],
                older_pressure: vec![0.0; n],
                aim: vec![0.0; n],
                response: Vec::new(),
            },
            tally: Tally::default(),
            pending: Tally::default(),
            pressure: vec![0.0; n],
            loose: Vec::new(),
            points: Points::default(),
            numbers: Vec::new(),
            pairs: PairList::default(),
            weights: Vec::new(),
            exact: Exact::default(),
            drag: Vec::new(),
            strain: Vec::new(),
            drag_on_bodies: vec![0.0; bodies],
            operators: Operators::default(),
            matrix: Csr::default(),
            right: Vec::new(),
            krylov: Krylov::default(),
            loads: vec![Load::default(); bodies],
            responded: false,
            timings: Timings::default(),
            rows: Rows::default(),
            reached: Reached::default(),
            own_pressure: Vec::new(),
            turned: Vec::new(),
            accelerations: Vec::new(),
            settled: Vec::new(),
            forces: vec![0.0; bodies],
            velocities: Vec::new(),
            change: Vec::new(),
            strips: Strips::default(),
            image_strips: Strips::default(),
            order: Vec::new(),
            ties: Vec::new(),
            ahead: Default::default(),
            scratch: Vec::new(),
            planes: Vec::new(),
            options,
            path,
            ghosts,
            total: vec![0.0; n],
            responds,
            fluid,
        }
    }
}
