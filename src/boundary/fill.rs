//! What a full step makes of the ghosts: records, and images that hold until the next one.

use super::exchange::Exchange;
use super::faces::span;
use super::ghosts::{Ghosts, Reflection};
use super::sums::Means;
use crate::body::{BodyMotion, Place};
use crate::math::simd::{LANES, SimdPath};
use crate::pairs::Record;

/// Water lies on a crest whose mean is so many spacings above it: half of what a single row has.
const LIES_ON: f64 = 0.25;

impl Exchange {
    /// Writes the ghosts' records: place, volume, pressure and its response to their body's
    /// acceleration, velocity. `ghost_records` are those of the ghosts alone; the body number
    /// `responds` has its acceleration left out of the pressure and put into the response.
    pub fn fill(
        &mut self,
        path: SimdPath,
        ghosts: &Ghosts,
        bodies: &[BodyMotion],
        responds: usize,
        ghost_records: &mut [Record],
    ) {
        self.fallbacks = 0;
        self.counting.clear();
        let span =
            if self.rules.bed_between_walls { span(ghosts, bodies) } else { [f64::MIN, f64::MAX] };
        for (number, body) in ghosts.bodies.iter().enumerate() {
            let motion = &bodies[number];
            for block in body.ghosts.start / LANES..body.ghosts.end / LANES {
                let records = &mut ghost_records[block * LANES..][..LANES];
                self.place(ghosts, block, motion.offset, records);
                self.responses[block * LANES..][..LANES].fill([0.0; 3]);
                // Most blocks are dry.
                if self.scale[block] == [0.0; LANES] {
                    records.iter_mut().for_each(|record| leave_dry(record, motion));
                    continue;
                }
                self.counting.push(block as u32);
                for (lane, record) in records.iter_mut().enumerate() {
                    let g = block * LANES + lane;
                    let Some((volume, wet)) = self.volume(ghosts, (number, g), motion, span) else {
                        leave_dry(record, motion);
                        continue;
                    };
                    record.0[Record::WEIGHT] = volume * self.rules.scaling.weight_per_volume;
                    self.fallbacks += u64::from(volume != 0.0 && self.fallen[block][lane] > 0.5);
                    self.reflect(ghosts, (g, wet), motion, number == responds);
                }
            }
        }
        self.press(path, ghosts, bodies);
        self.mirror_velocities(path, ghosts, bodies);
        for &block in &self.counting {
            let at = block as usize * LANES;
            let image = &mut self.images[block as usize];
            for (lane, record) in ghost_records[at..at + LANES].iter_mut().enumerate() {
                let record = &mut record.0;
                if self.scale[block as usize][lane] != 0.0 {
                    let pressure = image.pressure[lane];
                    record[Record::VX] = image.velocity[0][lane];
                    record[Record::VY] = image.velocity[1][lane];
                    record[Record::PRESSURE] = pressure * image.correction[0][lane];
                    record[Record::PRESSURE_XY] = pressure * image.correction[1][lane];
                    record[Record::PRESSURE_YY] = pressure * image.correction[2][lane];
                }
            }
            image.mirror = image.smooth;
        }
    }

    /// Puts a block of ghosts in its place.
    fn place(&mut self, ghosts: &Ghosts, block: usize, offset: f64, records: &mut [Record]) {
        let inverse_radius = self.rules.scaling.inverse_radius;
        let [x, y] = &mut self.images[block].place;
        let (from_x, from_y) = (&ghosts.x[block * LANES..], &ghosts.y[block * LANES..]);
        for (lane, record) in records.iter_mut().enumerate() {
            x[lane] = (from_x[lane] + offset) * inverse_radius;
            y[lane] = from_y[lane] * inverse_radius;
            (record.0[Record::X], record.0[Record::Y]) = (x[lane], y[lane]);
        }
    }

    /// The volume of a ghost that counts, and how wet it is, where there is water in reach.
    fn volume(
        &self,
        ghosts: &Ghosts,
        (body, g): (usize, usize),
        motion: &BodyMotion,
        [left, right]: [f64; 2],
    ) -> Option<(f64, f64)> {
        let rules = &self.rules;
        if self.scale[g / LANES][g % LANES] == 0.0 {
            return None;
        }
        let wet = self.wet_share_of(ghosts, body, g) * self.share_on_crest(ghosts, body, g);
        let mut volume = ghosts.volume[g] * wet;
        if body == 0 && rules.bed_between_walls {
            let (x, half) = (ghosts.x[g] + motion.offset, 0.5 * rules.spacing);
            let inside = (right.min(x + half) - left.max(x - half)) / rules.spacing;
            volume *= inside.clamp(0.0, 1.0);
        }
        Some((volume, wet))
    }

    /// How much a ghost under a crest counts. Water that climbs the face is in reach of its mirror point, too, and
    /// would be reflected downwards: only water that lies on the crest counts.
    fn share_on_crest(&self, ghosts: &Ghosts, body: usize, g: usize) -> f64 {
        let level = Reflection::Plane { normal: [0.0, -1.0] };
        match &ghosts.crest {
            Some(crest) if body == Place::Right.number() && ghosts.reflection[g] == level => {
                let above = self.means[g / LANES].y[g % LANES] - crest.height;
                (above / (LIES_ON * self.rules.spacing)).clamp(0.0, 1.0)
            }
            _ => 1.0,
        }
    }

    /// Finds what makes a ghost of the means at its mirror point.
    fn reflect(
        &mut self,
        ghosts: &Ghosts,
        (g, wet): (usize, f64),
        motion: &BodyMotion,
        responds: bool,
    ) {
        let (block, lane) = (g / LANES, g % LANES);
        // A thin sheet of water on a bed or a crest goes on below as the deep water that its ghosts stand for.
        let correction = if ghosts.is_deep(g) {
            [1.0, 0.0, 1.0]
        } else {
            mirrored_correction(&self.means[block], lane, ghosts.reflection[g])
        };
        let [x, y] = self.lever(ghosts, g, motion);
        let whole = wet >= 1.0;
        let lever = [if whole && !responds { x } else { 0.0 }, y];
        let response = if whole && responds { -self.density(g) * x } else { 0.0 };
        let smooth = self.mirror(ghosts, g, motion, false);
        let mirror = if self.rules.no_slip { self.mirror(ghosts, g, motion, true) } else { smooth };
        let image = &mut self.images[block];
        for part in 0..3 {
            image.correction[part][lane] = correction[part];
            image.mirror[part][lane] = mirror[part];
            image.smooth[part][lane] = smooth[part];
            self.responses[g][part] = response * correction[part];
        }
        image.lever[0][lane] = lever[0];
        image.lever[1][lane] = lever[1];
        image.lowest[lane] = if whole { f64::NEG_INFINITY } else { 0.0 };
    }
}

/// What has no water in reach goes with its wall, and counts for nothing.
fn leave_dry(record: &mut Record, motion: &BodyMotion) {
    let record = &mut record.0;
    record[Record::WEIGHT] = 0.0;
    record[Record::VX] = motion.velocity;
    record[Record::VY] = 0.0;
    record[Record::PRESSURE..].fill(0.0);
}

/// The correction beyond a wall is the mirror image of the water's: then both sides of the
/// waterline press alike.
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
