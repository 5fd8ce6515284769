//! Turns rows into points, and writes what captions say about them.

use super::chart::{Curve, Point, points};
use super::legend::Entry;
use super::look::Look;
use crate::quantities::Column;
use crate::quantities::summary::{
    FORCE_COUPLING, LOG10_K_STAR, M_STAR, SEAWALL_MASS, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO,
};
use crate::report::curves::distinct;
use crate::report::number::{as_typed, minus, with_digits, with_error};
use crate::report::row::{Row, label};

/// A case's point, if it has a number.
pub fn point(row: &Row, x: f64, column: &Column) -> Option<Point> {
    let y = row.number(column).filter(|value| value.is_finite())?;
    Some(Point {
        x,
        y,
        error: row.error(column).filter(|error| error.is_finite()).unwrap_or(0.0),
        bound: row.is_bound(column),
        case: row.id().to_owned(),
        told: value_in_words(row, column),
        ..Point::default()
    })
}

/// Case, value and bar in words.
pub fn value_in_words(row: &Row, column: &Column) -> String {
    let error = row.error(column).unwrap_or(0.0);
    let value = row.number(column).unwrap_or(f64::NAN);
    let value = if error > 0.0 { with_error(value, error) } else { row.rounded(column) };
    let sign = if row.is_bound(column) { "≥" } else { "=" };
    let said = format!("{} {sign} {value}", column.symbol);
    let case = row.words();
    if case.is_empty() { said } else { format!("{case}: {said}") }
}

/// A curve for every value of a column, and one for cases without a value. A curve's look follows
/// from the value's place among all `values`.
pub fn by(
    column: &Column,
    values: &[f64],
    cases: &[(f64, &Row)],
    value: impl Fn(f64, &Row) -> Option<Point>,
) -> Vec<Curve> {
    let all = values.iter().map(|value| Some(*value)).chain([None]).enumerate();
    let curve = |(index, own): (usize, Option<f64>)| {
        let cases = cases.iter().filter(|(_, row)| row.number(column) == own);
        let points: Vec<_> = cases.clone().filter_map(|(x, row)| value(*x, row)).collect();
        let entry = match own {
            Some(own) => {
                let words = said(cases.clone().map(|(_, row)| *row), column, own);
                Entry::marked(words, Look::of(index)).keyed(key(column, own))
            }
            None => Entry::marked("", Look::of(0)),
        };
        (!points.is_empty()).then_some(Curve { entry, points })
    };
    all.filter_map(curve).collect()
}

/// A value of a column for legends and headings. Masses and stiffnesses are as in files, with the
/// equations' number behind, `m = 10 kg/m (m* = 0.25)`, where cases agree in both.
pub fn said<'a>(
    cases: impl Iterator<Item = &'a Row> + Clone,
    column: &Column,
    value: f64,
) -> String {
    let pairs = [(&SEAWALL_MASS, &M_STAR), (&SPRING_STIFFNESS, &LOG10_K_STAR)];
    let pair = pairs.into_iter().find(|(own, ratio)| column == *own || column == *ratio);
    let one = |of: &Column| {
        let cases = cases.clone().filter(|row| row.number(column) == Some(value));
        match distinct(cases, of)[..] {
            [one] => Some(one),
            _ => None,
        }
    };
    let both = pair.and_then(|(own, ratio)| Some(((own, one(own)?), (ratio, one(ratio)?))));
    let Some(((own, typed), (ratio, known))) = both else {
        let words = label(column, value);
        let same = cases.filter(|row| row.number(column) == Some(value));
        return if column == &WAVE_HEIGHT_RATIO { wave_said(same, words) } else { words };
    };
    let known = minus(&with_digits(known, ratio.digits).unwrap_or_else(|| as_typed(known)));
    format!("{} ({} = {known})", label(own, typed), ratio.symbol)
}

/// The wave of these cases: its height in `words`, unless it is a record without a given height.
pub fn wave_said<'a>(cases: impl Iterator<Item = &'a Row>, words: String) -> String {
    let mut unasked = cases.map(|row| row.unasked).peekable();
    let any = unasked.peek().is_some();
    if any && unasked.all(|unasked| unasked) { "recorded stroke".to_owned() } else { words }
}

/// A value of a column for programs.
pub fn key(column: &Column, value: f64) -> String {
    format!("{}={value}", column.name)
}

/// The legend's entry for bounds, if there are any.
pub fn bounds(curves: &[Curve]) -> Option<Curve> {
    let any = points(curves).any(|point| point.bound);
    let entry = Entry::dots("lower bound: still moving at the end", Look::ink(), true);
    any.then_some(Curve { entry, points: Vec::new() })
}

/// The motion law, which every figure of a movable wall names. A caisson's law has no s.
pub fn coupling<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let springs = rows.filter(|row| row.number(&SPRING_STIFFNESS).is_some());
    let factors = distinct(springs, &FORCE_COUPLING);
    let factors: Vec<_> = factors.into_iter().map(as_typed).collect();
    if factors.is_empty() {
        return String::new();
    }
    format!(" Force coupling s = {}.", factors.join(", "))
}

/// The caption's words on walls without a spring, where the axis is logarithmic in stiffness.
pub fn springless<'a>(mut rows: impl Iterator<Item = &'a Row>) -> &'static str {
    let any = rows.any(|row| row.number(&SPRING_STIFFNESS) == Some(0.0));
    if any { " Walls with k = 0 have no place on a logarithmic axis." } else { "" }
}

/// The caption's words on error bars and open markers, if there are any.
pub fn marks(rows: &[&Row], columns: &[&Column]) -> String {
    let any = |has: &dyn Fn(&Row, &Column) -> bool| {
        rows.iter().any(|row| columns.iter().any(|column| has(row, column)))
    };
    let mut text = String::new();
    if any(&|row, column| row.error(column).is_some()) {
        text.push_str(" Bars: estimated errors.");
    }
    if any(&|row, column| row.is_bound(column)) {
        text.push_str(
            " Open markers with an arrow: the wall was still moving outwards when the run ended, so \
             that the value is a lower bound; no line but dots goes through them.",
        );
    }
    text
}

/// `Shown is 1`, `Shown are 6`.
pub fn shown_are(shown: usize) -> String {
    format!("Shown {} {shown}", if shown == 1 { "is" } else { "are" })
}

/// The end of a caption: what was picked, if not all is drawn.
pub fn picked(shown: usize, all: usize, what: &str) -> String {
    if shown >= all {
        return String::new();
    }
    format!(" {} of {all} {what}.", shown_are(shown))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mass_is_said_as_it_is_typed_and_then_as_a_ratio() {
        let row = |m: f64, m_star: f64| {
            let row = Row::default().with(&SEAWALL_MASS, m).with(&M_STAR, m_star);
            row.with(&SPRING_STIFFNESS, 1196.279).with(&LOG10_K_STAR, 0.484_12)
        };
        let rows = [row(10.0, 0.25), row(50.0, 1.25), row(90.0, 1.25)];
        let told = |column, value| said(rows.iter(), column, value);
        assert_eq!(told(&M_STAR, 0.25), "m = 10 kg/m (m* = 0.25)");
        assert_eq!(told(&SEAWALL_MASS, 10.0), "m = 10 kg/m (m* = 0.25)");
        assert_eq!(told(&M_STAR, 1.25), "m* = 1.25", "two masses in water of other depths");
        assert_eq!(told(&SPRING_STIFFNESS, 1196.279), "k = 1196 N/m (log₁₀ k* = 0.48)");
        let soft = row(10.0, 0.25).with(&SPRING_STIFFNESS, 100).with(&LOG10_K_STAR, -0.593);
        let told = said([&soft].into_iter(), &SPRING_STIFFNESS, 100.0);
        assert_eq!(told, "k = 100 N/m (log₁₀ k* = \u{2212}0.59)");
    }

    #[test]
    fn a_record_that_nobody_gave_a_height_is_said_without_one() {
        let row = |unasked| {
            let mut row = Row::default().with(&WAVE_HEIGHT_RATIO, 0.5);
            row.unasked = unasked;
            row
        };
        let told = |unasked: &[bool]| {
            let rows: Vec<_> = unasked.iter().map(|unasked| row(*unasked)).collect();
            said(rows.iter(), &WAVE_HEIGHT_RATIO, 0.5)
        };
        assert_eq!(told(&[true, true]), "recorded stroke");
        assert_eq!([told(&[true, false]), told(&[])], ["H/h = 0.5", "H/h = 0.5"]);
        assert!(row(true).words().is_empty() && row(true).wall_in_words().is_empty());
        assert_eq!(row(true).number(&WAVE_HEIGHT_RATIO), Some(0.5), "its place");
    }

    #[test]
    fn a_caisson_follows_no_force_coupling() {
        let caisson = Row::default().with(&SEAWALL_MASS, 60).with(&FORCE_COUPLING, 1);
        assert_eq!(coupling([&caisson].into_iter()), "");
        let spring = caisson.with(&SPRING_STIFFNESS, 500);
        assert_eq!(coupling([&spring].into_iter()), " Force coupling s = 1.");
    }
}
