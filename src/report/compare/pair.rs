//! Two cases of the same point and their differences.

use super::Side;
use super::values::number_text;
use crate::math::lists;
use crate::quantities::summary::RESULTS;
use crate::quantities::{Column, Unit};
use crate::report::number::as_typed;
use crate::report::row::{PLACE, label};
use crate::report::spoken::all_spoken;

/// A wall that moves by less than this share of the depth has no displacement to compare in percent.
const LEAST: f64 = 0.01;
/// A volume over a crest that is a smaller share of h² has no difference in percent either.
const LEAST_VOLUME: f64 = 2.5e-4;

/// A value in both cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The values.
    pub values: [f64; 2],
    /// Their error bars.
    pub bars: [Option<f64>; 2],
    /// Whether they are lower bounds.
    pub bounds: [bool; 2],
    /// Whether the column of the whole run was read in place of the first impact's.
    pub stands_in: bool,
    /// A smaller value has no difference in percent. Runups have none: they are given in h alone.
    least: Option<f64>,
}

/// Two cases of the same point.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The point in words.
    pub words: String,
    /// H/h, k, m; each is empty where the case has none.
    pub place: [String; 3],
    /// The cases' identities.
    pub ids: [String; 2],
    /// What differs, in the order of [`RESULTS`].
    pub differences: [Option<Difference>; RESULTS.len()],
}

/// The differences of one quantity in all pairs.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// How many pairs have this quantity.
    pub count: usize,
    /// The median size: percent, or h for runups.
    pub median: f64,
    /// The worst size.
    pub worst: f64,
    /// The pair with the worst size.
    pub worst_pair: usize,
    /// Pairs with an error bar and a known difference.
    pub with_bars: usize,
    /// Pairs whose difference is within their bars.
    pub within: usize,
}

impl Difference {
    /// The second value less the first, in the quantity's unit.
    pub fn absolute(&self) -> f64 {
        self.values[1] - self.values[0]
    }

    /// The difference over the first value, percent; `None` where that is next to nothing.
    pub fn percent(&self) -> Option<f64> {
        let first = self.values[0];
        (first.abs() > self.least.unwrap_or(LEAST)).then(|| 100.0 * self.absolute() / first.abs())
    }

    /// The sum of the two bars; `None` where neither case has one.
    pub fn bar(&self) -> Option<f64> {
        let [a, b] = self.bars;
        a.or(b)?;
        Some(a.unwrap_or(0.0) + b.unwrap_or(0.0))
    }

    /// Whether only one of the cases has a bar.
    pub fn has_one_bar(&self) -> bool {
        self.bars[0].is_some() != self.bars[1].is_some()
    }

    /// Whether one value is a lower bound below the other. Then their difference is unknown.
    fn is_open(&self) -> bool {
        match self.bounds {
            [true, false] => self.values[0] <= self.values[1],
            [false, true] => self.values[1] <= self.values[0],
            [false, false] | [true, true] => false,
        }
    }

    /// Whether the bars reach each other.
    pub fn is_within(&self) -> Option<bool> {
        self.bar().filter(|_| !self.is_open()).map(|bar| self.absolute().abs() <= bar)
    }

    /// The difference that is reported and counted: percent, or h for runups.
    pub fn size(&self) -> Option<f64> {
        match self.least {
            _ if self.is_open() => None,
            Some(_) => self.percent(),
            None => Some(self.absolute()),
        }
    }
}

impl Pair {
    pub(super) fn of(a: &Side, b: &Side) -> Pair {
        let rows = [a.row, b.row];
        let depth = a.depth.or(b.depth).unwrap_or(0.0);
        let difference = |quantity: &'static Column| {
            // The first hard impact of regular waves may come from different waves.
            let both = rows.iter().all(|row| row.impact(quantity) == quantity);
            let column = if both { quantity } else { quantity.of_whole_run() };
            let values = [a.row.number(column)?, b.row.number(column)?];
            Some(Difference {
                values,
                bars: rows.map(|row| row.error(column)),
                bounds: rows.map(|row| row.is_bound(column)),
                stands_in: column != quantity,
                least: match column.unit {
                    Unit::Runup => None,
                    Unit::SquareMetres => Some(LEAST_VOLUME * depth * depth),
                    _ => Some(LEAST),
                },
            })
        };
        Pair {
            words: point(a, b),
            place: PLACE.map(|column| a.row.cell(column)),
            ids: rows.map(|row| row.id().to_owned()),
            differences: RESULTS.map(difference),
        }
    }

    /// Summarises the differences of one quantity; `None` where no pair has it.
    pub fn tally(pairs: &[Pair], quantity: usize) -> Option<Tally> {
        let sized = pairs.iter().enumerate().filter_map(|(at, pair)| {
            let difference = pair.differences[quantity]?;
            Some((at, difference.size()?.abs(), difference))
        });
        let mut sized: Vec<_> = sized.collect();
        sized.sort_by(|a, b| a.1.total_cmp(&b.1));
        let &(worst_pair, worst, _) = sized.last()?;
        let within =
            |is: bool| sized.iter().filter(move |(.., one)| one.is_within() == Some(is)).count();
        Some(Tally {
            count: sized.len(),
            median: lists::median(&sized.iter().map(|one| one.1).collect::<Vec<_>>())?,
            worst,
            worst_pair,
            with_bars: within(true) + within(false),
            within: within(true),
        })
    }
}

/// Both cases in words. Where their values differ, both stand there with a bar between.
fn point(a: &Side, b: &Side) -> String {
    let part = |column: &&'static Column| {
        let values = [a, b].map(|side| side.row.number(column));
        let first = values[0].or(values[1])?;
        if number_text(values[0]) == number_text(values[1]) {
            return Some(label(column, first));
        }
        let [a, b] = values.map(|value| value.map_or_else(|| "-".to_owned(), as_typed));
        Some(column.with_value("=", &format!("{a} | {b}")))
    };
    let unasked = a.row.unasked && b.row.unasked;
    let parts = PLACE.iter().skip(usize::from(unasked)).filter_map(part);
    let mut parts: Vec<String> = parts.collect();
    let variants = [&a.row.variant, &b.row.variant];
    if variants.iter().any(|variant| !variant.is_empty()) {
        let shown = variants
            .map(|variant| if variant.is_empty() { "-".to_owned() } else { all_spoken(variant) });
        parts.push(if shown[0] == shown[1] { shown[0].clone() } else { shown.join(" | ") });
    }
    if parts.is_empty() { a.row.id().to_owned() } else { parts.join(", ") }
}

#[cfg(test)]
mod tests;
