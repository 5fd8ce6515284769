//! Two cases of the same point: what they differ by.

use super::Side;
use super::matching::number_text;
use crate::math::lists;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, FORCE_MAX, RUNUP_MAX,
};
use crate::quantities::{Column, Unit};
use crate::report::number::plain;
use crate::report::row::{PLACE, label};
use crate::report::spoken::all_spoken;

/// What is compared, and what stands in for it where one of the cases has no first impact, and where waves are
/// regular: which of them is the first to press hard may differ.
pub const COMPARED: [(&Column, Option<&Column>); 3] = [
    (&FIRST_FORCE_MAX, Some(&FORCE_MAX)),
    (&FIRST_RUNUP_MAX, Some(&RUNUP_MAX)),
    (&DISPLACEMENT_MAX, None),
];

/// A wall that moves by less than this share of the depth has no displacement to compare in percent.
const LEAST: f64 = 0.01;

/// A value in both cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The values.
    pub values: [f64; 2],
    /// Their error bars.
    pub bars: [Option<f64>; 2],
    /// Whether they are lower bounds.
    pub bounds: [bool; 2],
    /// In percent it means something: runups are told in h alone.
    relative: bool,
}

/// Two cases of the same point.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The point in words.
    pub words: String,
    /// H/h, k, m; empty where there is none.
    pub place: [String; 3],
    /// The cases' identities.
    pub ids: [String; 2],
    /// What differs, in the order of [`COMPARED`].
    pub differences: [Option<Difference>; 3],
}

/// The differences of one quantity in all pairs.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// How many pairs have it.
    pub count: usize,
    /// The median size: percent, or h for runups.
    pub median: f64,
    /// The worst size.
    pub worst: f64,
    /// The pair that has it.
    pub worst_pair: usize,
    /// Pairs with an error bar, and those within it.
    pub with_bars: usize,
    /// Pairs whose difference is within their bars.
    pub within: usize,
}

impl Difference {
    /// The second less the first, in the quantity's unit.
    pub fn absolute(&self) -> f64 {
        self.values[1] - self.values[0]
    }

    /// The same over the first, percent; none where the wall hardly moves.
    pub fn percent(&self) -> Option<f64> {
        let first = self.values[0];
        (first.abs() > LEAST).then(|| 100.0 * self.absolute() / first.abs())
    }

    /// The two bars added up; none where neither case has one.
    pub fn bar(&self) -> Option<f64> {
        let [a, b] = self.bars;
        a.or(b)?;
        Some(a.unwrap_or(0.0) + b.unwrap_or(0.0))
    }

    /// Whether one of the cases alone has a bar.
    pub fn has_one_bar(&self) -> bool {
        self.bars[0].is_some() != self.bars[1].is_some()
    }

    /// Whether the bars reach each other.
    pub fn is_within(&self) -> Option<bool> {
        self.bar().map(|bar| self.absolute().abs() <= bar)
    }

    /// What is told and tallied: percent, or h for runups.
    pub fn size(&self) -> Option<f64> {
        if self.relative { self.percent() } else { Some(self.absolute()) }
    }
}

impl Pair {
    pub(super) fn of(a: &Side, b: &Side) -> Pair {
        let rows = [a.row, b.row];
        let difference = |(column, instead): (&'static Column, Option<&'static Column>)| {
            let lacks = rows.iter().any(|row| row.number(column).is_none());
            let regular = instead.filter(|_| rows.iter().any(|row| row.regular));
            let column = if lacks { instead? } else { regular.unwrap_or(column) };
            let values = [a.row.number(column)?, b.row.number(column)?];
            Some(Difference {
                values,
                bars: rows.map(|row| row.error(column)),
                bounds: rows.map(|row| row.is_bound(column)),
                relative: column.unit != Unit::Runup,
            })
        };
        Pair {
            words: point(a, b),
            place: PLACE.map(|column| a.row.cell(column)),
            ids: rows.map(|row| row.id().to_owned()),
            differences: COMPARED.map(difference),
        }
    }

    /// The differences of one quantity; none where no pair has it.
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

/// Both cases in words. What they have different values of has both, with a bar between.
fn point(a: &Side, b: &Side) -> String {
    let part = |column: &&'static Column| {
        let values = [a, b].map(|side| side.row.number(column));
        let first = values[0].or(values[1])?;
        if number_text(values[0]) == number_text(values[1]) {
            return Some(label(column, first));
        }
        let [a, b] = values.map(|value| value.map_or_else(|| "-".to_owned(), plain));
        let text = format!("{} = {a} | {b} {}", column.symbol, column.unit.symbol());
        Some(text.trim_end().to_owned())
    };
    let parts = PLACE.iter().filter_map(part);
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
mod tests {
    use super::*;
    use crate::quantities::summary::{FORCE_ERROR, SEAWALL_MASS, WAVE_HEIGHT_RATIO};
    use crate::report::row::Row;

    fn pair(a: f64, b: f64, bar: Option<f64>) -> Pair {
        let row = |force: f64| {
            let row = Row::default().with(&WAVE_HEIGHT_RATIO, 0.3).with(&FIRST_FORCE_MAX, force);
            bar.into_iter().fold(row, |row, bar| row.with(&FORCE_ERROR, bar))
        };
        let rows = [row(a), row(b)];
        let [a, b] = [0, 1].map(|one| Side { row: &rows[one], config: None });
        Pair::of(&a, &b)
    }

    #[test]
    fn differences_are_judged_by_both_bars() {
        let one = pair(2.0, 2.1, Some(0.06));
        let force = one.differences[0].unwrap();
        assert!((force.absolute() - 0.1).abs() < 1e-12);
        assert!((force.percent().unwrap() - 5.0).abs() < 1e-9);
        assert_eq!(force.is_within(), Some(true));
        assert_eq!(pair(2.0, 2.1, Some(0.04)).differences[0].unwrap().is_within(), Some(false));
        assert_eq!(pair(2.0, 2.1, None).differences[0].unwrap().is_within(), None);
        assert_eq!(one.differences[2], None, "no displacement");
    }

    /// The story: a study without bars was told to differ by more than "both error bars together".
    #[test]
    fn a_case_without_a_bar_is_held_against_the_other_bar_alone() {
        let row = || Row::default().with(&FIRST_FORCE_MAX, 2.0);
        let rows = [row().with(&FORCE_ERROR, 0.1), row()];
        let of = |a: usize, b: usize| {
            let [a, b] = [a, b].map(|one| Side { row: &rows[one], config: None });
            Pair::of(&a, &b).differences[0].unwrap()
        };
        assert_eq!(
            [of(0, 1), of(0, 0), of(1, 1)].map(|one| one.has_one_bar()),
            [true, false, false]
        );
        assert_eq!(of(0, 1).bar(), Some(0.1));
    }

    /// The story: a caisson was held against a fixed wall, and the difference was told "at m = 60000 kg/m".
    #[test]
    fn what_differs_stands_in_the_words_twice() {
        let row = || Row::default().with(&WAVE_HEIGHT_RATIO, 0.3);
        let words = |a: Row, b: Row| {
            let [a, b] = [&a, &b].map(|row| Side { row, config: None });
            Pair::of(&a, &b).words
        };
        let heavy = || row().with(&SEAWALL_MASS, 60000);
        assert_eq!(words(heavy(), row()), "H/h = 0.3, m = 60000 | - kg/m");
        assert_eq!(
            words(heavy(), heavy().with(&SEAWALL_MASS, 50)),
            "H/h = 0.3, m = 60000 | 50 kg/m"
        );
        assert_eq!(words(heavy(), heavy()), "H/h = 0.3, m = 60000 kg/m");
    }

    /// The story: the third wave of a train was held against the fourth of the same train on finer particles.
    #[test]
    fn regular_waves_are_compared_by_their_whole_runs() {
        let mut row = Row::default().with(&FIRST_FORCE_MAX, 1.16).with(&FORCE_MAX, 1.3);
        row.regular = true;
        let side = Side { row: &row, config: None };
        assert_eq!(Pair::of(&side, &side).differences[0].unwrap().values, [1.3, 1.3]);
    }

    #[test]
    fn a_tally_names_its_worst_pair() {
        let pairs = [pair(2.0, 2.0, None), pair(2.0, 1.0, Some(0.1)), pair(2.0, 2.02, Some(0.1))];
        let tally = Pair::tally(&pairs, 0).unwrap();
        assert_eq!((tally.count, tally.worst, tally.worst_pair), (3, 50.0, 1));
        assert!((tally.median - 1.0).abs() < 1e-9);
        assert_eq!((tally.with_bars, tally.within), (2, 1));
        assert_eq!(Pair::tally(&pairs, 2), None);
    }
}
