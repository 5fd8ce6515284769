//! Response curves after Figs. 13 to 15 of Liang et al. 2017: displacement, force and runup
//! against the spring's stiffness, one panel per mass, one curve per wave height.

use super::axes::Axis;
use super::chart::{Chart, Curve, places, reach};
use super::marks::{bounds, by, coupling, key, marks, picked, point, said, springless};
use super::sheet::{Drawing, PANELS};
use super::{Figure, SERIES, file_name, of_variant, printed};
use crate::math::words::capitalised;
use crate::quantities::summary::{LOG10_K_STAR, M_STAR, WAVE_HEIGHT_RATIO};
use crate::quantities::{Column, Unit};
use crate::report::curves::{
    RESPONSES, by_mass, distinct, has_curve, responses, spread, stem, variants,
};
use crate::report::load::Loaded;
use crate::report::row::Row;

/// The figures of every response and variant with two stiffnesses or more.
pub fn figures(data: &Loaded) -> Vec<Figure> {
    let waves = spread(&distinct(data.rows.iter(), &WAVE_HEIGHT_RATIO), SERIES);
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        for response in RESPONSES {
            let rows = responses(&data.rows, &variant, response);
            if !has_curve(&rows) {
                continue;
            }
            let all: Vec<_> = by_mass(&rows).collect();
            let shown = spread(&all, SERIES);
            let law = coupling(data.of_variant(&variant));
            let what = capitalised(response.meaning);
            let of_masses = picked(shown.len(), all.len(), "masses");
            let count = distinct(rows.iter().copied(), &WAVE_HEIGHT_RATIO).len();
            let of_waves = picked(waves.len(), count, "wave heights");
            figures.push(Figure {
                drawing: drawing(data, response, &shown, &waves),
                caption: format!(
                    "{what} against the spring stiffness k* = k/(ρgh²), one panel per wall mass \
                     m* = m/(ρh²), one curve per nominal wave height.{}{}{law}{of_masses}{of_waves}",
                    springless(data.of_variant(&variant)),
                    marks(&rows, &[response])
                ),
                title: format!("{what}{}", of_variant(&variant)),
                name: file_name(&format!("response-{}", stem(response)), &variant),
            });
        }
    }
    figures
}

fn drawing(data: &Loaded, response: &Column, masses: &[&[&Row]], waves: &[f64]) -> Drawing {
    let curves = |rows: &[&Row]| {
        let places = rows.iter().filter_map(|row| Some((row.number(&LOG10_K_STAR)?, *row)));
        let cases: Vec<_> = places.collect();
        let curves = by(&WAVE_HEIGHT_RATIO, waves, &cases, |x, row| point(row, x, response));
        curves
            .into_iter()
            .chain(printed::by_wave(data, response, rows, (&LOG10_K_STAR, waves)))
            .collect::<Vec<_>>()
    };
    let all: Vec<Curve> = masses.iter().flat_map(|rows| curves(rows)).collect();
    let floor = if response.unit == Unit::Force { 1.0 } else { 0.0 };
    let x = Axis::around(places(&all), 6.0);
    let y = Axis::around(reach(&all).chain([floor]), 6.0);
    let (x, y) = x.zip(y).expect("a response has points, and points are finite");
    let chart = |rows: &&[&Row]| {
        let mass = rows[0].number(&M_STAR).unwrap_or_default();
        let (title, names) = (LOG10_K_STAR.heading(), [LOG10_K_STAR.name, response.name]);
        let curves = curves(rows).into_iter().chain(bounds(&all)).collect();
        Chart::new((x.clone(), y.clone()), [&title, response.unit.axis()], names, curves)
            .under(said(rows.iter().copied(), &M_STAR, mass), key(&M_STAR, mass))
    };
    Drawing::new(masses.iter().map(chart).collect(), PANELS)
}

#[cfg(test)]
mod tests {
    use super::super::Place;
    use super::*;
    use crate::quantities::summary::FORCE_ERROR;
    use crate::report::fixture;

    #[test]
    fn bars_are_told_where_there_are_any() {
        let (_directory, mut data) = fixture::read(fixture::sweep());
        assert!(figures(&data).iter().all(|f| !f.caption.contains("Bars")));
        data.set_all(&FORCE_ERROR, 0.03);
        for figure in figures(&data) {
            let told = figure.caption.contains("Bars: estimated errors.");
            assert_eq!(told, figure.name == "response-force", "{}", figure.caption);
            assert_eq!(told, figure.svg().contains("± 0.03"), "{}", figure.name);
        }
    }

    #[test]
    fn masses_and_waves_of_a_range_are_rounded_in_labels() {
        let (_directory, data) =
            fixture::read(fixture::movable(&[0.3, 0.316_227_766], &[10.0, 500.0], &[46.415_888_3]));
        let svg = figures(&data)[0].inline(Place::Usual);
        assert!(svg.contains(">H/h = 0.3162<") && svg.contains(">m = 46.42 kg/m (m* = 1.16)<"));
        assert!(!svg.contains(">H/h = 0.316227766<") && !svg.contains("m* = 1.1603"));
    }

    #[test]
    fn of_many_masses_and_waves_six_are_drawn_and_the_caption_says_so() {
        let many: Vec<f64> = (1..=9).map(f64::from).collect();
        let waves: Vec<f64> = many.iter().map(|wave| wave * 0.05).collect();
        let directory = fixture::movable(&waves, &[10.0, 500.0], &many);
        let figure = figures(&Loaded::read(directory.path()).unwrap()).remove(0);
        assert_eq!(figure.drawing.charts.len(), 6);
        let told = "Shown are 6 of 9 masses. Shown are 6 of 9 wave heights.";
        assert!(figure.caption.ends_with(told), "{}", figure.caption);
    }
}
