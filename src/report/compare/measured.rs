//! A measured record beside the same columns of a case.

use std::path::Path;

use super::gaps::Gaps;
use super::record;
use crate::math::decimal::significant;
use crate::quantities::{Unit, heading, history};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::plots::axis_of_gauge;
use crate::report::series::{Series, at};

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
    /// Where one of the two has no values. Nothing there counts.
    pub gaps: Gaps,
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
    let measured = record::read(record)?;
    let computed = computed(data, case_id)?;
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

/// The gauges and the history of a case, with their units.
fn computed(data: &Loaded, case_id: &str) -> Result<Vec<Series>, ReportError> {
    let mut own = data.history(case_id)?.0;
    for series in &mut own {
        series.unit = declared(&series.name).map_or("", |unit| unit.symbol()).to_owned();
    }
    Ok([data.gauges(case_id)?.0, own].concat())
}

/// The unit of a history's column.
fn declared(name: &str) -> Option<Unit> {
    history::ALL.iter().find(|column| column.name == name).map(|column| column.unit)
}

impl Beside {
    fn of([measured, computed]: [&Series; 2], between: [f64; 2]) -> Result<Beside, String> {
        let wrong = |reason: String| format!("column {}: {reason}", measured.name);
        let span = common([&measured.points, &computed.points], between).map_err(wrong)?;
        let gaps = Gaps::of([&measured.points, &computed.points]);
        let [from, to] = gaps.trimmed(span);
        let counts = |time: f64| (from <= time && time <= to) && !gaps.hold(time);
        let counted = |points: &Points| -> Points {
            points.iter().filter(|(time, _)| counts(*time)).copied().collect()
        };
        let [own, points] = [&measured.points, &computed.points].map(counted);
        if own.is_empty() || points.is_empty() {
            let [from, to] = span;
            return Err(wrong(format!("one of the two has no value from {from} to {to} s")));
        }
        let axis = match declared(&computed.name) {
            Some(unit) => (unit.axis().to_owned(), 1.0),
            None if computed.unit.is_empty() => (heading(&computed.name), 1.0),
            None => axis_of_gauge(computed),
        };
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
            gaps: gaps.within([from, to]),
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
mod tests;
