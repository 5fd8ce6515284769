//! Runup and force at a fixed wall against the wave's height; at an upright wall beside the exact
//! solitary wave.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Look, draw};
use super::{Figure, file_name, of_variant, swept};
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
    let key = swept::key(data);
    let mut figures = Vec::new();
    for variant in variants(&data.rows) {
        let rows: Vec<_> = walls(data, &variant).collect();
        // A lone point makes no curve: it is worth a figure only beside the exact wave, and where
        // no other figure has it.
        let elsewhere = |row: &Row| key.is_some_and(|key| swept::holds(data, key, row));
        let lone = rows.len() == 1 && rows.iter().all(|row| !row.is_vertical() || elsewhere(row));
        if rows.is_empty() || lone {
            continue;
        }
        let name = file_name("fixed-wall", &variant);
        let measured = rows.iter().all(|row| row.measured_wave_height_ratio.is_some());
        let height = if measured { "measured at the gauge" } else { "nominal" };
        let vertical = rows.iter().all(|row| row.is_vertical());
        let beside = if vertical {
            " Line: the exact solitary wave of the Euler equations reflected by a vertical wall."
        } else {
            " The wall is inclined, for which there is no exact solution to compare with; the \
             force is that along x."
        };
        let bars = if rows.iter().any(|row| row.force_error.or(row.runup_error).is_some()) {
            " Bars: estimated errors."
        } else {
            ""
        };
        figures.push(Figure {
            svg: sheet(&name, &rows, measured, vertical)?,
            title: format!("Runup and force at a fixed wall{}", of_variant(&variant)),
            caption: format!(
                "Largest runup and force of the first impact on a fixed wall against the wave \
                 height ({height}).{beside}{bars}"
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

/// A pair of panels; with the exact wave where the walls are `vertical`.
fn sheet(name: &str, rows: &[&Row], measured: bool, vertical: bool) -> Result<String, ReportError> {
    let wave =
        |row: &Row| if measured { row.measured_wave_height_ratio } else { row.wave_height_ratio };
    let look = Look::of(0);
    let mut entries =
        vec![Entry { label: "computed".to_owned(), look, line: false, marker: Some(false) }];
    if vertical {
        let label = "exact solitary wave".to_owned();
        entries.push(Entry { label, look: Look::plain(), line: true, marker: None });
    }
    let legend = Legend::new(entries, LEFT, LEFT + 2.0 * WIDTH);
    let top = 20.0 + legend.height();
    type Read = fn(&Row) -> Option<f64>;
    type Side = (&'static str, Read, Read, fn(&(f64, f64, f64)) -> f64);
    let sides: [Side; 2] = [
        ("R / h", |row| row.first_runup_max, |row| row.runup_error, |exact| exact.1),
        ("F / (½ρgh²)", |row| row.first_force_max, |row| row.force_error, |exact| exact.2),
    ];
    let known = if vertical { &EXACT[..] } else { &[] };
    draw(name, (LEFT + 2.0 * WIDTH + GAP + 16.0, top + HEIGHT + 48.0), |pen| {
        legend.draw(pen, 6.0)?;
        for (index, (title, computed, error, exact)) in sides.iter().enumerate() {
            let points: Vec<_> = rows
                .iter()
                .filter_map(|r| Some((wave(r)?, computed(r)?, error(r).unwrap_or(0.0))))
                .collect();
            let line: Vec<_> = known.iter().map(|point| (point.0, exact(point))).collect();
            let ends = points.iter().flat_map(|(x, y, error)| [(*x, y - error), (*x, y + error)]);
            let both = || ends.clone().chain(line.iter().copied());
            let x = Axis::around(both().map(|point| point.0), 8.0);
            let y = Axis::around(both().map(|point| point.1), 6.0);
            let Some((x, y)) = x.zip(y) else { continue };
            let left = LEFT + index as f64 * (WIDTH + GAP);
            let panel = Panel { left, top, width: WIDTH, height: HEIGHT, x, y };
            panel.draw(pen, true)?;
            panel.title_x(pen, if measured { "H / h, measured" } else { "H / h" })?;
            panel.title_y(pen, title)?;
            let line: Vec<_> = line.iter().map(|point| panel.at(point.0, point.1)).collect();
            if !line.is_empty() {
                pen.line(&line, Look::plain().colour, 1.5)?;
            }
            for (x, y, error) in points {
                if error > 0.0 {
                    pen.line(&[panel.at(x, y - error), panel.at(x, y + error)], look.colour, 1.2)?;
                }
                pen.marker(panel.at(x, y), look, false)?;
            }
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn an_inclined_wall_is_not_drawn_against_an_upright_ones_answer() {
        let directory = fixture::fixed();
        let mut data = Loaded::read(directory.path()).unwrap();
        let upright = figures(&data).unwrap().remove(0);
        assert!(upright.svg.contains("exact solitary wave"));
        assert!(upright.caption.contains("reflected by a vertical wall"));
        for row in &mut data.rows {
            row.wall_angle_deg = Some(120.0);
        }
        let inclined = figures(&data).unwrap().remove(0);
        assert!(!inclined.svg.contains("exact solitary wave"));
        assert!(inclined.caption.contains("inclined") && !inclined.caption.contains("Line"));
    }
}
