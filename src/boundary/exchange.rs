//! From the water to the ghosts: one interpolation at every mirror point and its consequences.

use super::ghosts::{Ghosts, Reflection, Site};
use super::{Interpolator, InterpolatorChoice};
use crate::body::BodyMotion;
use crate::kernel::{Kernel, KernelChoice};
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::neighbours::{PairList, PointSet, Strips, build_pair_list};
use crate::particles::{Record, Scaling};
use crate::{with_interpolator, with_kernel};

/// A ghost's mirrored velocity is at most this many times the water's.
const MIRROR_LIMIT: f64 = 3.0;

/// What the ghosts of a scene obey.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExchangeRules {
    /// Kernel of the scheme.
    pub kernel: KernelChoice,
    /// Interpolator.
    pub interpolator: InterpolatorChoice,
    /// Scaling of the records.
    pub scaling: Scaling,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// Gravity, m/s², pointing down.
    pub gravity: f64,
    /// Density at zero pressure, kg/m³.
    pub surface_density: f64,
    /// Sound speed, m/s.
    pub sound_speed: f64,
    /// Pressure correction inside the sum (exact at rest) rather than at the mirror point.
    pub gravity_in_sum: bool,
    /// Reverse the tangential velocity too.
    pub no_slip: bool,
    /// Body 0 only counts between the bodies 1 and 2: the bed of a tank with moving ends.
    pub bed_between_walls: bool,
}

/// Weighted means of the water at one vector of targets.
#[derive(Debug, Clone, Copy, Default)]
struct Means {
    pressure: [f64; LANES],
    x: [f64; LANES],
    y: [f64; LANES],
    vx: [f64; LANES],
    vy: [f64; LANES],
}

/// The ghosts' side of a step: neighbour lists of their targets, weights, means.
#[derive(Debug, Clone)]
pub struct Exchange {
    rules: ExchangeRules,
    wet_at: f64,
    dry_at: f64,
    half_plane: Vec<f64>,
    list: PairList,
    weights: Vec<[f64; LANES]>,
    scale: Vec<[f64; LANES]>,
    means: Vec<Means>,
    wetness: Vec<f64>,
}

impl Exchange {
    /// Nothing is known of the water yet.
    pub fn new(rules: ExchangeRules, ghosts: &Ghosts) -> Exchange {
        let half = 0.5 * rules.spacing / rules.scaling.support_radius;
        let half_plane =
            (0..=256).map(|k| rules.kernel.half_plane_fraction(f64::from(k) / 256.0)).collect();
        let targets = ghosts.target_x.len();
        Exchange {
            rules,
            wet_at: rules.kernel.half_plane_fraction(half),
            dry_at: rules.kernel.half_plane_fraction(-half),
            half_plane,
            list: PairList::default(),
            weights: Vec::new(),
            scale: vec![[0.0; LANES]; targets / LANES],
            means: vec![Means::default(); targets / LANES],
            wetness: vec![0.0; targets],
        }
    }

    /// Number of target-to-fluid pairs in the lists, eight lanes each.
    pub fn pairs(&self) -> usize {
        self.list.len()
    }

    /// Lists the fluid around every target; `reach` in metres.
    pub fn rebuild(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        fluid: (&Strips, &[f64], &[f64]),
        reach: f64,
    ) {
        let (strips, x, y) = fluid;
        let target_x: Vec<f64> = ghosts
            .target_x
            .iter()
            .enumerate()
            .map(|(k, x)| x + bodies[ghosts.target_body[k / LANES] as usize].offset)
            .collect();
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
        let set = PointSet { strips, x, y, offset: 0.0, first: 0, reach, bounds: everywhere };
        build_pair_list(path, &target_x, &ghosts.target_y, &[set], &mut self.list);
        self.weights.resize(self.list.len(), [0.0; LANES]);
    }

    /// Finds the weights at all mirror points and the wetness of all face points.
    pub fn weigh(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        (records, pressure): (&[Record], &[f64]),
    ) {
        let Exchange { rules, list, weights, scale, means, wetness, .. } = self;
        let rules = *rules;
        with_kernel!(rules.kernel, K => with_interpolator!(rules.interpolator, interpolator => {
            dispatch(path, Weigh::<K, _> {
                interpolator,
                scaling: rules.scaling,
                ghosts,
                bodies,
                records,
                pressure,
                list,
                weights,
                scale,
                means,
                coverage: wetness,
                kernel: std::marker::PhantomData,
            });
        }));
        self.wet_faces(ghosts, bodies);
    }

    /// Turns the kernel coverage of the face points into a wetness: 2 Σ W V over what a full,
    /// endless body of water would give there; 1/2 at the waterline.
    fn wet_faces(&mut self, ghosts: &Ghosts, bodies: &[BodyMotion]) {
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for face in body.faces.clone() {
                let complete = if self.rules.bed_between_walls {
                    self.completeness(ghosts, bodies, number, face)
                } else {
                    1.0
                };
                self.wetness[face] *= 2.0 / complete.max(0.1);
            }
        }
    }

    /// Share of a face point's half disc of water that other walls leave.
    fn completeness(
        &self,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        number: usize,
        face: usize,
    ) -> f64 {
        if number > 0 {
            return self.share(ghosts.target_y[face]);
        }
        let [left, right] = span(ghosts, bodies);
        let x = ghosts.target_x[face];
        self.share(x - left) + self.share(right - x) - 1.0
    }

    /// [`KernelChoice::half_plane_fraction`] at a distance in metres, from a table.
    fn share(&self, distance: f64) -> f64 {
        let at = distance * self.rules.scaling.inverse_radius;
        if at.abs() >= 1.0 {
            return if at > 0.0 { 1.0 } else { 0.0 };
        }
        let place = at.abs() * 256.0;
        let k = (place as usize).min(255);
        let part = place - k as f64;
        let share = self.half_plane[k] * (1.0 - part) + self.half_plane[k + 1] * part;
        if at > 0.0 { share } else { 1.0 - share }
    }

    /// How much of a ghost counts: nothing half a spacing above the waterline, all of it half a
    /// spacing below.
    fn wet_share(&self, face: usize) -> f64 {
        ((self.wetness[face] - self.dry_at) / (self.wet_at - self.dry_at)).clamp(0.0, 1.0)
    }

    /// Writes the ghosts' records: place, volume, pressure and its response to their body's
    /// acceleration, velocity. `ghost_records` are those of the ghosts alone; bodies with
    /// `responds` leave their acceleration out of the pressure and into the response.
    pub fn fill(
        &self,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        responds: usize,
        ghost_records: &mut [Record],
    ) {
        let rules = &self.rules;
        let [left, right] =
            if rules.bed_between_walls { span(ghosts, bodies) } else { [f64::MIN, f64::MAX] };
        for (number, body) in ghosts.bodies.iter().enumerate() {
            let motion = &bodies[number];
            for g in body.ghosts.clone() {
                let record = &mut ghost_records[g].0;
                let (block, lane) = (g / LANES, g % LANES);
                let (x, y) = (ghosts.x[g] + motion.offset, ghosts.y[g]);
                record[Record::X] = x * rules.scaling.inverse_radius;
                record[Record::Y] = y * rules.scaling.inverse_radius;
                if self.scale[block][lane] == 0.0 {
                    record[Record::WEIGHT] = 0.0;
                    record[Record::PRESSURE] = 0.0;
                    record[Record::RESPONSE] = 0.0;
                    record[Record::VX] = motion.velocity;
                    record[Record::VY] = 0.0;
                    continue;
                }
                let wet = match ghosts.face[g] {
                    Site::ALWAYS_WET => 1.0,
                    face => self.wet_share(face as usize),
                };
                let mut volume = ghosts.volume[g] * wet;
                if number == 0 && rules.bed_between_walls {
                    let half = 0.5 * rules.spacing;
                    let inside = (right.min(x + half) - left.max(x - half)) / rules.spacing;
                    volume *= inside.clamp(0.0, 1.0);
                }
                record[Record::WEIGHT] = volume * rules.scaling.weight_per_volume;
                let means = &self.means[block];
                let mean_pressure = means.pressure[lane];
                let density =
                    rules.surface_density + mean_pressure / (rules.sound_speed * rules.sound_speed);
                let anchor = if rules.gravity_in_sum {
                    [means.x[lane], means.y[lane]]
                } else {
                    [ghosts.target_x[g] + motion.offset, ghosts.target_y[g]]
                };
                let (reach_x, reach_y) = (x - anchor[0], y - anchor[1]);
                let still = mean_pressure - density * rules.gravity * reach_y;
                let per_acceleration = -density * reach_x;
                let (pressure, response) = if wet < 1.0 {
                    (still.max(0.0), 0.0)
                } else if number == responds {
                    (still, per_acceleration)
                } else {
                    (still + per_acceleration * motion.acceleration, 0.0)
                };
                record[Record::PRESSURE] = pressure;
                record[Record::RESPONSE] = response;
                let velocity = self.mirrored_velocity(ghosts, g, motion);
                record[Record::VX] = velocity[0];
                record[Record::VY] = velocity[1];
            }
        }
    }

    /// Interpolates the velocities anew, with the weights at hand, and gives them to the ghosts.
    pub fn refresh_velocities(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        (fluid_records, ghost_records): (&[Record], &mut [Record]),
    ) {
        let Exchange { list, weights, scale, means, .. } = self;
        let blocks = ghosts.len() / LANES;
        dispatch(
            path,
            GatherVelocity { list, weights, scale, means, blocks, records: fluid_records },
        );
        for (number, body) in ghosts.bodies.iter().enumerate() {
            for g in body.ghosts.clone() {
                let velocity = self.mirrored_velocity(ghosts, g, &bodies[number]);
                ghost_records[g].0[Record::VX] = velocity[0];
                ghost_records[g].0[Record::VY] = velocity[1];
            }
        }
    }

    /// u_w - (ū - u_w) d_ghost/d̄ across the wall; along it ū goes on (free slip) or is reversed
    /// likewise (no slip). d̄ is the distance of the water that ū was taken from.
    fn mirrored_velocity(&self, ghosts: &Ghosts, g: usize, motion: &BodyMotion) -> [f64; 2] {
        let (block, lane) = (g / LANES, g % LANES);
        if self.scale[block][lane] == 0.0 {
            return [motion.velocity, 0.0];
        }
        let means = &self.means[block];
        let relative = [means.vx[lane] - motion.velocity, means.vy[lane]];
        let x = ghosts.x[g] + motion.offset;
        let apart = [x - means.x[lane], ghosts.y[g] - means.y[lane]];
        let distance = ghosts.distance[g];
        let ratio = |across: f64| {
            if across <= distance * (1.0 + 1.0 / MIRROR_LIMIT) {
                MIRROR_LIMIT
            } else {
                distance / (across - distance)
            }
        };
        let mirrored = match ghosts.reflection[g] {
            Reflection::Corner => {
                let factor = ratio(apart[0].hypot(apart[1]));
                [-factor * relative[0], -factor * relative[1]]
            }
            Reflection::Plane { normal: [nx, ny] } => {
                let factor = ratio(apart[0] * nx + apart[1] * ny);
                let across = relative[0] * nx + relative[1] * ny;
                let along = [relative[0] - across * nx, relative[1] - across * ny];
                let kept = if self.rules.no_slip { -factor } else { 1.0 };
                [kept * along[0] - factor * across * nx, kept * along[1] - factor * across * ny]
            }
        };
        [mirrored[0] + motion.velocity, mirrored[1]]
    }

    /// Level of the water along an upright body, metres above the bed: the crossing of
    /// wetness 1/2 that is connected to the water below.
    pub fn level(&self, ghosts: &Ghosts, body: usize) -> f64 {
        let faces = ghosts.bodies[body].faces.clone();
        let wetness = &self.wetness[faces.clone()];
        let heights = &ghosts.target_y[faces];
        let Some(dry) = wetness.iter().position(|&wet| wet < 0.5) else {
            return heights.last().copied().unwrap_or(0.0);
        };
        if dry == 0 {
            return 0.0;
        }
        let part = (wetness[dry - 1] - 0.5) / (wetness[dry - 1] - wetness[dry]);
        heights[dry - 1] + part * (heights[dry] - heights[dry - 1])
    }

    /// Integral of the interpolated pressure over the face of an upright body, N per metre of
    /// width: a check on the momentum reaction that shares nothing with it but the particles.
    pub fn face_force(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        body: usize,
        motion: &BodyMotion,
        (records, pressure): (&[Record], &[f64]),
    ) -> f64 {
        let faces = ghosts.bodies[body].faces.clone();
        let rules = self.rules;
        let blocks = faces.start / LANES..faces.end.div_ceil(LANES);
        let Exchange { list, weights, scale, means, .. } = self;
        with_kernel!(rules.kernel, K => with_interpolator!(rules.interpolator, interpolator => {
            dispatch(path, Interpolate::<K, _> {
                interpolator,
                scaling: rules.scaling,
                ghosts,
                offset: motion.offset,
                records,
                pressure,
                list,
                weights,
                scale,
                means,
                blocks,
                kernel: std::marker::PhantomData,
            });
        }));
        faces
            .map(|face| {
                let (block, lane) = (face / LANES, face % LANES);
                let wet = self.wet_share(face);
                if self.scale[block][lane] == 0.0 {
                    return 0.0;
                }
                let means = &self.means[block];
                let mean = means.pressure[lane];
                let density =
                    rules.surface_density + mean / (rules.sound_speed * rules.sound_speed);
                let reach_x = ghosts.target_x[face] + motion.offset - means.x[lane];
                let reach_y = ghosts.target_y[face] - means.y[lane];
                let pressure =
                    mean - density * (rules.gravity * reach_y + motion.acceleration * reach_x);
                wet * pressure * rules.spacing
            })
            .sum()
    }
}

/// Faces of the bodies 1 and 2: the ends of the bed.
fn span(ghosts: &Ghosts, bodies: &[BodyMotion]) -> [f64; 2] {
    let face = |body: usize| ghosts.target_x[ghosts.bodies[body].faces.start] + bodies[body].offset;
    [face(1), face(2)]
}

struct Weigh<'a, K, I> {
    interpolator: I,
    scaling: Scaling,
    ghosts: &'a Ghosts,
    bodies: &'a [BodyMotion],
    records: &'a [Record],
    pressure: &'a [f64],
    list: &'a PairList,
    weights: &'a mut [[f64; LANES]],
    scale: &'a mut [[f64; LANES]],
    means: &'a mut [Means],
    coverage: &'a mut [f64],
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, I: Interpolator> Task for Weigh<'_, K, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (xs, _) = self.ghosts.target_x.as_chunks::<LANES>();
        let (ys, _) = self.ghosts.target_y.as_chunks::<LANES>();
        let (coverage, _) = self.coverage.as_chunks_mut::<LANES>();
        let ghost_blocks = self.ghosts.len() / LANES;
        let inverse = L::splat(self.scaling.inverse_radius);
        for block in 0..xs.len() {
            let offset = self.bodies[self.ghosts.target_body[block] as usize].offset;
            let x = (L::load(&xs[block]) + L::splat(offset)) * inverse;
            let y = L::load(&ys[block]) * inverse;
            let neighbours = self.list.group(block, 0);
            if block < ghost_blocks {
                let start = self.list.start(block, 0);
                let weights = &mut self.weights[start..start + neighbours.len()];
                let scale =
                    self.interpolator.weigh::<K, L>(x, y, neighbours, self.records, weights);
                scale.store(&mut self.scale[block]);
                self.means[block] = gather::<L>(
                    neighbours,
                    (self.records, self.pressure),
                    weights,
                    scale,
                    self.scaling,
                );
            } else {
                let mut sum = L::splat(0.0);
                for &j in neighbours {
                    let record = &self.records[j as usize].0;
                    let dx = x - L::splat(record[Record::X]);
                    let dy = y - L::splat(record[Record::Y]);
                    let s = dx.mul_add(dx, dy * dy).max(L::splat(1e-12));
                    sum = K::shape(s, s.rsqrt()).mul_add(L::splat(record[Record::WEIGHT]), sum);
                }
                (sum * L::splat(self.scaling.support_radius)).store(&mut coverage[block]);
            }
        }
    }
}

struct Interpolate<'a, K, I> {
    interpolator: I,
    scaling: Scaling,
    ghosts: &'a Ghosts,
    offset: f64,
    records: &'a [Record],
    pressure: &'a [f64],
    list: &'a PairList,
    weights: &'a mut [[f64; LANES]],
    scale: &'a mut [[f64; LANES]],
    means: &'a mut [Means],
    blocks: std::ops::Range<usize>,
    kernel: std::marker::PhantomData<K>,
}

impl<K: Kernel, I: Interpolator> Task for Interpolate<'_, K, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let (xs, _) = self.ghosts.target_x.as_chunks::<LANES>();
        let (ys, _) = self.ghosts.target_y.as_chunks::<LANES>();
        let inverse = L::splat(self.scaling.inverse_radius);
        for block in self.blocks {
            let x = (L::load(&xs[block]) + L::splat(self.offset)) * inverse;
            let y = L::load(&ys[block]) * inverse;
            let neighbours = self.list.group(block, 0);
            let start = self.list.start(block, 0);
            let weights = &mut self.weights[start..start + neighbours.len()];
            let scale = self.interpolator.weigh::<K, L>(x, y, neighbours, self.records, weights);
            scale.store(&mut self.scale[block]);
            self.means[block] = gather::<L>(
                neighbours,
                (self.records, self.pressure),
                weights,
                scale,
                self.scaling,
            );
        }
    }
}

#[inline(always)]
fn gather<L: Lanes>(
    neighbours: &[u32],
    (records, pressure): (&[Record], &[f64]),
    weights: &[[f64; LANES]],
    scale: L,
    scaling: Scaling,
) -> Means {
    let mut sums = [L::splat(0.0); 5];
    for (&j, weight) in neighbours.iter().zip(weights) {
        let record = &records[j as usize].0;
        let weight = L::load(weight);
        sums[0] = weight.mul_add(L::splat(pressure[j as usize]), sums[0]);
        let slots = [Record::X, Record::Y, Record::VX, Record::VY];
        for (sum, slot) in sums[1..].iter_mut().zip(slots) {
            *sum = weight.mul_add(L::splat(record[slot]), *sum);
        }
    }
    let to_metres = scale * L::splat(scaling.support_radius);
    Means {
        pressure: (sums[0] * scale).to_array(),
        x: (sums[1] * to_metres).to_array(),
        y: (sums[2] * to_metres).to_array(),
        vx: (sums[3] * scale).to_array(),
        vy: (sums[4] * scale).to_array(),
    }
}

struct GatherVelocity<'a> {
    list: &'a PairList,
    weights: &'a [[f64; LANES]],
    scale: &'a [[f64; LANES]],
    means: &'a mut [Means],
    blocks: usize,
    records: &'a [Record],
}

impl Task for GatherVelocity<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        for block in 0..self.blocks {
            let neighbours = self.list.group(block, 0);
            let start = self.list.start(block, 0);
            let (mut vx, mut vy) = (L::splat(0.0), L::splat(0.0));
            for (&j, weight) in neighbours.iter().zip(&self.weights[start..]) {
                let record = &self.records[j as usize].0;
                let weight = L::load(weight);
                vx = weight.mul_add(L::splat(record[Record::VX]), vx);
                vy = weight.mul_add(L::splat(record[Record::VY]), vy);
            }
            let scale = L::load(&self.scale[block]);
            (vx * scale).store(&mut self.means[block].vx);
            (vy * scale).store(&mut self.means[block].vy);
        }
    }
}
