//! The two halves of a time step.

use std::marker::PhantomData;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::continuity::{Continuity, OFF, PLAIN, RENORMALISED};
use super::momentum::{CONCENTRATION, FORCES, GRADIENTS, Momentum};
use super::{DensityDiffusion, Shifting, WcsphOptions, Workspace};
use crate::body::BodyMotion;
use crate::boundary::{Exchange, ExchangeRules, Ghosts, InterpolatorChoice};
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::neighbours::{Drift, PairList, PointSet, Strips, build_pair_list};
use crate::particles::{Fluid, Record, Scaling};
use crate::with_kernel;

/// Margin of the fluid's lists, in particle spacings.
const FLUID_MARGIN: f64 = 0.4;
/// Margin of the lists that involve ghosts, in particle spacings.
const GHOST_MARGIN: f64 = 1.6;
/// A strip holds this many columns of particles: eight particles then form a square.
const STRIP_COLUMNS: f64 = 2.83;
/// Shifting fades in from this completeness of the support ...
const SHIFT_FROM: f64 = 0.85;
/// ... to this one.
const SHIFT_FULL: f64 = 0.97;
/// A particle is spray from this completeness ...
const SPRAY_FROM: f64 = 0.45;
/// ... and wholly so from this.
const SPRAY_FULL: f64 = 0.25;
/// Water bears tension from this completeness: none at the surface ...
const TENSION_FROM: f64 = 0.6;
/// ... and all of it from this.
const TENSION_FULL: f64 = 0.9;
/// No shift is longer than this many particle spacings.
const SHIFT_LIMIT: f64 = 0.05;

/// Force of the water on a body, at the current places.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Along x, N per metre of width; for the responding body with its acceleration left out.
    pub force: f64,
    /// What its own acceleration takes off that force: F = `force` - `added_mass` a.
    pub added_mass: f64,
}

/// Motion of the bodies over the second half of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepWalls<'a> {
    /// Offset at the start of the step and mean velocity over it.
    pub bodies: &'a [BodyMotion],
    /// Acceleration of the responding body.
    pub acceleration: f64,
}

/// Powers (W) and works (J), per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dissipation {
    /// Power lost to artificial viscosity, where it was asked for.
    pub viscous_power: f64,
    /// Power lost to density diffusion, where it was asked for.
    pub diffusion_power: f64,
    /// Energy taken out by shifting over the step.
    pub shifting_work: f64,
}

/// Seconds spent in each phase, and pairs evaluated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Timings {
    /// Sorting and listing.
    pub neighbours: f64,
    /// Interpolation to the ghosts.
    pub ghosts: f64,
    /// Momentum pass.
    pub momentum: f64,
    /// Continuity pass.
    pub continuity: f64,
    /// Kicks, drifts, packing.
    pub integration: f64,
}

/// What must be kept to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WcsphState {
    fluid: Fluid,
    reference_x: Vec<f64>,
    reference_y: Vec<f64>,
    reference_offsets: Vec<f64>,
    carried: [Vec<f64>; 4],
    strain: Vec<[f64; 2]>,
    pair_evaluations: u64,
}

/// δ-SPH particles with their neighbours and ghosts.
#[derive(Debug, Clone)]
pub struct Wcsph {
    options: WcsphOptions,
    path: SimdPath,
    scaling: Scaling,
    responds: usize,
    /// The water.
    pub fluid: Fluid,
    /// The walls' ghosts.
    pub ghosts: Ghosts,
    exchange: Exchange,
    strips: Strips,
    pairs: PairList,
    drift: Drift,
    reference_x: Vec<f64>,
    reference_y: Vec<f64>,
    reference_offsets: Vec<f64>,
    records: Vec<Record>,
    work: Workspace,
    diffused: Vec<f64>,
    strain: Vec<[f64; 2]>,
    scratch: Vec<f64>,
    pair_evaluations: u64,
    last_viscous_power: f64,
    /// Where the time went; never part of the state.
    pub timings: Timings,
}

impl Wcsph {
    /// Particles at their start; the body number `responds` has its acceleration solved together
    /// with its force.
    pub fn new(
        options: WcsphOptions,
        rules: ExchangeRules,
        fluid: Fluid,
        ghosts: Ghosts,
        responds: usize,
        path: SimdPath,
    ) -> Wcsph {
        let padded = fluid.padded_len();
        let bodies = ghosts.bodies.len();
        Wcsph {
            scaling: rules.scaling,
            exchange: Exchange::new(rules, &ghosts),
            strips: Strips::default(),
            pairs: PairList::default(),
            drift: Drift::default(),
            reference_x: Vec::new(),
            reference_y: Vec::new(),
            reference_offsets: Vec::new(),
            records: vec![Record::default(); padded + ghosts.len()],
            work: Workspace::new(padded, bodies),
            diffused: vec![0.0; padded],
            strain: vec![[0.0; 2]; padded],
            scratch: Vec::new(),
            pair_evaluations: 0,
            last_viscous_power: 0.0,
            timings: Timings::default(),
            options,
            path,
            responds,
            fluid,
            ghosts,
        }
    }

    /// The rules for ghosts that fit the options.
    pub fn exchange_rules(
        options: &WcsphOptions,
        interpolator: InterpolatorChoice,
        gravity_in_sum: bool,
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
            gravity_in_sum,
            no_slip,
            bed_between_walls: true,
        }
    }

    /// Width of the strips of the neighbour search, metres.
    pub fn strip_width(spacing: f64) -> f64 {
        STRIP_COLUMNS * spacing
    }

    /// What must be kept.
    pub fn state(&self) -> WcsphState {
        WcsphState {
            fluid: self.fluid.clone(),
            reference_x: self.reference_x.clone(),
            reference_y: self.reference_y.clone(),
            reference_offsets: self.reference_offsets.clone(),
            carried: self.work.carried().map(Clone::clone),
            strain: self.strain.clone(),
            pair_evaluations: self.pair_evaluations,
        }
    }

    /// Goes back to a kept state: lists are built again from the places of their last rebuild,
    /// so that they are the same lists.
    pub fn restore(&mut self, state: WcsphState) {
        self.fluid = state.fluid;
        self.reference_x = state.reference_x;
        self.reference_y = state.reference_y;
        self.reference_offsets = state.reference_offsets;
        for (field, kept) in self.work.carried_mut().into_iter().zip(state.carried) {
            *field = kept;
        }
        self.strain = state.strain;
        self.pair_evaluations = state.pair_evaluations;
        if !self.reference_x.is_empty() {
            self.list_neighbours();
        }
    }

    /// Pair interactions evaluated so far.
    pub fn pair_evaluations(&self) -> u64 {
        self.pair_evaluations
    }

    /// The options.
    pub fn options(&self) -> &WcsphOptions {
        &self.options
    }

    /// First half: forces at the current places. `bodies` are the motions at this instant; the
    /// acceleration of the responding body is not used. With `sample` the viscous power is summed.
    pub fn prepare(&mut self, bodies: &[BodyMotion], sample: bool) -> &[[f64; 2]] {
        let start = Instant::now();
        self.refresh_lists(bodies);
        let listed = Instant::now();
        self.timings.neighbours += (listed - start).as_secs_f64();
        self.pack();
        let packed = Instant::now();
        self.timings.integration += (packed - listed).as_secs_f64();
        let (fluid_records, ghost_records) = self.records.split_at_mut(self.fluid.padded_len());
        let fluid = (&*fluid_records, self.work.pressure.as_slice());
        self.exchange.weigh(self.path, &self.ghosts, bodies, fluid);
        self.exchange.fill(&self.ghosts, bodies, self.responds, ghost_records);
        let filled = Instant::now();
        self.timings.ghosts += (filled - packed).as_secs_f64();
        self.last_viscous_power = self.momentum_pass(sample);
        self.timings.momentum += filled.elapsed().as_secs_f64();
        &self.work.loads
    }

    /// Force on a body and its added mass, from the last [`Wcsph::prepare`].
    pub fn load(&self, body: usize) -> Load {
        let [force, added_mass] = self.work.loads[body];
        Load { force, added_mass }
    }

    /// Level of the water at an upright body, metres above the bed.
    pub fn level_at(&self, body: usize) -> f64 {
        self.exchange.level(&self.ghosts, body)
    }

    /// Force on a body by integrating the interpolated pressure over its face, N per metre.
    pub fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64 {
        let fluid = (&self.records[..self.fluid.padded_len()], self.work.pressure.as_slice());
        self.exchange.face_force(self.path, &self.ghosts, body, motion, fluid)
    }

    /// Level of the free surface at x, metres above the bed: upwards from `from`, the first
    /// height at which the kernel's coverage Σ W V falls to 1/2.
    pub fn level_in_water(&self, x: f64, from: f64) -> f64 {
        let radius = self.options.support_radius;
        let margin = GHOST_MARGIN * self.options.spacing;
        let factor = self.options.kernel.normalisation() / (radius * radius);
        let mut near = Vec::new();
        let reach = radius + margin;
        self.strips.visit_box([x - reach, x + reach], [f64::MIN, f64::MAX], |range| {
            near.extend(range.filter(|&k| (self.fluid.x[k] - x).abs() < radius));
        });
        let coverage = |y: f64| -> f64 {
            let terms = near.iter().map(|&k| {
                let q = (self.fluid.x[k] - x).hypot(self.fluid.y[k] - y) / radius;
                if q < 1.0 {
                    let volume = self.fluid.mass[k] / self.fluid.density[k];
                    volume * self.options.kernel.shape_at(q)
                } else {
                    0.0
                }
            });
            terms.sum::<f64>() * factor
        };
        let step = 0.5 * self.options.spacing;
        let (mut y, mut below) = (from, coverage(from));
        if below < 0.5 {
            return from;
        }
        loop {
            let above = coverage(y + step);
            if above < 0.5 {
                return y + step * (below - 0.5) / (below - above);
            }
            (y, below) = (y + step, above);
        }
    }

    /// Scratch.
    pub fn dump(&self, f: &mut std::fs::File) {
        use std::io::Write;
        for k in 0..self.fluid.len() {
            writeln!(
                f,
                "{} {} {} {} {} {}",
                self.fluid.x[k],
                self.fluid.y[k],
                self.work.pressure[k],
                self.work.completeness[k],
                self.fluid.vx[k],
                self.fluid.vy[k]
            )
            .unwrap();
        }
        writeln!(f).unwrap();
        writeln!(f).unwrap();
        for r in &self.records[self.fluid.padded_len()..] {
            let r = r.0;
            let s = self.scaling.support_radius;
            writeln!(
                f,
                "{} {} {} {} {} {}",
                r[0] * s,
                r[1] * s,
                r[5],
                r[4] / self.scaling.weight_per_volume / self.options.spacing.powi(2),
                r[2],
                r[3]
            )
            .unwrap();
        }
    }

    /// Second half: velocities with the forces of [`Wcsph::prepare`], densities with the new
    /// velocities, then places. With `sample` the power of density diffusion is summed.
    ///
    /// Shifting moves a particle by δr = -A h |u| Δt ∇C, ∇C = Σ V_j ∇W, faded out where the
    /// support is incomplete and across walls, and takes its density along: δρ = δr·∇ρ.
    pub fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation {
        let start = Instant::now();
        self.kick(dt, walls.acceleration);
        let kicked = Instant::now();
        self.timings.integration += (kicked - start).as_secs_f64();
        let records = self.records.split_at_mut(self.fluid.padded_len());
        let records = (&*records.0, records.1);
        self.exchange.refresh_velocities(self.path, &self.ghosts, walls.bodies, records);
        let mirrored = Instant::now();
        self.timings.ghosts += (mirrored - kicked).as_secs_f64();
        let diffusion_power = -self.continuity_pass(sample);
        let counted = Instant::now();
        self.timings.continuity += (counted - mirrored).as_secs_f64();
        let shifting_work = self.drift(dt, walls.bodies);
        self.take_next_correction();
        self.timings.integration += counted.elapsed().as_secs_f64();
        self.pair_evaluations += (LANES * (2 * self.pairs.len() + self.exchange.pairs())) as u64;
        Dissipation { viscous_power: -self.last_viscous_power, diffusion_power, shifting_work }
    }

    fn take_next_correction(&mut self) {
        let work = &mut self.work;
        std::mem::swap(&mut work.correction_xx, &mut work.next_correction_xx);
        std::mem::swap(&mut work.correction_xy, &mut work.next_correction_xy);
        std::mem::swap(&mut work.correction_yy, &mut work.next_correction_yy);
    }

    /// Makes new lists where a pair may have come into reach unseen.
    fn refresh_lists(&mut self, bodies: &[BodyMotion]) {
        let spacing = self.options.spacing;
        let n = self.fluid.len();
        let worn = self.reference_x.is_empty() || {
            let reach = ((self.options.support_radius + FLUID_MARGIN * spacing)
                / Wcsph::strip_width(spacing))
            .ceil() as usize;
            let (relative, farthest) = self.drift.measure(
                &self.strips,
                [&self.fluid.x[..n], &self.fluid.y[..n]],
                [&self.reference_x, &self.reference_y],
                reach,
            );
            let moved = bodies
                .iter()
                .zip(&self.reference_offsets)
                .map(|(body, reference)| (body.offset - reference).abs())
                .fold(0.0, f64::max);
            // Written so that NaN counts as worn.
            !(relative < FLUID_MARGIN * spacing && farthest + moved < GHOST_MARGIN * spacing)
        };
        if worn {
            let width = Wcsph::strip_width(spacing);
            let (_, order) =
                Strips::sort(&self.fluid.x[..n], &self.fluid.y[..n], &self.fluid.id[..n], width);
            self.fluid.reorder(&order, &mut self.scratch);
            for field in self.work.carried_mut() {
                self.scratch.clear();
                self.scratch.extend(order.iter().map(|&from| field[from as usize]));
                field[..n].copy_from_slice(&self.scratch);
            }
            let strain: Vec<[f64; 2]> =
                order.iter().map(|&from| self.strain[from as usize]).collect();
            self.strain[..n].copy_from_slice(&strain);
            self.reference_x.clear();
            self.reference_x.extend_from_slice(&self.fluid.x[..n]);
            self.reference_y.clear();
            self.reference_y.extend_from_slice(&self.fluid.y[..n]);
            self.reference_offsets.clear();
            self.reference_offsets.extend(bodies.iter().map(|body| body.offset));
            self.list_neighbours();
        }
    }

    /// Lists neighbours at the reference places, in the present order.
    fn list_neighbours(&mut self) {
        let (spacing, radius) = (self.options.spacing, self.options.support_radius);
        let n = self.fluid.len();
        let padded = self.fluid.padded_len();
        let width = Wcsph::strip_width(spacing);
        self.strips = Strips::of_sorted(&self.reference_x, &self.reference_y, width);
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
        let mut sets = vec![PointSet {
            strips: &self.strips,
            x: &self.reference_x,
            y: &self.reference_y,
            offset: 0.0,
            first: 0,
            reach: radius + FLUID_MARGIN * spacing,
            bounds: everywhere,
        }];
        for (body, offset) in self.ghosts.bodies.iter().zip(&self.reference_offsets) {
            sets.push(PointSet {
                strips: &body.strips,
                x: &self.ghosts.x[body.ghosts.clone()],
                y: &self.ghosts.y[body.ghosts.clone()],
                offset: *offset,
                first: (padded + body.ghosts.start) as u32,
                reach: radius + GHOST_MARGIN * spacing,
                bounds: body.bounds,
            });
        }
        let mut lanes_x = self.reference_x.clone();
        let mut lanes_y = self.reference_y.clone();
        lanes_x.resize(padded, lanes_x[n - 1]);
        lanes_y.resize(padded, lanes_y[n - 1]);
        build_pair_list(self.path, &lanes_x, &lanes_y, &sets, &mut self.pairs);
        let bodies: Vec<BodyMotion> = self
            .reference_offsets
            .iter()
            .map(|&offset| BodyMotion { offset, ..BodyMotion::default() })
            .collect();
        self.exchange.rebuild(
            self.path,
            &self.ghosts,
            &bodies,
            (&self.strips, &self.reference_x, &self.reference_y),
            radius + GHOST_MARGIN * spacing,
        );
    }

    /// Pressures, and everything about the fluid that the pair loops read.
    fn pack(&mut self) {
        let options = &self.options;
        let state = options.state;
        let hydrostatic = options.hydrostatic_slope();
        let corrected = options.corrected_gradients;
        let fluid = &self.fluid;
        for k in 0..fluid.padded_len() {
            let density = fluid.density[k];
            let mut pressure = state.pressure(density);
            if corrected && pressure < 0.0 {
                let inside = (self.work.completeness[k] - TENSION_FROM)
                    / (TENSION_FULL - TENSION_FROM);
                pressure *= inside.clamp(0.0, 1.0);
            }
            let diffused = density + hydrostatic * fluid.y[k];
            self.work.pressure[k] = pressure;
            self.diffused[k] = diffused;
            let x = fluid.x[k] * self.scaling.inverse_radius;
            let y = fluid.y[k] * self.scaling.inverse_radius;
            self.work.scaled_x[k] = x;
            self.work.scaled_y[k] = y;
            let weight = fluid.mass[k] / density * self.scaling.weight_per_volume;
            let [xx, xy, yy] = if corrected {
                let work = &self.work;
                [work.correction_xx[k], work.correction_xy[k], work.correction_yy[k]]
                    .map(|component| pressure * component)
            } else {
                [pressure, 0.0, pressure]
            };
            self.records[k] = Record([x, y, fluid.vx[k], fluid.vy[k], weight, xx, xy, yy]);
        }
    }

    fn momentum_pass(&mut self, sample: bool) -> f64 {
        let options = &self.options;
        let sums = match (options.density_diffusion, options.shifting) {
            (DensityDiffusion::Renormalised, _) => GRADIENTS,
            (_, Shifting::Interior) => CONCENTRATION,
            (_, Shifting::None) => FORCES,
        };
        let viscosity = options.artificial_viscosity
            * options.smoothing_length()
            * options.state.sound_speed
            * options.density
            * self.scaling.inverse_radius;
        macro_rules! pass {
            ($K:ty, $sums:ident) => {
                match (options.corrected_gradients, sample) {
                    (false, false) => pass!($K, $sums, false, false),
                    (false, true) => pass!($K, $sums, false, true),
                    (true, false) => pass!($K, $sums, true, false),
                    (true, true) => pass!($K, $sums, true, true),
                }
            };
            ($K:ty, $sums:ident, $corrected:literal, $energy:literal) => {
                dispatch(
                    self.path,
                    Momentum::<$K, $sums, $corrected, $energy> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        strain: &self.strain,
                        pairs: &self.pairs,
                        work: &mut self.work,
                        bodies: self.ghosts.bodies.len(),
                        responds: self.responds,
                        viscosity,
                        support_radius: self.scaling.support_radius,
                        gravity: options.gravity,
                        kernel: PhantomData,
                    },
                )
            };
        }
        with_kernel!(options.kernel, K => match sums {
            GRADIENTS => pass!(K, GRADIENTS),
            CONCENTRATION => pass!(K, CONCENTRATION),
            _ => pass!(K, FORCES),
        })
    }

    fn continuity_pass(&mut self, sample: bool) -> f64 {
        let options = &self.options;
        let diffusion = options.diffusion_coefficient
            * options.smoothing_length()
            * options.state.sound_speed
            * self.scaling.inverse_radius;
        macro_rules! pass {
            ($K:ty, $diffusion:expr, $energy:literal) => {
                if options.corrected_gradients {
                    pass!($K, $diffusion, true, $energy)
                } else {
                    pass!($K, $diffusion, false, $energy)
                }
            };
            ($K:ty, $diffusion:expr, $corrected:literal, $energy:literal) => {
                dispatch(
                    self.path,
                    Continuity::<$K, { $diffusion }, $corrected, $energy> {
                        fluid: &self.fluid,
                        records: &self.records,
                        diffused: &self.diffused,
                        strain: &mut self.strain,
                        pairs: &self.pairs,
                        work: &mut self.work,
                        support_radius: self.scaling.support_radius,
                        smooth_share: std::env::var("SM").ok().map_or(1.0, |s| s.parse().unwrap()),
                        bodies: self.ghosts.bodies.len(),
                        diffusion,
                        kernel: PhantomData,
                    },
                )
            };
        }
        use DensityDiffusion::{Hydrostatic, Molteni, None, Renormalised};
        with_kernel!(options.kernel, K => match (options.density_diffusion, sample) {
            (None, _) => pass!(K, OFF, false),
            (Molteni | Hydrostatic, false) => pass!(K, PLAIN, false),
            (Molteni | Hydrostatic, true) => pass!(K, PLAIN, true),
            (Renormalised, false) => pass!(K, RENORMALISED, false),
            (Renormalised, true) => pass!(K, RENORMALISED, true),
        })
    }

    fn kick(&mut self, dt: f64, wall_acceleration: f64) {
        let (fluid, work) = (&mut self.fluid, &mut self.work);
        if wall_acceleration != 0.0 {
            for (cluster, response_x, response_y) in &work.responding {
                let at = *cluster as usize * LANES;
                for lane in 0..LANES {
                    work.acceleration_x[at + lane] += wall_acceleration * response_x[lane];
                    work.acceleration_y[at + lane] += wall_acceleration * response_y[lane];
                }
            }
        }
        for k in 0..fluid.len() {
            fluid.vx[k] += dt * work.acceleration_x[k];
            fluid.vy[k] += dt * work.acceleration_y[k];
            let record = &mut self.records[k].0;
            record[Record::VX] = fluid.vx[k];
            record[Record::VY] = fluid.vy[k];
            record[Record::DIFFUSED] = self.diffused[k];
            record[Record::GRADIENT_X] = work.gradient_x[k];
            record[Record::GRADIENT_Y] = work.gradient_y[k];
        }
    }

    /// Moves the particles; returns the energy that shifting takes out.
    fn drift(&mut self, dt: f64, bodies: &[BodyMotion]) -> f64 {
        let (fluid, work, options) = (&mut self.fluid, &self.work, &self.options);
        let n = fluid.len();
        for k in 0..n {
            fluid.density[k] += dt * work.density_rate[k];
            fluid.x[k] += dt * fluid.vx[k];
            fluid.y[k] += dt * fluid.vy[k];
        }
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        for (end, (body, motion)) in ends.iter_mut().zip(self.ghosts.bodies.iter().zip(bodies).skip(1)) {
            *end = self.ghosts.target_x[body.faces.start] + motion.offset + dt * motion.velocity;
        }
        let spray_loss = if options.corrected_gradients { self.settle_spray(dt) } else { 0.0 };
        let shifting_loss = match self.options.shifting {
            Shifting::Interior => self.shift(dt, ends),
            Shifting::None => 0.0,
        };
        self.hold_inside(ends, bodies);
        shifting_loss + spray_loss
    }

    /// Relaxes the pressure of particles with too few neighbours to feel one: spray is at the
    /// pressure of the air. Returns the elastic energy that goes.
    fn settle_spray(&mut self, dt: f64) -> f64 {
        let state = self.options.state;
        let rate = (dt * state.sound_speed / self.options.smoothing_length()).min(1.0);
        let mut loss = 0.0;
        for k in 0..self.fluid.len() {
            let alone = (SPRAY_FROM - self.work.completeness[k]) / (SPRAY_FROM - SPRAY_FULL);
            if alone > 0.0 {
                let density = self.fluid.density[k];
                let rise = rate * alone.min(1.0) * (state.surface_density - density);
                loss -= self.fluid.mass[k] * state.pressure(density) / (density * density) * rise;
                self.fluid.density[k] += rise;
            }
        }
        loss
    }

    /// Puts particles that have slipped through a wall back onto its face, with its velocity.
    fn hold_inside(&mut self, ends: [f64; 2], bodies: &[BodyMotion]) {
        let fluid = &mut self.fluid;
        let skin = 1e-3 * self.options.spacing;
        for k in 0..fluid.len() {
            if fluid.y[k] < 0.0 {
                fluid.y[k] = skin;
                fluid.vy[k] = fluid.vy[k].max(0.0);
            }
            if fluid.x[k] < ends[0] {
                fluid.x[k] = ends[0] + skin;
                fluid.vx[k] = fluid.vx[k].max(bodies[1].velocity);
            } else if fluid.x[k] > ends[1] {
                fluid.x[k] = ends[1] - skin;
                fluid.vx[k] = fluid.vx[k].min(bodies[2].velocity);
            }
        }
    }

    /// Shifts particles towards an even spread; returns the energy that goes.
    fn shift(&mut self, dt: f64, ends: [f64; 2]) -> f64 {
        let (fluid, work, options) = (&mut self.fluid, &self.work, &self.options);
        let n = fluid.len();
        let strength = options.shifting_coefficient * options.smoothing_length() * dt;
        let limit = SHIFT_LIMIT * options.spacing;
        let inverse_radius = self.scaling.inverse_radius;
        let reach = options.spacing;
        let hydrostatic = options.hydrostatic_slope();
        let mut work_done = 0.0;
        for k in 0..n {
            let inside = (work.completeness[k] - SHIFT_FROM) / (SHIFT_FULL - SHIFT_FROM);
            let speed = (fluid.vx[k] * fluid.vx[k] + fluid.vy[k] * fluid.vy[k]).sqrt();
            let factor = -strength * speed * inside.clamp(0.0, 1.0);
            let fade = |distance: f64| (distance / reach - 0.5).clamp(0.0, 1.0);
            let to_end = (fluid.x[k] - ends[0]).min(ends[1] - fluid.x[k]);
            let dx = (factor * work.concentration_x[k]).clamp(-limit, limit) * fade(to_end);
            let dy = (factor * work.concentration_y[k]).clamp(-limit, limit) * fade(fluid.y[k]);
            let rise = (dx * work.gradient_x[k] + dy * work.gradient_y[k]) * inverse_radius
                - hydrostatic * dy;
            let density = fluid.density[k];
            work_done += fluid.mass[k]
                * (options.gravity * dy + work.pressure[k] / (density * density) * rise);
            fluid.x[k] += dx;
            fluid.y[k] += dy;
            fluid.density[k] += rise;
        }
        -work_done
    }
}
