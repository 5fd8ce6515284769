//! The ghosts in a full step: records, and images that hold until the next one.

use std::mem::take;

use super::crest::lying;
use super::exchange::Exchange;
use super::faces::span;
use super::ghost_part::GhostPart;
use super::ghosts::{Ghosts, Reflection, Site};
use super::image::{Image, Mirror, Press};
use super::sums::Means;
use crate::body::{BodyMotion, Place};
use crate::math::simd::{LANES, SimdPath, dispatch};
use crate::math::team::First;
use crate::pairs::Record;

impl Exchange {
    /// Writes the ghosts' records: place, volume, pressure and its response to their body's
    /// acceleration, velocity. `ghost_records` are those of the ghosts alone. For the body number
    /// `responds` the acceleration is not in the pressure but in the response.
    pub fn fill(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        responds: usize,
        ghost_records: &mut [Record],
    ) {
        let span =
            if self.rules.bed_between_walls { span(ghosts, bodies) } else { [f64::MIN, f64::MAX] };
        let wet = (0..ghosts.len() / LANES).filter(|&block| self.scale[block] != [0.0; LANES]);
        self.counting.clear();
        self.counting.extend(wet.map(|block| block as u32));
        let (mut images, mut responses) = (take(&mut self.images), take(&mut self.responses));
        let mut parts = take(&mut self.parts);
        let (own, of_records) = (First(&mut images, 1), First(ghost_records, LANES));
        let rows = (own, (First(&mut responses, LANES), of_records));
        self.team.share(&mut parts, rows, &|part, (First(images, _), (responses, records))| {
            let filling = Filling { exchange: self, ghosts, bodies, responds, span };
            filling.fill(path, part, images, (responses.0, records.0));
        });
        (self.images, self.responses) = (images, responses);
        self.fallbacks = parts.iter().map(|part| part.fallbacks).sum();
        self.parts = parts;
    }
}

/// The inputs for ghosts: see [`Exchange::fill`].
struct Filling<'a> {
    exchange: &'a Exchange,
    ghosts: &'a Ghosts,
    bodies: &'a [BodyMotion],
    responds: usize,
    /// x of the walls' faces, metres, if the bed counts only between them.
    span: [f64; 2],
}

impl Filling<'_> {
    /// Fills the images, responses and records of a part.
    fn fill(
        &self,
        path: SimdPath,
        part: &mut GhostPart,
        images: &mut [Image],
        (responses, records): (&mut [[f64; 3]], &mut [Record]),
    ) {
        let Filling { exchange, ghosts, bodies, .. } = *self;
        let (responses, _) = responses.as_chunks_mut::<LANES>();
        let (records, _) = records.as_chunks_mut::<LANES>();
        let rows = images.iter_mut().zip(responses).zip(&mut *records);
        part.fallbacks = 0;
        for (block, ((image, responses), records)) in part.blocks.clone().zip(rows) {
            let body = ghosts.target_body[block] as usize;
            let motion = &bodies[body];
            self.place(block, motion.offset, image, records);
            *responses = [[0.0; 3]; LANES];
            // Most blocks are dry.
            if exchange.scale[block] == [0.0; LANES] {
                records.iter_mut().for_each(|record| leave_dry(record, motion));
                continue;
            }
            for (lane, (record, response)) in records.iter_mut().zip(responses).enumerate() {
                let g = block * LANES + lane;
                let Some((volume, wet)) = self.volume((body, g), motion) else {
                    leave_dry(record, motion);
                    continue;
                };
                record.0[Record::WEIGHT] = volume * exchange.rules.scaling.weight_per_volume;
                part.fallbacks += u64::from(volume != 0.0 && exchange.fallen[block][lane] > 0.5);
                *response = self.reflect((g, wet), motion, body == self.responds, image);
            }
        }
        let (blocks, first) = (part.among(&exchange.counting), part.blocks.start);
        let (means, rules) = (&exchange.means[first..], exchange.rules);
        let factors = None;
        dispatch(path, Press { blocks, first, images, means, ghosts, bodies, rules, factors });
        dispatch(path, Mirror { blocks, first, images, means, ghosts, bodies, factors: None });
        for &block in blocks {
            let row = block as usize - first;
            let (image, scale) = (&mut images[row], &exchange.scale[block as usize]);
            for (lane, record) in records[row].iter_mut().enumerate() {
                if scale[lane] != 0.0 {
                    take_over(image, lane, record);
                }
            }
            image.mirror = image.smooth;
        }
    }

    /// Puts a block of ghosts in its place.
    fn place(&self, block: usize, offset: f64, image: &mut Image, records: &mut [Record; LANES]) {
        let Filling { exchange, ghosts, .. } = *self;
        let inverse_radius = exchange.rules.scaling.inverse_radius;
        let [x, y] = &mut image.place;
        let (from_x, from_y) = (&ghosts.x[block * LANES..], &ghosts.y[block * LANES..]);
        for (lane, record) in records.iter_mut().enumerate() {
            x[lane] = (from_x[lane] + offset) * inverse_radius;
            y[lane] = from_y[lane] * inverse_radius;
            (record.0[Record::X], record.0[Record::Y]) = (x[lane], y[lane]);
        }
    }

    /// The volume of a ghost that counts, and its wetness, if there is water in reach.
    fn volume(&self, (body, g): (usize, usize), motion: &BodyMotion) -> Option<(f64, f64)> {
        let Filling { exchange, ghosts, span: [left, right], .. } = *self;
        let rules = &exchange.rules;
        if exchange.scale[g / LANES][g % LANES] == 0.0 {
            return None;
        }
        let wet = exchange.wet_share_of(ghosts, body, g)
            * self.share_on_crest(body, g)
            * self.share_on_top(g);
        let mut volume = ghosts.volume[g] * wet;
        if body == 0 && rules.bed_between_walls {
            let (x, half) = (ghosts.x[g] + motion.offset, 0.5 * rules.spacing);
            let inside = (right.min(x + half) - left.max(x - half)) / rules.spacing;
            volume *= inside.clamp(0.0, 1.0);
        }
        Some((volume, wet))
    }

    /// The share of a ghost under a crest, see [`Crest::carried`](super::Crest).
    fn share_on_crest(&self, body: usize, g: usize) -> f64 {
        let Filling { exchange, ghosts, .. } = *self;
        let level = Reflection::Plane { normal: [0.0, -1.0] };
        match &ghosts.crest {
            Some(crest) if body == Place::Right.number() && ghosts.reflection[g] == level => {
                let means = &exchange.means[g / LANES];
                let mean = [means.x[g % LANES], means.y[g % LANES]];
                crest.carried(ghosts.target_x[g], mean, exchange.rules.spacing)
            }
            _ => 1.0,
        }
    }

    /// The share of one of two ghosts at the edge of a dry top. The one under the top counts by the
    /// share of the water on the top. The one behind the face counts for the rest.
    fn share_on_top(&self, g: usize) -> f64 {
        let Filling { exchange, ghosts, .. } = *self;
        let under = match ghosts.twin[g] {
            Site::ALONE => return 1.0,
            _ if ghosts.face[g] == Site::ALWAYS_WET => g,
            twin => twin as usize,
        };
        let (block, lane) = (under / LANES, under % LANES);
        let share = match ghosts.reflection[under] {
            Reflection::Plane { normal: [nx, ny] } if exchange.scale[block][lane] != 0.0 => {
                let means = &exchange.means[block];
                let [x, y] = [means.x[lane] - ghosts.x[under], means.y[lane] - ghosts.y[under]];
                let above = -nx * x - ny * y - ghosts.distance[under];
                lying(above, exchange.rules.spacing)
            }
            _ => 0.0,
        };
        if under == g { share } else { 1.0 - share }
    }

    /// Finds the image's coefficients from the means at the mirror point; returns its response.
    fn reflect(
        &self,
        (g, wet): (usize, f64),
        motion: &BodyMotion,
        responds: bool,
        image: &mut Image,
    ) -> [f64; 3] {
        let Filling { exchange, ghosts, .. } = *self;
        let lane = g % LANES;
        // Under a thin sheet of water on a bed or a crest, ghosts stand for deep water.
        let correction = if ghosts.is_deep(g) {
            [1.0, 0.0, 1.0]
        } else {
            mirrored_correction(&exchange.means[g / LANES], lane, ghosts.reflection[g])
        };
        let [x, y] = exchange.lever(ghosts, g, motion);
        let whole = wet >= 1.0;
        let lever = [if whole && !responds { x } else { 0.0 }, y];
        let response = if whole && responds { -exchange.density(g) * x } else { 0.0 };
        let smooth = exchange.mirror(ghosts, g, motion, false);
        let stuck = exchange.rules.no_slip;
        let mirror = if stuck { exchange.mirror(ghosts, g, motion, true) } else { smooth };
        for part in 0..3 {
            image.correction[part][lane] = correction[part];
            image.mirror[part][lane] = mirror[part];
            image.smooth[part][lane] = smooth[part];
        }
        image.lever[0][lane] = lever[0];
        image.lever[1][lane] = lever[1];
        image.falling[lane] = exchange.falling(ghosts, g, [x, y]);
        image.lowest[lane] = if whole { f64::NEG_INFINITY } else { 0.0 };
        let [xx, xy, yy] = correction;
        [response * xx, response * xy, response * yy]
    }
}

/// Puts velocity and pressure of an image into its record.
#[inline(always)]
fn take_over(image: &Image, lane: usize, record: &mut Record) {
    let (pressure, [u, v], [xx, xy, yy]) =
        (image.pressure[lane], &image.velocity, &image.correction);
    record.set_velocity([u[lane], v[lane]]);
    record.set_pressure([pressure * xx[lane], pressure * xy[lane], pressure * yy[lane]]);
}

/// A ghost without water in reach moves with its wall and has no weight.
fn leave_dry(record: &mut Record, motion: &BodyMotion) {
    let record = &mut record.0;
    record[Record::WEIGHT] = 0.0;
    record[Record::VX] = motion.velocity;
    record[Record::VY] = 0.0;
    record[Record::PRESSURE..].fill(0.0);
}

/// The correction beyond a wall is the mirror image of the water's. So both sides of the waterline
/// press alike.
fn mirrored_correction(means: &Means, lane: usize, reflection: Reflection) -> [f64; 3] {
    let [xx, xy, yy] = &means.correction;
    let [xx, xy, yy] = [xx[lane], xy[lane], yy[lane]];
    match reflection {
        Reflection::Corner => [xx, xy, yy],
        Reflection::Plane { normal: [nx, ny] } => {
            // H C H with H = I - 2 n nᵀ.
            let (a, b, d) = (1.0 - 2.0 * nx * nx, -2.0 * nx * ny, 1.0 - 2.0 * ny * ny);
            let (p, q) = (a * xx + b * xy, a * xy + b * yy);
            let (r, s) = (b * xx + d * xy, b * xy + d * yy);
            [p * a + q * b, p * b + q * d, r * b + s * d]
        }
    }
}
