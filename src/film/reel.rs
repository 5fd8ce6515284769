//! The frames of a film, packed with all other data for the page's script.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::codec::{self, Point};
use super::scale;
use super::stage::Stage;
use super::take::Take;
use crate::math::decimal::significant;
use crate::simulation::{CaseResult, HistoryRow, Maximum};

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
/// Largest number of points of a curve.
const MOST_POINTS: usize = 800;

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

/// F*, R* and X* over time, at each change, with the ends of their axes.
fn curves(result: &CaseResult, force_unit: &str) -> Value {
    let history = &result.history;
    let rows: Vec<_> = history.iter().step_by(history.len().div_ceil(MOST_POINTS).max(1)).collect();
    let read = |read: fn(&HistoryRow) -> f64| rows.iter().map(move |row| five_digits(read(row)));
    let mut curves = Vec::new();
    let mut curve = |symbol: &str,
                     name: &str,
                     of: fn(&HistoryRow) -> f64,
                     quoted: Option<Maximum>| {
        let values: Vec<f64> = read(of).collect();
        if values.iter().any(|&value| value != values[0]) {
            let all: Vec<f64> = history.iter().map(of).collect();
            let [low, high] = axis(&all, quoted.map(|maximum| maximum.value)).map(five_digits);
            let curve = json!({ "symbol": symbol, "name": name, "values": values, "low": low, "high": high });
            curves.push(curve);
        }
    };
    let outcome = &result.outcome;
    let (force, runup) = (Some(outcome.force_max), Some(outcome.runup_max));
    curve("F*", &format!("force on the wall over {force_unit}"), |row| row.force, force);
    curve("R*", "runup over h", |row| row.runup, runup);
    curve(
        "X*",
        "displacement of the wall over h",
        |row| row.displacement,
        outcome.displacement_max,
    );
    let times = moments(rows.iter().map(|row| row.time_s));
    json!({ "time_s": times.collect::<Value>(), "curves": curves })
}

/// The ends of a curve's axis. It goes up to the quoted maximum, which has no impact on the stop in
/// it, and down to values that last. A spike leaves the axis, as does suction that is larger than
/// the maximum. A surface may fall by all of its depth, 1, however little it rose.
fn axis(values: &[f64], quoted: Option<f64>) -> [f64; 2] {
    let middle = |window: &[f64]| {
        let mut window = window.to_vec();
        window.sort_by(f64::total_cmp);
        window[window.len() / 2]
    };
    let lasting: Vec<f64> = values.windows(values.len().clamp(1, 5)).map(middle).collect();
    let most = lasting.iter().copied().fold(0.0, f64::max);
    let high = quoted.filter(|quoted| quoted.is_finite() && *quoted > 0.0).unwrap_or(most);
    let low = lasting.iter().copied().fold(0.0, f64::min).max(-high.max(1.0));
    if high - low > 1e-9 { [low, low + 1.05 * (high - low)] } else { [low, low + 1.0] }
}

fn five_digits(value: f64) -> f64 {
    significant(value, 5)
}

/// Times with five digits relative to the span from first to last. A recorded clock may begin far
/// from 0.
fn moments(times: impl Iterator<Item = f64> + Clone) -> impl Iterator<Item = f64> {
    let (first, last) = (times.clone().next(), times.clone().last());
    let [first, last] = [first, last].map(Option::unwrap_or_default);
    let far = libm::log10(last / (last - first)).floor();
    let more = if far.is_finite() { far.max(0.0) as usize } else { 0 };
    times.map(move |time| significant(time, 5 + more))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An impact on the stop once set the scale, so that the wave was hardly visible.
    #[test]
    fn the_axis_reaches_to_the_quoted_maximum_and_a_spike_leaves_it() {
        let wave = |k: i32| 1.0 + 1.5 / (0.1 * f64::from(k - 100)).cosh();
        let mut values: Vec<_> = (0..300).map(wave).collect();
        values[220] = 40.0;
        values[222] = -30.0;
        assert_eq!(axis(&values, Some(2.5)), [0.0, 2.625]);
        let [low, high] = axis(&values, None);
        assert!(low == 0.0 && (2.5..2.7).contains(&high), "{high}");
        assert_eq!(axis(&[], None), [0.0, 1.0]);
        assert_eq!(axis(&[0.0, -9.0, -9.0, -9.0, -9.0, -9.0, 0.0], Some(3.0))[0], -3.0);
    }

    /// A wall that moved away once lowered the surface by more than it had risen, and the end of
    /// the curve was cut off.
    #[test]
    fn a_surface_that_falls_further_than_it_rose_stays_in_the_panel() {
        let fall: Vec<_> = (0..100).map(|k| 0.38 - 0.0082 * f64::from(k)).collect();
        let [low, high] = axis(&fall, Some(0.38));
        assert!(low < -0.41 && high > 0.38, "{low} to {high}");
    }

    /// Every second of a film once had the same time, because its clock began at 86400 s.
    #[test]
    fn times_far_from_zero_are_told_as_finely_as_those_near_it() {
        let told = |begin: f64| {
            moments((0..60).map(move |k| begin + 0.08123 * f64::from(k))).collect::<Vec<_>>()
        };
        let near = told(0.0);
        assert_eq!(near[1..3], [0.08123, 0.16246]);
        for begin in [258.0, 86400.125, 1.7e9] {
            for (far, near) in told(begin).iter().zip(&near) {
                assert!((far - begin - near).abs() < 1e-3, "{far}");
            }
        }
        assert_eq!(moments([1.23456789].into_iter()).collect::<Vec<_>>(), [1.2346]);
    }

    /// In a flume of 23 m one two-thousandth of its length is more than a spacing.
    #[test]
    fn places_are_told_to_a_part_of_a_spacing_in_long_tanks_too() {
        assert_eq!(finest_quantum(2.5, 0.01), 2.5 / FARTHEST);
        assert_eq!(finest_quantum(23.2, 0.008), 0.002);
        assert_eq!(finest_quantum(1000.0, 0.01), 1000.0 / HIGHEST);
    }
}
