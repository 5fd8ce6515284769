//! Runup and force at a fixed wall against the wave's height, beside the exact solitary wave.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Look, draw};
use super::{Figure, file_name, of_variant};
use crate::report::curves::variants;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::row::Row;

const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 66.0;
const GAP: f64 = 84.0;

/// The exact solitary wave of the Euler equations, reflected by a vertical wall: H/h, runup over
/// h, and the first peak of F/(½ρgh²). A wave of no height leaves still water.
const EXACT: [(f64, f64, f64); 7] = [
    (0.0, 0.0, 1.0),
    (0.1, 0.20555, 1.4245),
    (0.2, 0.42413, 1.8726),
    (0.3, 0.6602, 2.3015),
    (0.4, 0.9237, 2.6779),
    (0.5, 1.2384, 3.0617),
    (0.6, 1.66, 3.489),
];

/// The figure of every variant with fixed walls and waves.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        let rows: Vec<_> = walls(data, &variant).collect();
        if rows.is_empty() {
            continue;
        }
        let name = file_name("fixed-wall", &variant);
        let measured = rows.iter().all(|row| row.measured_wave_height_ratio.is_some());
        let height = if measured { "measured at the gauge" } else { "nominal" };
        figures.push(Figure {
            svg: sheet(&name, &rows, measured)?,
            title: format!("Runup and force at a fixed wall{}", of_variant(&variant)),
            caption: format!(
                "Largest runup and force of the first impact on a fixed wall against the wave \
                 height ({height}). Line: the exact solitary wave of the Euler equations \
                 reflected by a vertical wall."
            ),
            name,
        });
    }
    Ok(figures)
}

/// Finished cases of one variant with a wave and a fixed wall.
pub fn walls<'a>(data: &'a Loaded, variant: &str) -> impl Iterator<Item = &'a Row> {
    data.finished().filter(move |row| {
        row.is_fixed()
            && row.variant == variant
            && row.wave_height_ratio.is_some_and(|wave| wave > 0.0)
            && row.first_force_max.is_some()
            && row.first_runup_max.is_some()
    })
}

fn sheet(name: &str, rows: &[&Row], measured: bool) -> Result<String, ReportError> {
    let wave =
        |row: &Row| if measured { row.measured_wave_height_ratio } else { row.wave_height_ratio };
    let look = Look::of(0);
    let entries = vec![
        Entry { label: "computed".to_owned(), look, line: false, marker: Some(false) },
        Entry {
            label: "exact solitary wave".to_owned(),
            look: Look::plain(),
            line: true,
            marker: None,
        },
    ];
    let legend = Legend::new(entries, LEFT, LEFT + 2.0 * WIDTH);
    let top = 20.0 + legend.height();
    type Side = (&'static str, fn(&Row) -> Option<f64>, fn(&(f64, f64, f64)) -> f64);
    let sides: [Side; 2] = [
        ("R / h", |row| row.first_runup_max, |exact| exact.1),
        ("F / (½ρgh²)", |row| row.first_force_max, |exact| exact.2),
    ];
    draw(name, (LEFT + 2.0 * WIDTH + GAP + 16.0, top + HEIGHT + 48.0), |pen| {
        legend.draw(pen, 6.0)?;
        for (index, (title, computed, exact)) in sides.iter().enumerate() {
            let points: Vec<_> =
                rows.iter().filter_map(|r| Some((wave(r)?, computed(r)?))).collect();
            let line: Vec<_> = EXACT.iter().map(|point| (point.0, exact(point))).collect();
            let both = || points.iter().chain(&line);
            let x = Axis::around(both().map(|point| point.0), 8.0);
            let y = Axis::around(both().map(|point| point.1), 6.0);
            let (x, y) = x.zip(y).expect("the exact wave has points");
            let left = LEFT + index as f64 * (WIDTH + GAP);
            let panel = Panel { left, top, width: WIDTH, height: HEIGHT, x, y };
            panel.draw(pen, true)?;
            panel.title_x(pen, if measured { "H / h, measured" } else { "H / h" })?;
            panel.title_y(pen, title)?;
            let line: Vec<_> = line.iter().map(|point| panel.at(point.0, point.1)).collect();
            pen.line(&line, Look::plain().colour, 1.5)?;
            for point in points {
                pen.marker(panel.at(point.0, point.1), look, false)?;
            }
        }
        Ok(())
    })
}
