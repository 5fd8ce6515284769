//! A measured record beside the same columns of a case.

use std::path::Path;

use crate::math::decimal::significant;
use crate::quantities::{heading, history};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::axis_of_gauge;
use crate::report::series::{Series, at, series};

/// Times in seconds and values.
type Points = Vec<(f64, f64)>;

/// A column that was measured and computed, over the time that both have.
#[derive(Debug, Clone, PartialEq)]
pub struct Beside {
    /// Its name in both files.
    pub name: String,
    /// Its unit; empty where it has none.
    pub unit: String,
    /// Title of its axis in a figure, and the factor from values to the axis.
    pub axis: (String, f64),
    /// What was measured.
    pub measured: Points,
    /// What was computed.
    pub computed: Points,
    /// Root mean square of the difference at the measured times, in the column's unit.
    pub rms: f64,
}

/// What both files have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// Their columns, in the order of the record.
    pub columns: Vec<Beside>,
    /// Columns of the record that the case does not have.
    pub left_out: Vec<String>,
    /// Columns that the case has.
    pub known: Vec<String>,
}

/// Holds a case against a record: a table with `time_s` and columns of `probes/` or `histories/`.
/// Only times within `between` count, s.
///
/// # Errors
/// A record that cannot be read, goes back in time, or has nothing in common with the case.
pub fn hold(
    data: &Loaded,
    case_id: &str,
    (record, between): (&Path, [f64; 2]),
) -> Result<Held, ReportError> {
    let measured = series(record, &[history::TIME.name])?.0;
    let computed = [data.gauges(case_id)?.0, data.history(case_id)?.0].concat();
    let known: Vec<_> = computed.iter().map(|series| series.name.clone()).collect();
    let wrong = |reason: String| ReportError::Record { path: record.to_owned(), reason };
    let (mut columns, mut left_out) = (Vec::new(), Vec::new());
    for own in measured {
        let Some(other) = computed.iter().find(|other| other.name == own.name) else {
            left_out.push(own.name);
            continue;
        };
        columns.push(Beside::of([&own, other], between).map_err(wrong)?);
    }
    if columns.is_empty() {
        let (own, known) = (left_out.join(", "), known.join(", "));
        let reason =
            format!("has no column of the case. Its own: {own}. Those of the case: {known}");
        return Err(wrong(reason));
    }
    Ok(Held { columns, left_out, known })
}

impl Beside {
    fn of([measured, computed]: [&Series; 2], between: [f64; 2]) -> Result<Beside, String> {
        let wrong = |reason: String| format!("column {}: {reason}", measured.name);
        let span = common([&measured.points, &computed.points], between).map_err(wrong)?;
        let within = |points: &Points| -> Points {
            points.iter().filter(|(time, _)| (span[0]..=span[1]).contains(time)).copied().collect()
        };
        let [own, points] = [&measured.points, &computed.points].map(within);
        if own.is_empty() || points.is_empty() {
            let [from, to] = span;
            return Err(wrong(format!("one of the two has no value from {from} to {to} s")));
        }
        let is_gauge = !computed.unit.is_empty();
        let axis = if is_gauge { axis_of_gauge(computed) } else { (heading(&computed.name), 1.0) };
        // A measured time may lie between the last computed one that counts and the next.
        let square =
            |&(time, value): &(f64, f64)| Some((at(&computed.points, time)? - value).powi(2));
        let sum: f64 = own.iter().filter_map(square).sum();
        Ok(Beside {
            name: measured.name.clone(),
            unit: computed.unit.clone(),
            axis,
            rms: (sum / own.len() as f64).sqrt(),
            measured: own,
            computed: points,
        })
    }

    /// The first and the last time, s.
    pub fn times(&self) -> [f64; 2] {
        [self.measured[0].0, self.measured[self.measured.len() - 1].0]
    }

    /// Times and values of the highest measured and computed value.
    pub fn highest(&self) -> [(f64, f64); 2] {
        [&self.measured, &self.computed].map(|points| extreme(points, 1.0))
    }

    /// The same of the lowest.
    pub fn lowest(&self) -> [(f64, f64); 2] {
        [&self.measured, &self.computed].map(|points| extreme(points, -1.0))
    }

    /// By how much the highest computed value is above the measured one, %.
    pub fn off_percent(&self) -> Option<f64> {
        let [(_, measured), (_, computed)] = self.highest();
        (measured != 0.0).then(|| 100.0 * (computed - measured) / measured.abs())
    }

    /// `rms` as a share of the measured range, %.
    pub fn rms_percent(&self) -> Option<f64> {
        let range = self.highest()[0].1 - self.lowest()[0].1;
        (range > 0.0).then(|| 100.0 * self.rms / range)
    }
}

/// The first and the last time that both have within `between`, s.
fn common([own, other]: [&Points; 2], between: [f64; 2]) -> Result<[f64; 2], String> {
    if let Some(back) = own.windows(2).find(|pair| pair[1].0 < pair[0].0) {
        return Err(format!("time_s goes back from {} to {}", back[0].0, back[1].0));
    }
    let span = |points: &Points| Some([points.first()?.0, points.last()?.0]);
    let [Some([a, b]), Some([c, d])] = [own, other].map(span) else {
        return Err("holds no number, there or in the case".to_owned());
    };
    let [from, to] = [a.max(c).max(between[0]), b.min(d).min(between[1])];
    if from <= to {
        return Ok([from, to]);
    }
    let [a, b, c, d] = [a, b, c, d].map(|time| significant(time, 6));
    let chosen = if between[0].is_finite() { "; --between has none of both" } else { "" };
    Err(format!("its times go from {a} to {b} s, those of the case from {c} to {d} s{chosen}"))
}

/// The first point whose value is the largest, times a sign.
fn extreme(points: &Points, sign: f64) -> (f64, f64) {
    let more = |best: (f64, f64), point: &(f64, f64)| {
        if sign * point.1 > sign * best.1 { *point } else { best }
    };
    points.iter().fold(points[0], more)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    fn line(points: &[(f64, f64)]) -> Series {
        let (name, method) = ("G1".to_owned(), String::new());
        Series { name, unit: "m".to_owned(), method, points: points.to_vec() }
    }

    /// Computed: a ramp of 1 m/s. Measured: the same, 0.1 m higher, with a peak between two times.
    #[test]
    fn a_record_is_held_at_its_own_times() {
        let computed = line(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
        let measured = line(&[(-1.0, 9.0), (0.5, 0.6), (1.5, 1.6), (1.75, 1.85), (7.0, 9.0)]);
        let held = Beside::of([&measured, &computed], ALWAYS).unwrap();
        assert_eq!(held.times(), [0.5, 1.75], "what only one has does not count");
        assert!((held.rms - 0.1).abs() < 1e-12, "{}", held.rms);
        assert_eq!(held.highest(), [(1.75, 1.85), (2.0, 2.0)]);
        assert!((held.off_percent().unwrap() - 100.0 * 0.15 / 1.85).abs() < 1e-12);
        assert!((held.rms_percent().unwrap() - 100.0 * 0.1 / 1.25).abs() < 1e-9);
        assert_eq!(held.axis.0, "level, m");
        let early = Beside::of([&measured, &computed], [0.0, 1.0]).unwrap();
        assert!((early.rms - 0.1).abs() < 1e-12);
        assert_eq!((early.times(), early.highest()), ([0.5, 0.5], [(0.5, 0.6), (1.0, 1.0)]));
    }

    #[test]
    fn what_has_nothing_in_common_is_told() {
        let computed = line(&[(0.0, 0.0), (1.0, 1.0)]);
        let told =
            |points: &[(f64, f64)]| Beside::of([&line(points), &computed], ALWAYS).unwrap_err();
        assert!(
            told(&[(3.0, 1.0), (4.0, 1.0)])
                .contains("from 3 to 4 s, those of the case from 0 to 1 s")
        );
        assert!(told(&[(0.1, 1.0), (0.5, 1.0), (0.2, 1.0)]).contains("goes back from 0.5 to 0.2"));
        assert!(told(&[]).contains("no number"));
        let (directory, data) = fixture::read(fixture::dam_breaks(1));
        let record = directory.path().join("measured.csv");
        std::fs::write(&record, "time_s,P7\n0,1\n").unwrap();
        let told = hold(&data, "case-0000", (&record, ALWAYS)).unwrap_err().to_string();
        assert!(
            told.contains("measured.csv: has no column") && told.contains("P1, front"),
            "{told}"
        );
        std::fs::write(&record, "time_s,P7,P1\n0,1,5\n").unwrap();
        let held = hold(&data, "case-0000", (&record, ALWAYS)).unwrap();
        assert_eq!((held.columns.len(), &held.left_out[..]), (1, &["P7".to_owned()][..]));
    }
}
