//! What pressure, level and void gauges recorded over time: one figure per case, one panel per unit
//! and for at most six gauges.

use super::Figure;
use super::marks::shown_are;
use super::over_time::{self, Line, Strip};
use crate::math::lists::different;
use crate::quantities::heading;
use crate::report::curves::spread;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::series::Series;
use crate::scene::{CREST_COLUMNS, OVER_STILL_WATER};

const CASES: usize = 4;
/// Curves in a panel: one for each colour.
const CURVES: usize = 6;
/// The column of a wall with a crest.
const CREST_THICKNESS: &str = "crest_thickness_m";
/// The unit of volumes.
const VOLUME: &str = "m2";
/// Volumes that are further apart have panels of their own.
const MANY_TIMES: f64 = 10.0;
/// Smaller values count as 0, in any unit.
const NAUGHT: f64 = 1e-9;

/// The figures of a few cases with gauges, spread over the sweep.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let rows: Vec<_> = data.finished().filter(|row| data.has_gauges(row.id())).collect();
    let chosen = spread(&rows, CASES);
    let shown = if chosen.len() < rows.len() {
        format!(
            " {} of {} cases with gauges, spread over the sweep's order; the others are in probes/.",
            shown_are(chosen.len()),
            rows.len()
        )
    } else {
        String::new()
    };
    let mut figures = Vec::new();
    for row in chosen {
        let case_id = row.id();
        let (strips, empty): (Vec<_>, Vec<_>) =
            strips(case_id, &data.gauges(case_id)?.0).into_iter().partition(holds_anything);
        if strips.is_empty() {
            continue;
        }
        let empty = if empty.is_empty() { "" } else { " Panels of nothing but 0 are left out." };
        let words = row.words();
        let case = if words.is_empty() { String::new() } else { format!(", {words}") };
        let name = format!("probes-{case_id}");
        figures.push(Figure {
            drawing: over_time::strips(&strips),
            title: format!("Gauges{case}"),
            caption: format!(
                "What the gauges of case {case_id} recorded; probes/columns.csv says where each \
                 stands and how it measures.{empty}{shown}"
            ),
            name,
        });
    }
    Ok(figures)
}

/// Whether any value is larger than the noise of sums over no water.
fn holds_anything(strip: &Strip) -> bool {
    strip.curves.iter().flat_map(|line| &line.points).any(|(_, value)| value.abs() > NAUGHT)
}

/// Gauges by the title of their axis, volumes also by their size, in the order of columns, at most [`CURVES`] per panel. Several
/// panels have a legend each, and colours begin anew in each: six are all that eyes tell apart.
fn strips(case_id: &str, gauges: &[Series]) -> Vec<Strip> {
    let recorded = gauges.iter().filter(|gauge| gauge.points.len() > 1);
    let scales = different(recorded.map(scale));
    let alike = |one: &(String, f64)| {
        let alike: Vec<_> = gauges.iter().filter(|gauge| scale(gauge) == *one).collect();
        let alike = of_a_size(alike).into_iter();
        let panels =
            alike.flat_map(|alike| alike.chunks(CURVES).map(<[_]>::to_vec).collect::<Vec<_>>());
        panels.collect::<Vec<_>>()
    };
    let panels: Vec<_> = scales.iter().flat_map(alike).collect();
    let strip = |of: &Vec<&Series>| {
        let (title, scale) = scale(of[0]);
        let curve = |(index, gauge): (usize, &&Series)| {
            let points = gauge.points.iter().map(|(time, value)| (*time, value * scale));
            Line::new(index, &called(gauge), case_id, points.collect())
        };
        let curves = of.iter().enumerate().map(curve).collect();
        let (name, legend) = (of[0].unit.clone(), panels.len() > 1);
        Strip { title, name, curves, peaks: true, legend, ..Strip::default() }
    };
    panels.iter().map(strip).collect()
}

/// Gauges in groups, of which volumes have a like size. Beside all water of a tank, what goes over a
/// crest would be a flat line.
fn of_a_size(gauges: Vec<&Series>) -> Vec<Vec<&Series>> {
    let mut groups: Vec<([f64; 2], Vec<&Series>)> = Vec::new();
    for gauge in gauges {
        let size = gauge.points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
        // What holds nothing fits everywhere.
        let sizes = if size > NAUGHT { [size; 2] } else { [f64::INFINITY, 0.0] };
        let both = |of: [f64; 2]| [of[0].min(sizes[0]), of[1].max(sizes[1])];
        let fits = |[least, most]: [f64; 2]| gauge.unit != VOLUME || most <= MANY_TIMES * least;
        match groups.iter_mut().find(|(of, _)| fits(both(*of))) {
            Some((of, group)) => {
                *of = both(*of);
                group.push(gauge);
            }
            None => groups.push((sizes, vec![gauge])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// A gauge's name. The program's own columns are in words: the axis tells their unit.
fn called(gauge: &Series) -> String {
    if !CREST_COLUMNS.contains(&gauge.name.as_str()) {
        return gauge.name.clone();
    }
    let heading = heading(&gauge.name);
    heading.split_once(", ").map_or(heading.as_str(), |(words, _)| words).to_owned()
}

/// The title of an axis, and the factor from values to the axis.
pub fn scale(gauge: &Series) -> (String, f64) {
    // A thickness is not a level: it does not start at the bed. It has its own panel.
    if gauge.name == CREST_THICKNESS {
        return (heading(&gauge.name), 1.0);
    }
    if gauge.method.starts_with(OVER_STILL_WATER) {
        return ("surface over still water, m".to_owned(), 1.0);
    }
    match gauge.unit.as_str() {
        "Pa" => ("p, kPa".to_owned(), 1e-3),
        "m" => ("level, m".to_owned(), 1.0),
        "m2" => ("volume, m²".to_owned(), 1.0),
        "m2/s" => ("discharge, m²/s".to_owned(), 1.0),
        "m/s" => ("speed, m/s".to_owned(), 1.0),
        "1" => ("share".to_owned(), 1.0),
        "" => ("value".to_owned(), 1.0),
        other => (other.to_owned(), 1.0),
    }
}

#[cfg(test)]
mod tests;
