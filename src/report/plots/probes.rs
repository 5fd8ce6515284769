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

/// Gauges by the title of their axis, in the order of columns, at most [`CURVES`] per panel. Several
/// panels have a legend each, and colours begin anew in each: six are all that eyes tell apart.
fn strips(case_id: &str, gauges: &[Series]) -> Vec<Strip> {
    let recorded = gauges.iter().filter(|gauge| gauge.points.len() > 1);
    let scales = different(recorded.map(scale));
    let alike = |one: &(String, f64)| {
        let alike: Vec<_> = gauges.iter().filter(|gauge| scale(gauge) == *one).collect();
        alike.chunks(CURVES).map(<[_]>::to_vec).collect::<Vec<_>>()
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
mod tests {
    use super::*;
    use crate::report::fixture;

    #[test]
    fn every_unit_has_a_panel() {
        let data = Loaded::read(fixture::dam_breaks(1).path()).unwrap();
        assert!(figures(&data).unwrap().is_empty(), "the directory is gone");
        let (_directory, data) = fixture::read(fixture::dam_breaks(1));
        let figures = figures(&data).unwrap();
        assert_eq!(figures.len(), 1);
        for word in ["p, kPa", "level, m", "P1", "front"] {
            assert!(figures[0].svg().contains(word), "{word}");
        }
        assert!(!figures[0].caption.contains("Shown"));
    }

    /// The story: a crest that no water passed had four panels of 0, and so had every case.
    #[test]
    fn panels_of_naught_are_left_out() {
        let (_directory, data) = fixture::read(fixture::dam_breaks(1));
        let path = data.directory.join("probes").join(format!("{}.csv", data.rows[0].id()));
        let text = |value: &str| format!("time_s,P1,front\n0,0,0\n0.1,{value},-3e-14\n");
        std::fs::write(&path, text("1e-14")).unwrap();
        assert!(figures(&data).unwrap().is_empty());
        std::fs::write(&path, text("5")).unwrap();
        let figure = figures(&data).unwrap().remove(0);
        assert!(figure.svg().contains("P1") && !figure.svg().contains("front"));
        assert!(figure.caption.contains("nothing but 0 are left out"), "{}", figure.caption);
    }

    #[test]
    fn of_many_cases_a_few_are_shown_and_the_caption_says_so() {
        let directory = fixture::dam_breaks(9);
        let figures = figures(&Loaded::read(directory.path()).unwrap()).unwrap();
        assert_eq!(figures.len(), 4);
        for figure in &figures {
            assert!(figure.caption.contains("Shown are 4 of 9 cases"), "{}", figure.caption);
        }
        assert_eq!(figures[0].title, "Gauges, column height = 0.6 m");
    }

    #[test]
    fn many_gauges_are_split_so_that_colours_differ() {
        let gauge = |index: u32| Series {
            name: format!("P{index}"),
            unit: "Pa".to_owned(),
            method: String::new(),
            points: vec![(0.0, 2e3), (1.0, 1e3)],
        };
        let gauges: Vec<_> = (0..9).map(gauge).collect();
        let strips = strips("a", &gauges);
        assert_eq!(strips.iter().map(|s| s.curves.len()).collect::<Vec<_>>(), [6, 3]);
        assert_eq!(strips[1].curves[0].points[0], (0.0, 2.0));
    }

    /// The story: five gauges with five units were five blue lines without names.
    #[test]
    fn panels_say_whose_they_are() {
        let gauge = |name: &str, unit: &str| Series {
            name: name.to_owned(),
            unit: unit.to_owned(),
            method: String::new(),
            points: vec![(0.0, 1.0), (1.0, 2.0)],
        };
        let gauges = [gauge("P1", "Pa"), gauge("V", "m2"), gauge("P2", "Pa"), gauge("Q", "m2/s")];
        let strips = strips("a", &gauges);
        assert!(strips.iter().all(|strip| strip.legend), "each panel names its own");
        let told = strips.iter().map(|strip| strip.title.as_str());
        assert_eq!(told.collect::<Vec<_>>(), ["p, kPa", "volume, m²", "discharge, m²/s"]);
        let crest = [gauge("G1", "m"), gauge("crest_thickness_m", "m")];
        let told = super::strips("a", &crest).into_iter().map(|strip| strip.title);
        assert_eq!(told.collect::<Vec<_>>(), ["level, m", "crest thickness, m"]);
        // The story: an elevation had the axis of a level, though it does not start at the bed.
        let [level, mut elevation] = [gauge("G1", "m"), gauge("G2", "m")];
        elevation.method = "surface over still water where kernel coverage falls to 1/2".to_owned();
        let told = super::strips("a", &[level, elevation]).into_iter().map(|strip| strip.title);
        assert_eq!(told.collect::<Vec<_>>(), ["level, m", "surface over still water, m"]);
        let looks: Vec<_> =
            strips.iter().flat_map(|strip| &strip.curves).map(|line| line.entry.clone()).collect();
        let own = |index: usize, name: &str| Line::new(index, name, "a", Vec::new()).entry;
        assert_eq!(looks, [own(0, "P1"), own(1, "P2"), own(0, "V"), own(0, "Q")]);
    }

    /// The story: beside a gauge called "qberm" the discharge over a crest had no name, and in the
    /// one legend of all panels eight gauges had the colours of the crest's columns.
    #[test]
    fn a_panel_names_its_own_curves_in_its_own_colours() {
        let gauge = |name: &str, unit: &str| Series {
            name: name.to_owned(),
            unit: unit.to_owned(),
            method: String::new(),
            points: vec![(0.0, 1.0), (1.0, 2.0)],
        };
        let mut gauges: Vec<_> = (1..9).map(|k| gauge(&format!("G{k}"), "m")).collect();
        gauges.extend([gauge("qberm", "m2/s"), gauge("overtopping_discharge_m2_per_s", "m2/s")]);
        gauges.extend([gauge("crest_thickness_m", "m"), gauge("crest_speed_m_per_s", "m/s")]);
        let svg = over_time::strips(&strips("a", &gauges)).svg(3);
        let panels: Vec<_> = svg.split("class=\"panel\"").skip(1).collect();
        let named = [
            ["G1", "G6"],
            ["G7", "G8"],
            ["qberm", "overtopping discharge"],
            ["crest thickness", "hue-0"],
            ["crest speed", "hue-0"],
        ];
        assert_eq!(panels.len(), named.len());
        for (panel, names) in panels.iter().zip(named) {
            for name in names {
                assert!(panel.contains(name), "{name}: {panel}");
            }
            let samples = panel.matches("sample hue-").count();
            let hues = (0..6).filter(|hue| panel.contains(&format!("sample hue-{hue}"))).count();
            assert_eq!(samples, hues, "no colour twice: {panel}");
        }
    }
}
