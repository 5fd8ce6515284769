//! The curves under a film: force, runup and displacement over time.

use serde_json::{Value, json};

use crate::math::decimal::significant;
use crate::simulation::{CaseResult, HistoryRow, Maximum};

/// Usual number of points of a long curve.
const USUAL_POINTS: usize = 1000;

/// F*, R* and X* over time, at each change, with the ends of their axes.
pub(super) fn curves(result: &CaseResult, force_unit: &str) -> Value {
    let history = &result.history;
    let rows = telling(history);
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

/// Rows of a history with every peak, some [`USUAL_POINTS`] of a long one: the first of every few, and those in which
/// force, runup or displacement is lowest or highest among them.
fn telling(history: &[HistoryRow]) -> Vec<&HistoryRow> {
    let size = history.len().div_ceil(USUAL_POINTS / 4).max(1);
    let of: [fn(&HistoryRow) -> f64; 3] =
        [|row| row.force, |row| row.runup, |row| row.displacement];
    let told = |rows: &[HistoryRow]| {
        let extreme = of.iter().flat_map(|of| {
            let by = |&a: &usize, &b: &usize| of(&rows[a]).total_cmp(&of(&rows[b]));
            [(0..rows.len()).min_by(by), (0..rows.len()).max_by(by)]
        });
        let mut told: Vec<usize> = extreme.flatten().chain([0]).collect();
        told.sort_unstable();
        told.dedup();
        told
    };
    history.chunks(size).flat_map(|rows| told(rows).into_iter().map(|at| &rows[at])).collect()
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

pub(super) fn five_digits(value: f64) -> f64 {
    significant(value, 5)
}

/// Times with five digits relative to the span from first to last. A recorded clock may begin far
/// from 0.
pub(super) fn moments(times: impl Iterator<Item = f64> + Clone) -> impl Iterator<Item = f64> {
    let (first, last) = (times.clone().next(), times.clone().last());
    let [first, last] = [first, last].map(Option::unwrap_or_default);
    let far = libm::log10(last / (last - first)).ceil();
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

    /// The story: of 1,200 samples every second was left out, and with it the largest force.
    #[test]
    fn a_long_history_keeps_its_peaks() {
        let row = |k: i32| HistoryRow {
            time_s: 0.01 * f64::from(k),
            force: if k == 777 { 3.0 } else { 1.0 },
            runup: if k == 778 { -0.2 } else { 0.1 },
            displacement: 0.0,
            wall_velocity_m_per_s: 0.0,
        };
        let rows: Vec<_> = (0..5000).map(row).collect();
        let told = telling(&rows);
        assert!(told.len() <= USUAL_POINTS, "{}", told.len());
        assert!(told.iter().any(|row| row.force == 3.0) && told.iter().any(|row| row.runup < 0.0));
        assert!(told.windows(2).all(|pair| pair[0].time_s < pair[1].time_s));
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
}
