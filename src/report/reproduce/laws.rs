//! Columns of panels by the factor s of the wall's law of motion, and words to tell cases apart.

use crate::math::lists::different;
use crate::quantities::summary::{BOUNDARY, FORCE_COUPLING, SCHEME};
use crate::report::curves::distinct;
use crate::report::number;
use crate::report::papers::others;
use crate::report::plots::Look;
use crate::report::row::{PLACE, Row, label};

/// The factors s of movable walls; the law as printed comes first. A single `None` if none moves.
pub fn laws<'a>(rows: impl Iterator<Item = &'a Row>) -> Vec<Option<f64>> {
    let mut factors = distinct(rows.filter(|row| !row.is_fixed()), &FORCE_COUPLING);
    factors.reverse();
    if factors.is_empty() { vec![None] } else { factors.into_iter().map(Some).collect() }
}

/// Whether a case stands in the column of a law: a fixed wall stands in every one.
pub fn stands(row: &Row, law: Option<f64>) -> bool {
    row.is_fixed() || law.is_none_or(|law| row.number(&FORCE_COUPLING) == Some(law))
}

/// The heading of a law's column.
pub fn heading(law: Option<f64>) -> String {
    match law {
        Some(1.0) => "s = 1, the law as printed".to_owned(),
        Some(law) => format!("s = {}", number::as_typed(law)),
        None => String::new(),
    }
}

/// What tells each case from the others, apart from its factor s.
pub fn words(rows: &[&Row]) -> Vec<String> {
    let movable = || rows.iter().copied().filter(|row| !row.is_fixed());
    let differs = |column| distinct(movable(), column).len() > 1;
    let wave_differs = distinct(rows.iter().copied(), PLACE[0]).len() > 1;
    let shown = [wave_differs, differs(PLACE[1]), differs(PLACE[2])];
    let mixed = movable().next().is_some() && movable().count() < rows.len();
    let texts = [&SCHEME, &BOUNDARY];
    let varied =
        texts.map(|column| rows.iter().any(|row| row.text(column) != rows[0].text(column)));
    let word = |row: &&Row| {
        let places = PLACE.iter().zip(shown).filter(|(_, shown)| *shown);
        let mut parts: Vec<String> =
            places.filter_map(|(column, _)| Some(label(column, row.number(column)?))).collect();
        if mixed && row.is_fixed() {
            parts.push("fixed wall".to_owned());
        } else if mixed && parts.is_empty() {
            parts.push("movable wall".to_owned());
        }
        parts.extend(others(row, &[&SCHEME, &BOUNDARY]));
        for (column, _) in texts.iter().zip(varied).filter(|(_, varied)| *varied) {
            parts.push(row.text(column).to_owned());
        }
        parts.join(", ")
    };
    rows.iter().map(word).collect()
}

/// A look for each of these words. Equal words have the same look.
pub fn looks(words: &[String]) -> Vec<Look> {
    let order = different(words);
    let place = |word: &String| order.iter().position(|other| *other == word).unwrap_or(0);
    words.iter().map(|word| Look::of(place(word))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{SEAWALL_MASS, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};

    fn wall(k: f64, s: f64) -> Row {
        let row = Row::default().with(&WAVE_HEIGHT_RATIO, 0.5).with(&SEAWALL_MASS, 50.0);
        row.with(&SPRING_STIFFNESS, k).with(&FORCE_COUPLING, s)
    }

    #[test]
    fn cases_are_told_by_what_differs_and_sorted_by_their_law() {
        let fixed = Row::default().with(&WAVE_HEIGHT_RATIO, 0.5).with(&FORCE_COUPLING, 1.0);
        let rows = [wall(10.0, 1.0), wall(10.0, 0.4), wall(500.0, 0.4), fixed];
        let rows: Vec<_> = rows.iter().collect();
        assert_eq!(laws(rows.iter().copied()), [Some(1.0), Some(0.4)]);
        let told = ["k = 10 N/m", "k = 10 N/m", "k = 500 N/m", "fixed wall"];
        assert_eq!(words(&rows), told);
        assert_eq!(words(&rows[2..]), ["movable wall", "fixed wall"]);
        assert_eq!(rows.iter().filter(|row| stands(row, Some(0.4))).count(), 3);
    }
}
