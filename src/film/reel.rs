//! The frames of a film, packed with all other data for the page's script.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::codec::{self, Point};
use super::curves::{curves, five_digits, moments};
use super::scale;
use super::stage::Stage;
use super::take::Take;
use crate::simulation::CaseResult;

/// Places are whole numbers up to this, eleven bits, ...
const FARTHEST: f64 = 2047.0;
/// ... but in a long tank there are at least this many per particle spacing, ...
const PER_SPACING: f64 = 4.0;
/// ... and never more than sixteen bits.
const HIGHEST: f64 = 32767.0;
/// They are coarser by these factors if the film takes too much space, as with water that is torn
/// apart.
const COARSER: [f64; 2] = [2.0, 4.0];
/// Space for a particle in a frame, bytes, unless the film is small anyway.
const ROOM: f64 = 0.4;
const LITTLE_ROOM: usize = 100_000;

/// The frames of a film, and their surroundings.
pub(super) struct Reel<'a> {
    pub takes: &'a [Take],
    /// The frame of the largest force.
    pub crest: usize,
    /// The frame of the highest runup.
    pub highest: usize,
    pub stage: &'a Stage,
    /// End of the scale of colours.
    pub end: f64,
}

/// All frames as bytes.
struct Packed {
    /// Metres.
    quantum: f64,
    /// Particles in a column.
    column: usize,
    bytes: Vec<u8>,
}

impl Reel<'_> {
    /// All data for the script; F* is over this unit.
    pub fn json(&self, result: &CaseResult, force_unit: &str) -> Value {
        let [left, low, span] = self.extent();
        let particles = self.takes[0].points.len();
        let room = (ROOM * (self.takes.len() * particles) as f64) as usize;
        let finest = finest_quantum(span, self.stage.spacing);
        let mut packed = self.pack([left, low], finest);
        for times in COARSER {
            if packed.bytes.len() > room.max(LITTLE_ROOM) {
                packed = self.pack([left, low], times * finest);
            }
        }
        let times = |read: fn(&Take) -> f64| self.takes.iter().map(read).map(five_digits);
        let mut film = serde_json::to_value(self.stage).unwrap_or_default();
        film["particles"] = json!(particles);
        film["column"] = json!(packed.column);
        film["x0"] = json!(left);
        film["y0"] = json!(low);
        film["quantum"] = json!(packed.quantum);
        film["crest"] = json!(self.crest);
        film["highest"] = json!(self.highest);
        film["times"] = moments(self.takes.iter().map(|take| take.time_s)).collect();
        film["left"] = times(|take| take.walls[0]).collect();
        film["right"] = times(|take| take.walls[1]).collect();
        film["colours"] = json!(scale::colours());
        film["history"] = curves(result, force_unit);
        film["data"] = json!(STANDARD.encode(&packed.bytes));
        film
    }

    /// The frames with places in quanta of this many metres, from a corner.
    fn pack(&self, [left, low]: [f64; 2], quantum: f64) -> Packed {
        let place = |value: f32, from: f64| ((f64::from(value) - from) / quantum) as f32;
        let point =
            |&[x, y, value]: &Point| [place(x, left), place(y, low), scale::level(value, self.end)];
        let frame = |take: &Take| -> Vec<Point> { take.points.iter().map(point).collect() };
        let frames: Vec<_> = self.takes.iter().map(frame).collect();
        let (order, column) = codec::order(&frames[0], (self.stage.spacing / quantum) as f32);
        Packed { quantum, column, bytes: codec::encode(&frames, &order, column) }
    }

    /// The left and the lower side of all water, and its extent, metres.
    fn extent(&self) -> [f64; 3] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in self.takes.iter().flat_map(|take| &take.points) {
            for axis in 0..2 {
                low[axis] = low[axis].min(f64::from(point[axis]));
                high[axis] = high[axis].max(f64::from(point[axis]));
            }
        }
        [low[0], low[1], (high[0] - low[0]).max(high[1] - low[1]).max(1e-9)]
    }
}

/// The quantum for places over this span, with this particle spacing; metres.
fn finest_quantum(span: f64, spacing: f64) -> f64 {
    (span / FARTHEST).min(spacing / PER_SPACING).max(span / HIGHEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In a flume of 23 m one two-thousandth of its length is more than a spacing.
    #[test]
    fn places_are_told_to_a_part_of_a_spacing_in_long_tanks_too() {
        assert_eq!(finest_quantum(2.5, 0.01), 2.5 / FARTHEST);
        assert_eq!(finest_quantum(23.2, 0.008), 0.002);
        assert_eq!(finest_quantum(1000.0, 0.01), 1000.0 / HIGHEST);
    }
}
