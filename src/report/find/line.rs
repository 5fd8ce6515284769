//! A line of cases along an axis, and the boundaries on it.

use super::condition::{Comparison, Condition, Verdict};
use super::{Basis, Boundary};
use crate::math::bend::{self, Bend};
use crate::math::lists::grouped;
use crate::math::scale::Scale;
use crate::report::load::Loaded;

/// A case on an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    row: usize,
    value: f64,
    place: f64,
}

/// Lines of cases that differ in one key alone, in its order. Lines are in the grid's order.
pub(super) fn lines(key: usize, scale: Scale, data: &Loaded) -> Vec<Vec<Stop>> {
    let stop = |row: usize| {
        let value = data.keys[key].cells[row].parse::<f64>().ok()?;
        let others = data.keys.iter().enumerate().filter(|(place, _)| *place != key);
        let others: Vec<_> = others.map(|(_, other)| &other.cells[row]).collect();
        Some((others, Stop { row, value, place: scale.place(value) }))
    };
    let mut lines = grouped((0..data.rows.len()).filter_map(stop));
    for line in &mut lines {
        line.sort_by(|a, b| a.value.total_cmp(&b.value));
    }
    lines
}

/// One line of cases along an axis.
pub(super) struct Line<'a> {
    pub condition: &'a Condition,
    pub data: &'a Loaded,
    pub key: usize,
    pub scale: Scale,
    pub stops: &'a [Stop],
}

impl Line<'_> {
    /// All boundaries of the line.
    pub fn all(&self) -> Vec<Boundary> {
        let known = |at: &usize| self.verdict(*at) != Verdict::Unknown;
        let told: Vec<_> = (0..self.stops.len()).filter(known).collect();
        let mut found = Vec::new();
        let ends = [told.first(), told.last()].map(|end| end.copied());
        if let [Some(first), Some(last)] = ends {
            found.extend((first > 0).then(|| self.open(first, 0)).flatten());
            for pair in told.windows(2) {
                found.extend(self.between(pair[0], pair[1]));
            }
            let end = self.stops.len() - 1;
            found.extend((last < end).then(|| self.open(last, end)).flatten());
        }
        found
    }

    fn verdict(&self, at: usize) -> Verdict {
        self.condition.verdict(self.stops[at].row)
    }

    /// The boundary at the end of the known part, where the condition is met there.
    fn open(&self, known: usize, end: usize) -> Option<Boundary> {
        (self.verdict(known) == Verdict::Met).then(|| self.within(known, end, Basis::Gap))
    }

    /// A boundary somewhere between a case that meets the condition and another case. Nothing more
    /// is known of it.
    fn within(&self, met: usize, other: usize, basis: Basis) -> Boundary {
        let (low, high) = (met.min(other), met.max(other));
        let between = [self.stops[low].value, self.stops[high].value];
        self.boundary(low, high, met > other, None, between, basis)
    }

    fn boundary(
        &self,
        low: usize,
        high: usize,
        met_above: bool,
        at: Option<f64>,
        between: [f64; 2],
        basis: Basis,
    ) -> Boundary {
        let is_doubtful =
            |stop: &Stop| self.data.rows[stop.row].is(&crate::quantities::summary::DOUBTFUL);
        let row = self.stops[low].row;
        let doubtful = self.stops[low..=high].iter().any(is_doubtful);
        let (key, scale) = (self.key, self.scale);
        Boundary { key, row, scale, met_above, at, between, basis, doubtful }
    }

    /// The boundaries between two known cases with none, or only unknown ones, between them.
    fn between(&self, low: usize, high: usize) -> Vec<Boundary> {
        let verdicts = [low, high].map(|at| self.verdict(at));
        let differ = verdicts[0] != verdicts[1];
        let (met, other) = if verdicts[0] == Verdict::Met { (low, high) } else { (high, low) };
        let rows = [low, high].map(|at| self.stops[at].row);
        let is_crossed = |comparison: &&Comparison| {
            comparison.verdict(rows[0]) != comparison.verdict(rows[1])
                && comparison.subject.name != self.data.keys[self.key].name
        };
        let any_has = |number: Option<f64>| {
            let mut crossed = self.condition.0.iter().filter(is_crossed);
            crossed.any(|one| rows.iter().any(|row| one.subject.exact(*row) == number))
        };
        let basis = match high > low + 1 {
            true => Basis::Gap,
            false if any_has(None) => Basis::LowerBound,
            // The wall stays, or no water passes the crest: the curve leaves 0 in between.
            false if differ && any_has(Some(0.0)) => Basis::Start,
            false => return self.interpolated(low),
        };
        differ.then(|| self.within(met, other, basis)).into_iter().collect()
    }

    /// The ends of the part of an interval in which the straight lines meet all comparisons.
    fn interpolated(&self, low: usize) -> Vec<Boundary> {
        let (mut from, mut to) = (Vec::new(), Vec::new());
        for comparison in &self.condition.0 {
            let verdicts = [low, low + 1].map(|at| comparison.verdict(self.stops[at].row));
            let crossed = (self.share(comparison, low), comparison);
            match verdicts.map(|verdict| verdict == Verdict::Met) {
                [true, true] => {}
                [false, false] => return Vec::new(),
                [true, false] => to.push(crossed),
                [false, true] => from.push(crossed),
            }
        }
        let from = from.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let to = to.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        if from.zip(to).is_some_and(|(from, to)| from.0 > to.0) {
            return Vec::new();
        }
        let ends = [(from, true), (to, false)].into_iter();
        let end = |(end, met_above): (Option<(f64, &Comparison)>, bool)| {
            end.map(|(share, comparison)| self.crossing(comparison, low, share, met_above))
        };
        ends.filter_map(end).collect()
    }

    /// Where the straight line crosses a comparison's limit, as a share of the interval.
    fn share(&self, comparison: &Comparison, low: usize) -> f64 {
        if comparison.subject.name == self.data.keys[self.key].name {
            let [left, right] = [low, low + 1].map(|at| self.stops[at].place);
            return (self.scale.place(comparison.limit) - left) / (right - left);
        }
        let [Some(left), Some(right)] = [low, low + 1].map(|at| self.point(comparison, at)) else {
            return 0.0;
        };
        bend::crossing([left, right], 0.0, comparison.limit)
    }

    fn point(&self, comparison: &Comparison, at: usize) -> Option<bend::Point> {
        let stop = self.stops.get(at)?;
        Some((stop.place, comparison.subject.exact(stop.row)?))
    }

    /// A boundary by linear interpolation. Its range follows from the bend of the curve and the
    /// error bars of both cases.
    fn crossing(
        &self,
        comparison: &Comparison,
        low: usize,
        share: f64,
        met_above: bool,
    ) -> Boundary {
        let [left, right] = [self.stops[low], self.stops[low + 1]];
        let value = |share: f64| self.scale.value(left.place + (right.place - left.place) * share);
        let told = |between: [f64; 2], basis| {
            self.boundary(low, low + 1, met_above, Some(value(share)), between, basis)
        };
        if comparison.subject.name == self.data.keys[self.key].name {
            return told([value(share); 2], Basis::Exact);
        }
        let point = |at: usize| self.point(comparison, at);
        let [Some(from), Some(to)] = [point(low), point(low + 1)] else {
            return told([left.value, right.value], Basis::Gap);
        };
        let bend = Bend::after(low, point);
        let ends = bend.map(|bend| bend.crossings([from, to], comparison.limit));
        let bars = [left, right].map(|stop| comparison.subject.bar(stop.row).unwrap_or(0.0));
        let bar = (bars[0] + (bars[1] - bars[0]) * share) / (to.1 - from.1).abs();
        // A case whose bar does not reach the limit is certainly on its side of the boundary.
        let sure = [left, right].map(|stop| !comparison.is_near(stop.row));
        let basis = if ends.is_some() { Basis::Bend } else { Basis::TwoCases };
        let [first, last] = ends.unwrap_or([0.0, 1.0]);
        let mut ends = [first - bar, last + bar];
        if sure[0] {
            ends[0] = ends[0].max(0.0);
        }
        if sure[1] {
            ends[1] = ends[1].min(1.0);
        }
        told(ends.map(value), basis)
    }
}
