//! Responses against whatever was swept besides the wave's height, where the spring's stiffness
//! was not: a panel for each of force, runup and displacement, one curve per wave height.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Look, draw};
use super::response::coupling;
use super::{Figure, file_name, of_variant};
use crate::report::curves::{Response, distinct, panels, variants};
use crate::report::error::ReportError;
use crate::report::grid::heading;
use crate::report::load::Loaded;
use crate::report::number;
use crate::report::row::Row;
use crate::report::study::Key;

const WIDTH: f64 = 230.0;
const HEIGHT: f64 = 200.0;
const LEFT: f64 = 66.0;
const GAP: f64 = 78.0;
const RIGHT: f64 = 16.0;

/// Values further apart than this stand on a logarithmic axis.
const DECADES: f64 = 100.0;

/// One case: its place on the horizontal axis and its row.
type Case<'a> = (f64, &'a Row);

/// The first swept key of numbers besides the wave's height, if no two cases differ in their
/// stiffness alone: response curves would have one point each.
pub fn key(data: &Loaded) -> Option<&Key> {
    let has_curve = |panel: &crate::report::curves::Panel| {
        let points = || panel.curves.iter().flat_map(|curve| &curve.points);
        points().any(|p| points().any(|other| other.log10_k_star != p.log10_k_star))
    };
    let variants = variants(&data.rows);
    let mut all = variants.iter().flat_map(|variant| panels(&data.rows, variant, Response::Force));
    if all.any(|panel| has_curve(&panel)) {
        return None;
    }
    data.keys.iter().find(|key| {
        let cases = cases(data, key);
        key.name != "wave_height_ratio" && cases.iter().any(|(x, _)| *x != cases[0].0)
    })
}

/// Finished cases with a number in the key's column.
fn cases<'a>(data: &'a Loaded, key: &Key) -> Vec<Case<'a>> {
    let place = |(row, cell): (&'a Row, &String)| {
        let x: f64 = cell.parse().ok()?;
        (row.is_ok() && x.is_finite()).then_some((x, row))
    };
    data.rows.iter().zip(&key.cells).filter_map(place).collect()
}

/// Whether a row has its place on the key's axis.
pub fn holds(data: &Loaded, key: &Key, row: &Row) -> bool {
    cases(data, key).iter().any(|(_, other)| other.case_id == row.case_id)
}

/// The figures of every combination of what else was swept.
pub fn figures(data: &Loaded, key: &Key) -> Result<Vec<Figure>, ReportError> {
    let waves = distinct(data.rows.iter(), |row| row.wave_height_ratio);
    let cases = cases(data, key);
    let mut groups: Vec<(String, Vec<Case>)> = Vec::new();
    for case in cases {
        let words = others(data, key, case.1);
        match groups.iter_mut().find(|(other, _)| *other == words) {
            Some((_, group)) => group.push(case),
            None => groups.push((words, vec![case])),
        }
    }
    let mut figures = Vec::new();
    for (words, mut group) in groups {
        group.sort_by(|a, b| a.0.total_cmp(&b.0));
        let stem = format!("swept-{}", key.name.replace('_', "-"));
        let name = file_name(&stem, &words);
        let Some(svg) = sheet(&name, key, &group, &waves)? else { continue };
        let heading = heading(&key.name);
        let what = heading.split(", ").next().unwrap_or(&heading);
        figures.push(Figure {
            svg,
            title: format!("Responses against {what}{}", of_variant(&words)),
            caption: caption(what, &group),
            name,
        });
    }
    Ok(figures)
}

/// What else was swept, as far as it varies.
fn others(data: &Loaded, key: &Key, row: &Row) -> String {
    let index = data.rows.iter().position(|other| other.case_id == row.case_id).unwrap_or(0);
    let varies = |other: &&Key| {
        other.name != key.name
            && other.name != "wave_height_ratio"
            && other.cells.iter().any(|cell| *cell != other.cells[0])
    };
    let word = |key: &Key| {
        let cell = &key.cells[index];
        let value = cell.parse::<f64>().map(|value| number::significant(value, 4).to_string());
        format!("{} = {}", key.name, value.unwrap_or_else(|_| cell.clone()))
    };
    data.keys.iter().filter(varies).map(word).collect::<Vec<_>>().join(", ")
}

fn caption(what: &str, group: &[Case]) -> String {
    let moves = group.iter().any(|(_, row)| row.displacement_max.is_some());
    let mut text = format!(
        "Largest force (running mean) and runup of the first impact, or of the whole run where \
         there is none{}, against {what}",
        if moves { ", and largest displacement of the run" } else { "" }
    );
    let waves = distinct(group.iter().map(|(_, row)| *row), |row| row.wave_height_ratio);
    text.push_str(if waves.is_empty() { "." } else { "; one curve per nominal wave height." });
    let bar = |(_, row): &Case| Response::ALL.iter().any(|response| response.error(row).is_some());
    if group.iter().any(bar) {
        text.push_str(" Bars: estimated errors.");
    }
    text.push_str(&coupling(group.iter().map(|(_, row)| *row)));
    if group.iter().any(|(_, row)| row.displacement_truncated == Some(true)) {
        text.push_str(
            " Open markers: the wall was still moving outwards when the run ended, so that the \
             value is a lower bound.",
        );
    }
    text
}

/// The response of a case; that of the whole run where it has no first impact.
fn value(response: Response, row: &Row) -> Option<f64> {
    let whole = match response {
        Response::Force => row.force_max,
        Response::Runup => row.runup_max,
        Response::Displacement => None,
    };
    response.value(row).or(whole).filter(|value| value.is_finite())
}

const ORDER: [Response; 3] = [Response::Force, Response::Runup, Response::Displacement];

/// The drawing; `None` where no case has a response.
fn sheet(
    name: &str,
    key: &Key,
    group: &[Case],
    waves: &[f64],
) -> Result<Option<String>, ReportError> {
    let (low, high) = (group[0].0, group[group.len() - 1].0);
    let logarithmic = low > 0.0 && high >= DECADES * low;
    let x_of = |x: f64| if logarithmic { libm::log10(x) } else { x };
    let Some(x) = Axis::around(group.iter().map(|(x, _)| x_of(*x)), 5.0) else { return Ok(None) };
    let title = heading(&key.name);
    let title = if logarithmic { format!("log₁₀ of {title}") } else { title };
    let drawn: Vec<_> = ORDER
        .into_iter()
        .filter_map(|response| {
            let reach = group.iter().filter_map(|(_, row)| {
                let (value, error) = (value(response, row)?, response.error(row).unwrap_or(0.0));
                Some([value - error, value + error])
            });
            Some((response, Axis::around(reach.flatten(), 6.0)?))
        })
        .collect();
    if drawn.is_empty() {
        return Ok(None);
    }
    let look = |wave: Option<f64>| {
        Look::of(waves.iter().position(|other| Some(*other) == wave).unwrap_or(0))
    };
    let mut curves: Vec<Option<f64>> =
        distinct(group.iter().map(|(_, row)| *row), |row| row.wave_height_ratio)
            .into_iter()
            .map(Some)
            .collect();
    let entry = |wave: &Option<f64>| Entry {
        label: format!("H/h = {}", wave.map(number::plain).unwrap_or_default()),
        look: look(*wave),
        line: true,
        marker: Some(false),
    };
    let right = LEFT + drawn.len() as f64 * (WIDTH + GAP) - GAP;
    let legend = Legend::new(curves.iter().map(entry).collect(), LEFT, right);
    let top = 20.0 + if curves.is_empty() { 0.0 } else { legend.height() };
    curves.push(None);
    draw(name, (right + RIGHT, top + HEIGHT + 48.0), |pen| {
        legend.draw(pen, 6.0)?;
        for (index, (response, y)) in drawn.iter().enumerate() {
            let left = LEFT + index as f64 * (WIDTH + GAP);
            let (x, y) = (x.clone(), y.clone());
            let panel = Panel { left, top, width: WIDTH, height: HEIGHT, x, y };
            panel.draw(pen, true)?;
            panel.title_x(pen, &title)?;
            panel.title_y(pen, response.axis_title())?;
            for wave in &curves {
                let cases = group.iter().filter(|(_, row)| row.wave_height_ratio == *wave);
                let points: Vec<_> = cases
                    .filter_map(|(x, row)| Some((x_of(*x), value(*response, row)?, *row)))
                    .collect();
                let line: Vec<_> = points.iter().map(|(x, y, _)| panel.at(*x, *y)).collect();
                let look = look(*wave);
                if line.len() > 1 {
                    pen.line(&line, look.colour, 1.8)?;
                }
                for ((x, y, row), at) in points.iter().zip(line) {
                    if let Some(error) = response.error(row) {
                        let ends = [panel.at(*x, y - error), panel.at(*x, y + error)];
                        pen.line(&ends, look.colour, 1.2)?;
                    }
                    let open = response.is_truncated(row);
                    pen.marker(at, look, open)?;
                }
            }
        }
        Ok(())
    })
    .map(Some)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    /// A sweep of masses at one stiffness, with the grid's keys in its manifest.
    fn masses(stiffnesses: &[f64]) -> tempfile::TempDir {
        let directory = fixture::movable(&[0.3, 0.5], stiffnesses, &[50.0, 100.0, 250.0]);
        let keys = r#"{"keys": ["wave_height_ratio", "seawall_mass_kg_per_m"]}"#;
        std::fs::write(directory.path().join("manifest.json"), keys).unwrap();
        directory
    }

    #[test]
    fn one_figure_takes_the_place_of_one_point_panels() {
        let directory = masses(&[500.0]);
        let data = Loaded::read(directory.path()).unwrap();
        let key = key(&data).unwrap();
        assert_eq!(key.name, "seawall_mass_kg_per_m");
        let figures = figures(&data, key).unwrap();
        let names: Vec<_> = figures.iter().map(|figure| figure.name.as_str()).collect();
        assert_eq!(names, ["swept-seawall-mass-kg-per-m"]);
        assert!(figures[0].caption.contains("Force coupling s = 1."), "{}", figures[0].caption);
        for word in ["m, kg/m", "F / (½ρgh²)", "R / h", "X / h", "H/h = 0.3"] {
            assert!(figures[0].svg.contains(word), "{word}");
        }
        let all = super::super::all(&data).unwrap();
        assert!(!all.iter().any(|figure| figure.name.starts_with("response")));
    }

    #[test]
    fn two_stiffnesses_make_response_curves() {
        let directory = masses(&[10.0, 500.0]);
        assert_eq!(key(&Loaded::read(directory.path()).unwrap()), None);
    }

    #[test]
    fn scenes_without_a_wave_have_one_curve() {
        let directory = fixture::dam_breaks(5);
        let data = Loaded::read(directory.path()).unwrap();
        let figures = figures(&data, key(&data).unwrap()).unwrap();
        assert_eq!(figures.len(), 1);
        assert!(figures[0].svg.contains("column height, m"));
        assert!(!figures[0].svg.contains("H/h"));
        assert!(!figures[0].caption.contains("wave height"));
    }
}
