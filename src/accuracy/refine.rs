//! Points that a study adds between its own, until linear interpolation is as good as wanted.
//!
//! The added points depend on results alone. These are the same to the bit for any number of ranks
//! and after any interruption. So every process that knows the results of a round finds the same
//! next one.

use std::collections::HashMap;

use crate::math::bend::{self, Bend};
use crate::quantities::Case as Reported;
use crate::results::CaseRecord;
use crate::scene::ConfigError;
use crate::study::{Assignments, Case, Refine, Study, SweepFile};

/// An interval of the grid is cut into at most this many pieces.
const PIECES: f64 = 64.0;

/// The refinement of a study.
#[derive(Debug, Clone)]
pub struct Refinement {
    file: SweepFile,
    /// The settings in the file.
    pub asked: Refine,
}

/// The result of a round.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// The points of the next round.
    pub points: Vec<Assignments>,
    /// Intervals with a larger error than wanted that are not cut: there would be too many points,
    /// or pieces too small.
    pub open: usize,
    /// The largest error of linear interpolation that is expected within an interval.
    pub worst: Option<f64>,
    /// Intervals without an estimate: a case beside them failed, has no value, or only a bound.
    pub unknown: usize,
}

/// An interval of a line: its middle, and the expected error of the chord. The error is infinite
/// without a third point.
struct Interval {
    middle: Assignments,
    off: Option<f64>,
    small: bool,
}

/// A case on a line.
struct Stop {
    value: f64,
    place: f64,
    /// `None` if it failed, has no value, or only a bound.
    result: Option<f64>,
}

impl Refinement {
    /// What a file asks for.
    pub fn of(file: &SweepFile) -> Option<Refinement> {
        let asked = file.refine.clone()?;
        Some(Refinement { file: file.clone(), asked })
    }

    /// The study with the points of all rounds whose results are known. `records` gives those of a
    /// study.
    ///
    /// # Errors
    /// Those of the file, and what `records` fails with.
    pub fn so_far<E: From<ConfigError>>(
        &self,
        mut records: impl FnMut(&Study) -> Result<Vec<Option<CaseRecord>>, E>,
    ) -> Result<Study, E> {
        let mut study = Study::new(&self.file)?;
        loop {
            let records = records(&study)?;
            match self.next(&study, &records)? {
                Some(next) => study = next,
                None => return Ok(study),
            }
        }
    }

    /// The study of the next round. `None` if this one has not ended, or no point is added.
    ///
    /// # Errors
    /// Those of the file.
    pub fn next(
        &self,
        study: &Study,
        records: &[Option<CaseRecord>],
    ) -> Result<Option<Study>, ConfigError> {
        let cases = &records[..study.cases.len()];
        if cases.iter().any(Option::is_none) {
            return Ok(None);
        }
        let round = self.round(study, records);
        let points: Vec<_> = self.added(study).chain(round.points).collect();
        let next = Study::with_points(&self.file, &points)?;
        Ok((next.cases.len() > study.cases.len()).then_some(next))
    }

    /// The points of a study that its file does not name.
    fn added<'a>(&'a self, study: &'a Study) -> impl Iterator<Item = Assignments> + 'a {
        let added = study.cases.iter().filter(|case| !self.is_written(case, None));
        added.map(|case| case.assignments.clone())
    }

    /// How many points a study has beyond those of its file.
    pub fn count(&self, study: &Study) -> usize {
        self.added(study).count()
    }

    /// Whether all values of a case are in the file, except for one key's.
    fn is_written(&self, case: &Case, but: Option<usize>) -> bool {
        let pairs = self.file.grid.iter().zip(&case.assignments).enumerate();
        let mut others = pairs.filter(|(key, _)| Some(*key) != but);
        others.all(|(_, (axis, value))| value.as_deref().is_none_or(|v| axis.values.contains(v)))
    }

    /// The points that the results of a round call for.
    pub fn round(&self, study: &Study, records: &[Option<CaseRecord>]) -> Round {
        let results: Vec<_> =
            study.cases.iter().map(|case| self.result(study, case, records)).collect();
        let keys = 0..self.file.grid.len();
        let mut intervals: Vec<_> =
            keys.flat_map(|key| self.intervals(study, key, &results)).collect();
        let unknown = intervals.iter().filter(|one| one.off.is_none()).count();
        let known = intervals.iter().filter_map(|one| one.off).filter(|off| off.is_finite());
        let worst = known.max_by(f64::total_cmp);
        intervals.retain(|one| one.off.is_some_and(|off| off > self.asked.to));
        let all = intervals.len();
        intervals.retain(|one| !one.small);
        // The worst first; a stable sort keeps the grid's order among equals.
        intervals.sort_by(|a, b| b.off.unwrap_or(0.0).total_cmp(&a.off.unwrap_or(0.0)));
        let most = usize::try_from(self.asked.most).unwrap_or(usize::MAX);
        intervals.truncate(most.saturating_sub(self.count(study)));
        let open = all - intervals.len();
        let points = intervals.into_iter().map(|one| one.middle).collect();
        Round { points, open, worst, unknown }
    }

    /// The quantity of a case; a lower bound does not count.
    fn result(&self, study: &Study, case: &Case, records: &[Option<CaseRecord>]) -> Option<f64> {
        let record = records[case.index].as_ref().filter(|record| record.is_ok())?;
        let bars = study.error_bars(case.index, records);
        let reported: Reported<'_> = record.reported(&case.config, bars);
        let column = self.asked.column();
        column.number(&reported).filter(|_| !column.is_bound(&reported))
    }

    /// The intervals of all lines along a key, in the grid's order. Lines are those of the grid in
    /// the file: all other keys have values from the file.
    fn intervals(&self, study: &Study, key: usize, results: &[Option<f64>]) -> Vec<Interval> {
        let Some(scale) = Study::scale(&self.file, key) else { return Vec::new() };
        let mut lines: Vec<(Assignments, Vec<Stop>)> = Vec::new();
        let mut places: HashMap<String, usize> = HashMap::new();
        for case in study.cases.iter().filter(|case| self.is_written(case, Some(key))) {
            let value = case.assignments[key].as_deref().and_then(crate::keys::number);
            let Some(value) = value else { continue };
            let mut others = case.assignments.clone();
            others[key] = None;
            let stop = Stop { value, place: scale.place(value), result: results[case.index] };
            let line = *places.entry(format!("{others:?}")).or_insert(lines.len());
            if line == lines.len() {
                lines.push((others, Vec::new()));
            }
            lines[line].1.push(stop);
        }
        let written = &self.file.grid[key].values;
        let written: Vec<_> = written.iter().filter_map(crate::keys::number).collect();
        let places: Vec<_> = written.iter().map(|value| scale.place(*value)).collect();
        let of_line = |(others, mut stops): (Assignments, Vec<Stop>)| {
            stops.sort_by(|a, b| a.place.total_cmp(&b.place));
            let interval = |at: usize| {
                let [left, right] = [&stops[at], &stops[at + 1]].map(|stop| stop.place);
                let whole =
                    places.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]);
                let whole = whole.into_iter().find(|pair| pair[0] <= left && right <= pair[1]);
                let whole = whole.map_or(0.0, |pair| pair[1] - pair[0]);
                let ends = [stops[at].value, stops[at + 1].value];
                let middle = self.file.grid[key].middle(ends);
                let small = middle.is_none() || (right - left) * PIECES < 1.5 * whole;
                let mut assignments = others.clone();
                assignments[key] = middle.map(Into::into);
                Interval { middle: assignments, off: off(&stops, at), small }
            };
            (1..stops.len()).map(|at| interval(at - 1)).collect::<Vec<_>>()
        };
        lines.into_iter().flat_map(of_line).collect()
    }
}

/// The expected error of the chord between two neighbours, from the curvature through the points
/// beside them. It is infinite on a line of two points, and `None` if one of the two has no value.
fn off(stops: &[Stop], at: usize) -> Option<f64> {
    let point = |at: usize| {
        let stop = stops.get(at)?;
        Some((stop.place, stop.result?))
    };
    let interval = [point(at)?, point(at + 1)?];
    if stops.len() == 2 {
        return Some(f64::INFINITY);
    }
    Some(bend::sagitta(interval, Bend::after(at, point)?.most()))
}

#[cfg(test)]
mod tests;
