//! Response curves after Figs. 13 to 15 of Liang et al. 2017: displacement, force and runup
//! against the spring's stiffness, one panel per mass, one curve per wave height.

use super::axes::Axis;
use super::legend::Entry;
use super::pen::Look;
use super::sheet::{Chart, Curve, Layout, Point, sheet};
use super::{Figure, file_name, of_variant, printed};
use crate::quantities::summary::{FORCE_COUPLING, LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, Unit};
use crate::report::curves::{RESPONSES, by_mass, distinct, responses, stem, variants};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::row::{Row, label};

/// The figures of every response and variant that has points.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let waves = distinct(data.rows.iter(), &WAVE_HEIGHT_RATIO);
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        for response in RESPONSES {
            let rows = responses(&data.rows, &variant, response);
            if rows.is_empty() {
                continue;
            }
            let name = file_name(&format!("response-{}", stem(response)), &variant);
            let law = coupling(data.finished().filter(|row| row.variant == variant));
            let what = capitalised(response.meaning);
            figures.push(Figure {
                svg: drawing(data, &name, response, &rows, &waves)?,
                caption: format!(
                    "{what} against the spring stiffness k* = k/(ρgh²), one panel per wall mass \
                     m* = m/(ρh²), one curve per nominal wave height.{}{law}",
                    marks(&rows, &[response])
                ),
                title: format!("{what}{}", of_variant(&variant)),
                name,
            });
        }
    }
    Ok(figures)
}

fn capitalised(text: &str) -> String {
    let mut letters = text.trim().chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The motion law that cases follow, as every figure of a movable wall has to say.
pub fn coupling<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let factors = distinct(rows.filter(|row| !row.is_fixed()), &FORCE_COUPLING);
    let factors: Vec<_> = factors.into_iter().map(crate::report::number::plain).collect();
    if factors.is_empty() {
        return String::new();
    }
    format!(" Force coupling s = {}.", factors.join(", "))
}

/// What a caption says of error bars and of open markers, as far as there are any.
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
            " Open markers: the wall was still moving outwards when the run ended, so that the \
             value is a lower bound.",
        );
    }
    text
}

/// One curve per wave height that occurs, coloured by its place among `waves`, and one of cases
/// without a wave. A case stands at its `x`.
pub fn by_wave(
    cases: &[(f64, &Row)],
    waves: &[f64],
    column: &Column,
    value: impl Fn(&Row) -> Option<f64>,
) -> Vec<Curve> {
    let all = waves.iter().map(|wave| Some(*wave)).chain([None]).enumerate();
    let curve = |(index, wave): (usize, Option<f64>)| {
        let own = cases.iter().filter(|(_, row)| row.number(&WAVE_HEIGHT_RATIO) == wave);
        let point = |(x, row): &(f64, &Row)| {
            let (y, error) = (value(row)?, row.error(column).unwrap_or(0.0));
            Some(Point { x: *x, y, error, open: row.is_bound(column), ..Point::default() })
        };
        let points: Vec<_> = own.filter_map(point).collect();
        let words = wave.map(|wave| label(&WAVE_HEIGHT_RATIO, wave)).unwrap_or_default();
        let look = Look::of(if wave.is_some() { index } else { 0 });
        (!points.is_empty()).then_some(Curve { entry: Entry::marked(words, look), points })
    };
    let mut curves: Vec<_> = all.filter_map(curve).collect();
    if cases.iter().any(|(_, row)| row.is_bound(column)) {
        let entry = Entry::dots("still moving at the end", Look::plain(), true);
        curves.push(Curve { entry, points: Vec::new() });
    }
    curves
}

fn drawing(
    data: &Loaded,
    name: &str,
    response: &Column,
    rows: &[&Row],
    waves: &[f64],
) -> Result<String, ReportError> {
    let curves = |rows: &[&Row]| {
        let places = rows.iter().filter_map(|row| Some((row.number(&LOG10_K_STAR)?, *row)));
        let cases: Vec<_> = places.collect();
        let mut curves = by_wave(&cases, waves, response, |row| row.number(response));
        curves.extend(printed::of_response(data, response, rows));
        curves
    };
    let all = curves(rows);
    let places = all.iter().flat_map(|curve| &curve.points).map(|point| point.x);
    let floor = if response.unit == Unit::Force { 1.0 } else { 0.0 };
    let x = Axis::around(places, 6.0);
    let y = Axis::around(all.iter().flat_map(Curve::reach).chain([floor]), 7.0);
    let (x, y) = x.zip(y).expect("a response has points, and points are finite");
    let chart = |rows: &[&Row]| Chart {
        heading: rows[0].number(&M_STAR).map(|mass| label(&M_STAR, mass)).unwrap_or_default(),
        titles: [LOG10_K_STAR.heading(), response.unit.axis().to_owned()],
        x: x.clone(),
        y: y.clone(),
        curves: curves(rows),
    };
    let charts: Vec<_> = by_mass(rows).map(chart).collect();
    sheet(name, &charts, Layout { columns: 3, size: (250.0, 185.0) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::FORCE_ERROR;
    use crate::report::fixture;

    #[test]
    fn bars_are_told_where_there_are_any() {
        let directory = fixture::sweep();
        let mut data = Loaded::read(directory.path()).unwrap();
        assert!(figures(&data).unwrap().iter().all(|f| !f.caption.contains("Bars")));
        for row in &mut data.rows {
            *row = row.clone().with(&FORCE_ERROR, 0.03);
        }
        for figure in figures(&data).unwrap() {
            let told = figure.caption.contains("Bars: estimated errors.");
            assert_eq!(told, figure.name == "response-force", "{}", figure.caption);
        }
    }

    #[test]
    fn masses_and_waves_of_a_range_are_rounded_in_labels() {
        let directory = fixture::movable(&[0.3, 0.316_227_766], &[10.0, 500.0], &[46.415_888_3]);
        let data = Loaded::read(directory.path()).unwrap();
        let svg = &figures(&data).unwrap()[0].svg;
        assert!(svg.contains("H/h = 0.3162<") || svg.contains("H/h = 0.3162\n"), "{svg}");
        assert!(svg.contains("m* = 1.16"));
        assert!(!svg.contains("0.316227766") && !svg.contains("1.1603"));
    }
}
