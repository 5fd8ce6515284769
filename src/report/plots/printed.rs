//! What the papers print, as markers in a study's figures.

use super::chart::{Curve, Point};
use super::legend::Entry;
use super::look::Look;
use crate::papers::{Printed, printed, scenes};
use crate::quantities::Column;
use crate::quantities::summary::WAVE_HEIGHT_RATIO;
use crate::report::config::Config;
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row, label};

/// The legend's words.
pub(in crate::report) const PRINTED: &str = "printed in the papers";

/// The look of printed numbers in all figures.
pub(in crate::report) fn entry() -> Entry {
    Entry::dots(PRINTED, Look::ink().printed(), false).keyed("printed")
}

/// Printed numbers in the colour of a curve, which is given by its place in the panel.
pub(in crate::report) fn coloured(curve: usize) -> Entry {
    Entry::dots("", Look::of(curve).printed(), false).keyed("printed")
}

/// A printed number as a point.
pub(in crate::report) fn point(place: (f64, f64), row: &Row, printed: &Printed) -> Point {
    let wave = row.number(&WAVE_HEIGHT_RATIO).map(|wave| label(&WAVE_HEIGHT_RATIO, wave));
    let wave = wave.map(|wave| format!(" for {wave}")).unwrap_or_default();
    let (figure, value, unit) = (&printed.figure, printed.value, &printed.unit);
    let told = format!("printed in Fig. {figure}{wave}: {value} {unit}");
    let case = row.id().to_owned();
    Point { open: true, case, told: told.trim_end().to_owned(), ..place.into() }
}

/// Markers of a panel: what the papers print for this column and these cases, at their places in
/// the column `x`. `None` if they print nothing.
pub fn beside(data: &Loaded, column: &Column, rows: &[&Row], x: &Column) -> Option<Curve> {
    let mut points: Vec<Point> = Vec::new();
    for number in printed().iter().filter(|number| number.quantity == column.name) {
        let own = rows.iter().filter(|row| number.holds_at(PLACE.map(|c| row.number(c))));
        for row in own.filter(|row| is_theirs(data, row, number)) {
            let point = row.number(x).map(|x| point((x, number.value), row, number));
            points.extend(point.filter(|point| !points.contains(point)));
        }
    }
    (!points.is_empty()).then(|| Curve { entry: entry(), points })
}

/// The same where each wave has a curve: in the colours of these waves, with an entry in the legend
/// for all.
pub fn by_wave(
    data: &Loaded,
    column: &Column,
    rows: &[&Row],
    (x, waves): (&Column, &[f64]),
) -> Vec<Curve> {
    let curve = |(place, wave): (usize, &f64)| {
        let own = rows.iter().filter(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(*wave));
        let own: Vec<&Row> = own.copied().collect();
        Some(Curve { entry: coloured(place), ..beside(data, column, &own, x)? })
    };
    let mut curves: Vec<_> = waves.iter().enumerate().filter_map(curve).collect();
    if !curves.is_empty() {
        curves.push(Curve { entry: entry(), points: Vec::new() });
    }
    curves
}

/// Whether a case has the scene of a printed number.
fn is_theirs(data: &Loaded, row: &Row, number: &Printed) -> bool {
    let place = data.rows.iter().position(|other| std::ptr::eq(other, row));
    let config = place.and_then(|place| Config::of(data, place));
    config.is_some_and(|config| scenes(&config.scene).any(|scene| scene == number.scene))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{FIRST_FORCE_MAX, LOG10_K_STAR};
    use crate::report::fixture;

    /// The story: all numbers of the papers were black, and one of H/h = 0.3 lay on the curve of 0.5 as if it agreed.
    #[test]
    fn each_number_has_the_colour_of_its_wave() {
        let (_directory, data) =
            fixture::read(fixture::movable(&[0.3, 0.5], &[10.0, 500.0], &[50.0]));
        let file = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    spring_stiffness_n_per_m = 10\n[grid]\nwave_height_ratio = [0.3, 0.5]";
        let data = data.made_from(file, &[]);
        let rows: Vec<&Row> = data.rows.iter().collect();
        let curves = by_wave(&data, &FIRST_FORCE_MAX, &rows, (&LOG10_K_STAR, &[0.5, 0.3]));
        let told: Vec<_> = curves.iter().flat_map(|curve| &curve.points).collect();
        assert!(!told.is_empty() && curves.last().unwrap().points.is_empty(), "{curves:?}");
        for (wave, look) in [(0.3, Look::of(1)), (0.5, Look::of(0))] {
            let own = format!(" for H/h = {wave}: ");
            for curve in curves.iter().filter(|c| c.points.iter().any(|p| p.told.contains(&own))) {
                assert_eq!(curve.entry.look, look.printed());
                assert!(curve.points.iter().all(|point| point.told.contains(&own)), "{curve:?}");
            }
        }
        assert!(told.iter().any(|point| point.told.contains("for H/h = 0.3")), "{told:?}");
    }
}
