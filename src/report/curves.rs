//! Sorts rows for figures and tables: the cases in a response's figure, and the values that occur.

use std::collections::HashSet;

use super::row::Row;
use crate::math::lists::rising;
use crate::quantities::Column;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO,
};

/// What is plotted against the spring's stiffness, as in Figs. 13 to 15 of Liang et al. 2017. The
/// subject of the page's first answer comes first.
pub const RESPONSES: [&Column; 3] = [&FIRST_FORCE_MAX, &FIRST_RUNUP_MAX, &DISPLACEMENT_MAX];

/// The word for a response in file names: `displacement`, `force`, `runup`.
pub fn stem(response: &Column) -> &'static str {
    response.name.trim_start_matches("first_").trim_end_matches("_max")
}

/// The finished cases of one variant that have a response, by rising mass, wave height and
/// stiffness. Cases without a spring have no place on a logarithmic axis and are left out.
pub fn responses<'a>(rows: &'a [Row], variant: &str, response: &Column) -> Vec<&'a Row> {
    let finite = |row: &Row, column: &Column| row.number(column).filter(|one| one.is_finite());
    let place = |row: &Row| {
        finite(row, response)?;
        let [mass, wave, stiffness] =
            [&M_STAR, &WAVE_HEIGHT_RATIO, &LOG10_K_STAR].map(|column| finite(row, column));
        Some([mass?, wave?, stiffness?])
    };
    let all = rows.iter().filter(|row| row.is_ok() && *row.variant == *variant);
    // Each number is read once, as comparing texts is slow.
    let mut all: Vec<_> = all.filter_map(|row| Some((place(row)?, row))).collect();
    all.sort_by(|(a, _), (b, _)| a.partial_cmp(b).expect("finite numbers have an order"));
    all.into_iter().map(|(_, row)| row).collect()
}

/// Rows of the same mass, one group after the other.
pub fn by_mass<'r, 'a>(sorted: &'r [&'a Row]) -> impl Iterator<Item = &'r [&'a Row]> {
    sorted.chunk_by(|a, b| a.number(&M_STAR) == b.number(&M_STAR))
}

/// Whether two rows of the same mass differ in stiffness. If not, no curve has two points.
pub fn has_curve(sorted: &[&Row]) -> bool {
    let stiffness = |row: &Row| row.number(&LOG10_K_STAR);
    by_mass(sorted).any(|rows| rows.iter().any(|row| stiffness(row) != stiffness(rows[0])))
}

/// The different values of a column among rows, in rising order; empty cells are left out.
pub fn distinct<'a>(rows: impl Iterator<Item = &'a Row>, column: &Column) -> Vec<f64> {
    let numbers = rows.filter_map(|row| row.number(column));
    rising(numbers.filter(|value| value.is_finite()))
}

/// At most `most` of the items, evenly spread, with both ends.
pub fn spread<T: Clone>(items: &[T], most: usize) -> Vec<T> {
    spread_places(items.len(), most).map(|place| items[place].clone()).collect()
}

/// The places of those.
pub fn spread_places(all: usize, most: usize) -> impl Iterator<Item = usize> {
    let (count, last) = (all.min(most), all.saturating_sub(1));
    (0..count).map(move |index| (index * last + (count - 1) / 2) / (count - 1).max(1))
}

/// The variants of a sweep in the order of their first row. Usually there is one, without a name.
pub fn variants(rows: &[Row]) -> Vec<String> {
    let mut seen = HashSet::new();
    let first = rows.iter().filter(|row| seen.insert(&*row.variant));
    first.map(|row| row.variant.to_string()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::STATUS;

    fn row(wave: f64, log10_k_star: f64, m_star: f64, value: Option<f64>) -> Row {
        let row = Row::default()
            .with(&STATUS, if value.is_some() { "ok" } else { "failed" })
            .with(&WAVE_HEIGHT_RATIO, wave)
            .with(&LOG10_K_STAR, log10_k_star)
            .with(&M_STAR, m_star);
        value.into_iter().fold(row, |row, value| row.with(&DISPLACEMENT_MAX, value))
    }

    #[test]
    fn masses_waves_and_stiffnesses_rise() {
        let rows = [
            row(0.4, 1.0, 5.0, Some(1.0)),
            row(0.2, 2.0, 5.0, Some(0.2)),
            row(0.2, 1.0, 5.0, Some(0.3)),
            row(0.2, 1.0, 1.0, Some(0.5)),
            row(0.6, 1.0, 1.0, None),
        ];
        let sorted = responses(&rows, "", &DISPLACEMENT_MAX);
        let values: Vec<_> = sorted.iter().map(|row| row.text(&DISPLACEMENT_MAX)).collect();
        assert_eq!(values, ["0.5", "0.3", "0.2", "1"], "a failed case has no point");
        assert_eq!(by_mass(&sorted).map(<[_]>::len).collect::<Vec<_>>(), [1, 3]);
    }

    #[test]
    fn a_spring_of_no_stiffness_has_no_place_on_a_logarithmic_axis() {
        let rows = [row(0.4, f64::NEG_INFINITY, 5.0, Some(1.0))];
        assert!(responses(&rows, "", &DISPLACEMENT_MAX).is_empty());
    }

    #[test]
    fn spreading_keeps_both_ends() {
        let ten: Vec<f64> = (0..10).map(f64::from).collect();
        assert_eq!(spread(&ten, 6), [0.0, 2.0, 4.0, 5.0, 7.0, 9.0]);
        assert_eq!(spread(&[3.0], 6), [3.0]);
        assert_eq!(spread::<f64>(&[], 6), [0.0; 0]);
    }
}
