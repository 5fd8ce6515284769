//! Response curves after Figs. 13 to 15 of Liang et al. 2017: displacement, force and runup
//! against the spring's stiffness, one panel per mass, one curve per wave height.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Fault, Look, Pen, draw};
use super::{Figure, file_name, of_variant};
use crate::report::curves::{self, Curve, Response, distinct, panels, variants};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::row::Row;

const WIDTH: f64 = 250.0;
const HEIGHT: f64 = 185.0;
const GAP: f64 = 46.0;
const LEFT: f64 = 66.0;
const RIGHT: f64 = 16.0;
const HEADING: f64 = 26.0;
const FOOT: f64 = 46.0;

/// The figures of every response and variant that has points.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let waves = distinct(data.rows.iter(), |row| row.wave_height_ratio);
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        for response in Response::ALL {
            let panels = panels(&data.rows, &variant, response);
            if panels.is_empty() {
                continue;
            }
            let name = file_name(&format!("response-{}", response.name()), &variant);
            let law = coupling(data.finished().filter(|row| row.variant == variant));
            let title = title(response);
            figures.push(Figure {
                svg: sheet(&name, response, &panels, &waves)?,
                caption: caption(response, &panels, &law),
                title: format!("{title}{}", of_variant(&variant)),
                name,
            });
        }
    }
    Ok(figures)
}

fn title(response: Response) -> &'static str {
    match response {
        Response::Displacement => "Maximum displacement of the seawall",
        Response::Force => "Maximum force on the seawall, first impact",
        Response::Runup => "Maximum runup at the seawall, first impact",
    }
}

/// The motion law that cases follow, as every figure of a movable wall has to say.
pub fn coupling<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let factors = distinct(rows.filter(|row| !row.is_fixed()), |row| row.force_coupling);
    let factors: Vec<_> = factors.into_iter().map(number::plain).collect();
    if factors.is_empty() {
        return String::new();
    }
    format!(" Force coupling s = {}.", factors.join(", "))
}

fn caption(response: Response, panels: &[curves::Panel], law: &str) -> String {
    let what = match response {
        Response::Displacement => "Largest displacement over the whole run",
        Response::Force => "Largest force over the first impact (running mean)",
        Response::Runup => "Largest runup over the first impact",
    };
    let open = if truncated(panels) {
        " Open markers: the wall was still moving outwards when the run ended, so that the value \
         is a lower bound."
    } else {
        ""
    };
    let mut points = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.points);
    let bars =
        if points.any(|point| point.error.is_some()) { " Bars: estimated errors." } else { "" };
    format!(
        "{what} against the spring stiffness k* = k/(ρgh²), one panel per wall mass \
         m* = m/(ρh²), one curve per nominal wave height.{bars}{open}{law}"
    )
}

fn truncated(panels: &[curves::Panel]) -> bool {
    let curves = panels.iter().flat_map(|panel| &panel.curves);
    curves.flat_map(|curve| &curve.points).any(|point| point.truncated)
}

fn legend(panels: &[curves::Panel], waves: &[f64], right: f64) -> Legend {
    let drawn = |wave: &f64| {
        panels.iter().flat_map(|panel| &panel.curves).any(|c| c.wave_height_ratio == *wave)
    };
    let mut entries: Vec<_> = waves
        .iter()
        .enumerate()
        .filter(|(_, wave)| drawn(wave))
        .map(|(index, wave)| Entry {
            label: format!("H/h = {}", number::plain(*wave)),
            look: Look::of(index),
            line: true,
            marker: Some(false),
        })
        .collect();
    if truncated(panels) {
        let label = "still moving at the end".to_owned();
        entries.push(Entry { label, look: Look::plain(), line: false, marker: Some(true) });
    }
    Legend::new(entries, LEFT, right)
}

fn sheet(
    name: &str,
    response: Response,
    panels: &[curves::Panel],
    waves: &[f64],
) -> Result<String, ReportError> {
    let points = || panels.iter().flat_map(|p| &p.curves).flat_map(|c| &c.points);
    let x = Axis::around(points().map(|point| point.log10_k_star), 6.0);
    let floor = if response == Response::Force { 1.0 } else { 0.0 };
    let reach = points().flat_map(|p| {
        let error = p.error.unwrap_or(0.0);
        [p.value - error, p.value + error]
    });
    let y = Axis::around(reach.chain([floor]), 7.0);
    let (x, y) = x.zip(y).expect("a panel has points, and points are finite");

    let columns = panels.len().min(3);
    let rows = panels.len().div_ceil(columns);
    let width = (LEFT + columns as f64 * (WIDTH + GAP) - GAP + RIGHT).max(420.0);
    let legend = legend(panels, waves, width - RIGHT);
    let top = 8.0 + legend.height();
    let row_height = HEADING + HEIGHT + FOOT;
    draw(name, (width, top + rows as f64 * row_height + 4.0), |pen| {
        legend.draw(pen, 6.0)?;
        for (index, panel) in panels.iter().enumerate() {
            let (column, row) = (index % columns, index / columns);
            let place = Panel {
                left: LEFT + column as f64 * (WIDTH + GAP),
                top: top + row as f64 * row_height + HEADING,
                width: WIDTH,
                height: HEIGHT,
                x: x.clone(),
                y: y.clone(),
            };
            place.draw(pen, true)?;
            place.heading(pen, &format!("m* = {}", number::plain(panel.m_star)))?;
            if column == 0 {
                place.title_y(pen, response.axis_title())?;
            }
            if index + columns >= panels.len() {
                place.title_x(pen, "log₁₀ k*")?;
            }
            for curve in &panel.curves {
                let index = waves.iter().position(|wave| *wave == curve.wave_height_ratio);
                draw_curve(pen, &place, curve, Look::of(index.unwrap_or(0)))?;
            }
        }
        Ok(())
    })
}

fn draw_curve(pen: &Pen, place: &Panel, curve: &Curve, look: Look) -> Result<(), Fault> {
    let line: Vec<_> =
        curve.points.iter().map(|point| place.at(point.log10_k_star, point.value)).collect();
    if line.len() > 1 {
        pen.line(&line, look.colour, 1.8)?;
    }
    for (point, at) in curve.points.iter().zip(line) {
        if let Some(error) = point.error {
            let low = place.at(point.log10_k_star, point.value - error);
            let high = place.at(point.log10_k_star, point.value + error);
            pen.line(&[low, high], look.colour, 1.2)?;
        }
        pen.marker(at, look, point.truncated)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn bars_are_told_where_there_are_any() {
        let directory = fixture::sweep();
        let mut data = Loaded::read(directory.path()).unwrap();
        assert!(figures(&data).unwrap().iter().all(|f| !f.caption.contains("Bars")));
        for row in &mut data.rows {
            row.force_error = Some(0.03);
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
