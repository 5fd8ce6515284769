//! The particles with all that surrounds them.

use super::exact::Exact;
use super::grid::Grid;
use super::images::{Point, Points};
use super::kept::{Carried, Tally};
use super::lattice::lattice_sums;
use super::options::IsphOptions;
use crate::boundary::{Ghosts, Plane};
use crate::math::simd::SimdPath;
use crate::math::sparse::{Csr, Krylov, Preconditioner};
use crate::neighbours::Strips;
use crate::particles::Fluid;
use crate::scheme::Load;

/// A step sorts the particles afresh when this many have gone by.
const STEPS_PER_SORT: u64 = 20;

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

/// One entry of a particle's neighbour list.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Neighbour {
    /// Number among the points.
    pub point: u32,
    /// F = V_j |∇W|/|Δ|: V_j ∇_iW = -F (r_j - r_i) taken the other way, F > 0.
    pub weight: f64,
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
    strips: Strips,
    order: Vec<u32>,
    scratch: Vec<f64>,
    pub(super) planes: Vec<Plane>,
    /// Particles in reach of the surface.
    pub(super) near_surface: Vec<bool>,
    pub(super) fluid: Fluid,
    pub(super) carried: Carried,
    pub(super) tally: Tally,
    /// The tally with the step under way.
    pub(super) pending: Tally,
    /// Dynamic pressure of the step under way, Pa.
    pub(super) pressure: Vec<f64>,
    pub(super) loose: Vec<Point>,
    pub(super) grid: Grid,
    pub(super) points: Points,
    pub(super) list_starts: Vec<u32>,
    pub(super) list: Vec<Neighbour>,
    pub(super) near: Vec<u32>,
    /// F Δ of the same entries.
    pub(super) pull_x: Vec<f64>,
    pub(super) pull_y: Vec<f64>,
    pub(super) exact: Exact,
    /// m/ρ.
    pub(super) volumes: Vec<f64>,
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
    pub(super) slot: Vec<u32>,
    /// p L of every point.
    pub(super) stress: [Vec<f64>; 3],
    /// p of the fluid.
    pub(super) own_pressure: Vec<f64>,
    /// L of every point, turned as its image is.
    pub(super) turned: Vec<[f64; 3]>,
    pub(super) turned_strain: [Vec<f64>; 2],
    pub(super) accelerations: Vec<[f64; 2]>,
    /// Accelerations by the pressure of the step under way.
    pub(super) settled: Vec<[f64; 2]>,
    /// Particles that have images among their neighbours.
    pub(super) at_walls: Vec<u32>,
    /// Velocity of every point.
    pub(super) moving: [Vec<f64>; 2],
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
            grid: Grid::default(),
            points: Points::default(),
            list_starts: Vec::new(),
            list: Vec::new(),
            near: Vec::new(),
            pull_x: Vec::new(),
            pull_y: Vec::new(),
            exact: Exact::default(),
            volumes: Vec::new(),
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
            slot: Vec::new(),
            stress: Default::default(),
            own_pressure: Vec::new(),
            turned: Vec::new(),
            turned_strain: Default::default(),
            accelerations: Vec::new(),
            settled: Vec::new(),
            at_walls: Vec::new(),
            moving: Default::default(),
            forces: vec![0.0; bodies],
            velocities: Vec::new(),
            change: Vec::new(),
            strips: Strips::default(),
            order: Vec::new(),
            scratch: Vec::new(),
            planes: Vec::new(),
            near_surface: Vec::new(),
            options,
            path,
            ghosts,
            total: vec![0.0; n],
            responds,
            fluid,
        }
    }

    /// Sorts the particles now and then, so that neighbours lie close in memory.
    pub(super) fn sort(&mut self) {
        if !self.tally.steps.is_multiple_of(STEPS_PER_SORT) {
            return;
        }
        let n = self.fluid.len();
        let width = 2.83 * self.options.spacing;
        let (x, y) = (&self.fluid.x[..n], &self.fluid.y[..n]);
        let mut order = std::mem::take(&mut self.order);
        self.strips.renew(x, y, &self.fluid.id[..n], width, &mut order);
        self.fluid.reorder(&order, &mut self.scratch);
        let carried = &mut self.carried;
        for field in [
            &mut carried.pressure,
            &mut carried.older_pressure,
            &mut carried.aim,
            &mut carried.response,
        ] {
            if !field.is_empty() {
                self.scratch.clear();
                self.scratch.extend(order.iter().map(|&from| field[from as usize]));
                field.copy_from_slice(&self.scratch);
            }
        }
        self.order = order;
    }
}
