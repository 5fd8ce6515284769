//! The particles with all their data, and the part of it that is stored to go on later.

use serde::{Deserialize, Serialize};

use super::{Carried, WcsphOptions, Workspace};
use crate::body::BodyMotion;
use crate::boundary::{Exchange, ExchangeRules, GhostGravity, Ghosts, InterpolatorChoice, Plane};
use crate::math::simd::SimdPath;
use crate::pairs::{Column, Factors, Fluid, Pairs, Record, Scaling, SingleRecord};
use crate::scheme::{Phases, Taken};
use crate::water::Shortfall;

/// Momentum and continuity stand for their passes, integration for kicks, drifts and packing.
const PHASES: [&str; 7] =
    ["neighbours", "ghosts", "momentum", "viscosity", "continuity", "shifting", "integration"];

/// What must be kept to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WcsphState {
    fluid: Fluid,
    reference_x: Vec<f64>,
    reference_y: Vec<f64>,
    reference_offsets: Vec<f64>,
    carried: Carried,
    strain: Vec<[f64; 2]>,
    pair_evaluations: u64,
    list_rebuilds: u64,
    boundary_fallbacks: u64,
    taken: Taken,
}

/// δ-SPH particles with their neighbours and ghosts.
#[derive(Debug, Clone)]
pub struct Wcsph {
    pub(super) options: WcsphOptions,
    pub(super) scaling: Scaling,
    pub(super) responds: usize,
    /// The water.
    pub fluid: Fluid,
    /// The walls' ghosts.
    pub ghosts: Ghosts,
    pub(super) exchange: Exchange,
    pub(super) pairs: Pairs,
    pub(super) records: Vec<Record>,
    /// The records in single precision, if the pair terms are.
    pub(super) singles: Vec<SingleRecord>,
    pub(super) work: Workspace,
    pub(super) diffused: Vec<f64>,
    pub(super) strain: Vec<[f64; 2]>,
    /// Room for the search of a level.
    pub(super) column: Column,
    pub(super) planes: Vec<Plane>,
    /// The bodies' motions at which the lists were made.
    pub(super) reference_bodies: Vec<BodyMotion>,
    /// The neighbours' numbers for passes over held pairs: first of velocities, then of pressures.
    pub(super) numbers: Vec<Factors>,
    /// The same for the ghosts of a bed that gives back: see `boundary/give_back.rs`.
    pub(super) bed_numbers: Vec<Factors>,
    /// See [`super::diffusion::Renormalised`]; empty where not needed.
    pub(super) slants: Vec<Factors>,
    /// Number of the coming step since the last full one; 0 is a full step.
    pub(super) substep: u32,
    /// From a full step to the middle of the stretch until the next, seconds.
    pub(super) lead: f64,
    /// The particles' positions then.
    pub(super) ahead: [Vec<f64>; 2],
    /// Pressures are ahead of the densities by this time, seconds.
    pub(super) bulk_time: f64,
    /// Time since the last full step, seconds.
    pub(super) since_full: f64,
    /// Motions of the bodies, with the offsets of the last full step.
    pub(super) held_bodies: Vec<BodyMotion>,
    pub(super) pair_evaluations: u64,
    pub(super) boundary_fallbacks: u64,
    pub(super) taken: Taken,
    /// Of the kernel, if the volume is corrected.
    pub(super) shortfall: Option<Shortfall>,
    pub(super) last_viscous_power: f64,
    /// The time spent in each phase; never part of the state.
    pub(super) phases: Phases<7>,
}

impl Wcsph {
    /// Particles at their start. The acceleration of the body number `responds` is found together
    /// with its force.
    pub fn new(
        options: WcsphOptions,
        rules: ExchangeRules,
        fluid: Fluid,
        ghosts: Ghosts,
        responds: usize,
        path: SimdPath,
    ) -> Wcsph {
        let bodies = ghosts.bodies.len();
        let mut water = Wcsph {
            scaling: rules.scaling,
            exchange: Exchange::new(rules, &ghosts),
            pairs: Pairs::new(path, options.support_radius, options.spacing),
            records: Vec::new(),
            singles: Vec::new(),
            work: Workspace::default(),
            diffused: Vec::new(),
            strain: vec![[0.0; 2]; fluid.padded_len()],
            column: Column::default(),
            planes: Vec::new(),
            reference_bodies: vec![BodyMotion::default(); bodies],
            numbers: Vec::new(),
            bed_numbers: Vec::new(),
            slants: Vec::new(),
            substep: 0,
            lead: 0.0,
            bulk_time: 0.0,
            ahead: Default::default(),
            since_full: 0.0,
            held_bodies: vec![BodyMotion::default(); bodies],
            pair_evaluations: 0,
            boundary_fallbacks: 0,
            taken: Taken::default(),
            shortfall: (options.volume_feedback > 0.0)
                .then(|| Shortfall::of(options.kernel, options.support_radius / options.spacing)),
            last_viscous_power: 0.0,
            phases: Phases::new(PHASES),
            options,
            responds,
            fluid,
            ghosts,
        };
        water.make_room();
        water
    }

    /// The rules for ghosts that go with the options.
    pub fn exchange_rules(
        options: &WcsphOptions,
        interpolator: InterpolatorChoice,
        ghost_gravity: GhostGravity,
        no_slip: bool,
    ) -> ExchangeRules {
        ExchangeRules {
            kernel: options.kernel,
            interpolator,
            scaling: Scaling::new(options.kernel, options.support_radius),
            spacing: options.spacing,
            gravity: options.gravity,
            surface_density: options.state.surface_density,
            sound_speed: options.state.sound_speed,
            ghost_gravity,
            no_slip,
            bed_between_walls: true,
            conservative_bed: options.conservative_bed,
            conservative_crest: options.conservative_crest,
        }
    }

    /// The state to be stored, before a full step.
    pub fn state(&self) -> WcsphState {
        assert!(self.substep == 0, "an acoustic step holds more than is kept");
        let ([x, y], offsets) = self.pairs.reference();
        WcsphState {
            fluid: self.fluid.clone(),
            reference_x: x.to_vec(),
            reference_y: y.to_vec(),
            reference_offsets: offsets.to_vec(),
            carried: self.work.carried.clone(),
            strain: self.strain.clone(),
            pair_evaluations: self.pair_evaluations,
            list_rebuilds: self.pairs.rebuilds(),
            boundary_fallbacks: self.boundary_fallbacks,
            taken: self.taken,
        }
    }

    /// Goes back to a stored state. Lists are made from the places of their last rebuild, so that
    /// they are the same lists.
    pub fn restore(&mut self, state: WcsphState) {
        self.fluid = state.fluid;
        let reference = [state.reference_x, state.reference_y];
        self.pairs.restore(reference, state.reference_offsets, state.list_rebuilds);
        self.work.carried = state.carried;
        self.strain = state.strain;
        self.pair_evaluations = state.pair_evaluations;
        self.boundary_fallbacks = state.boundary_fallbacks;
        self.taken = state.taken;
        self.make_room();
        self.substep = 0;
        if self.pairs.are_listed() {
            self.list_neighbours();
        }
    }
}
