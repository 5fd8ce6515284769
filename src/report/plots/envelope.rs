//! The largest pressures up the wall, for a few cases.

use super::axes::Axis;
use super::chart::{Chart, Curve, places, points};
use super::legend::Entry;
use super::look::Look;
use super::marks::shown_are;
use super::sheet::{Drawing, PANELS};
use super::{Figure, SERIES};
use crate::quantities::envelope::{FIRST_PRESSURE_MAX, HEIGHT, PRESSURE_MAX};
use crate::quantities::summary::{FIRST_FORCE_MAX, WAVE_HEIGHT_RATIO};
use crate::report::curves::{distinct, spread};
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::newtons::scales;
use crate::report::row::Row;
use crate::report::series::Pressed;

/// A case and its envelope.
type Case<'a> = (&'a Row, Vec<Pressed>);

/// The figure; empty where no case has an envelope.
pub fn figures(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut cases: Vec<Case<'_>> = Vec::new();
    let scales = scales(data);
    for row in chosen(data, scales.as_deref()) {
        let envelope = data.envelope(row.id())?;
        if envelope.len() > 1 {
            cases.push((row, envelope));
        }
    }
    if cases.is_empty() {
        return Ok(Vec::new());
    }
    let force = if scales.is_some() { "force in newtons" } else { "F*" };
    let which = match distinct(data.finished(), &WAVE_HEIGHT_RATIO).len() {
        0 | 1 => format!("from the largest {force} to the least"),
        _ => format!("for each wave the one of the largest {force}"),
    };
    let shown = match data.finished().count() {
        all if all > cases.len() => format!(
            " {} of {all} cases, {which}; all are in tables/pressure_envelope.csv.",
            shown_are(cases.len())
        ),
        _ => String::new(),
    };
    let has_first = |at: &Pressed| at.first_pressure_max_pa.is_some();
    let parts = match cases.iter().any(|(_, envelope)| envelope.iter().any(has_first)) {
        true => "of the first impact and of the whole run, each when it was",
        false => "of the whole run, when it was",
    };
    let stops = match cases.iter().any(|(row, _)| row.hits_stop()) {
        true => "; the moments after the wall hit its stop are left out",
        false => "",
    };
    Ok(vec![Figure {
        name: "pressure-envelope".to_owned(),
        title: "Largest pressure up the wall".to_owned(),
        caption: format!(
            "The largest pressure at each height of the wall, {parts} largest there. They are running \
             means{stops}.{shown}"
        ),
        drawing: drawing(&cases),
    }])
}

/// For each of several waves, the case of the largest force. For a single wave, some cases from the
/// largest to the least force. Pressures are in kPa: where cases have F* over different units,
/// `scales` has those, and the force in newtons counts.
fn chosen<'a>(data: &'a Loaded, scales: Option<&[f64]>) -> Vec<&'a Row> {
    let force = |(place, row): &(usize, &Row)| {
        let force = row.number(row.impact(&FIRST_FORCE_MAX)).unwrap_or(0.0);
        scales.map_or(force, |scales| force * scales[*place])
    };
    let mut placed: Vec<_> = data.placed().collect();
    placed.sort_by(|a, b| force(b).total_cmp(&force(a)));
    let mut rows: Vec<_> = placed.into_iter().map(|(_, row)| row).collect();
    let waves = distinct(rows.iter().copied(), &WAVE_HEIGHT_RATIO);
    if waves.len() > 1 {
        let of = |wave: &f64| {
            rows.iter().copied().find(|row| row.number(&WAVE_HEIGHT_RATIO) == Some(*wave))
        };
        rows = waves.iter().filter_map(of).collect();
    }
    spread(&rows, SERIES)
}

fn drawing(cases: &[Case<'_>]) -> Drawing {
    let chart = |first: bool| {
        let curve = |(index, (row, envelope)): (usize, &Case<'_>)| {
            let words = if row.words().is_empty() { "pressure".to_owned() } else { row.words() };
            let pressure = |at: &Pressed| {
                if first { at.first_pressure_max_pa } else { Some(at.pressure_max_pa) }
            };
            let points = envelope.iter().filter_map(|at| Some((1e-3 * pressure(at)?, at.height_m)));
            let key = format!("case={}", row.id());
            let entry = Entry::line(words, Look::of(index)).keyed(key);
            Curve::through(entry, points)
        };
        let curves: Vec<_> = cases.iter().enumerate().map(curve).collect();
        let x = Axis::around(places(&curves).chain([0.0]), 4.0)?;
        let y = Axis::around(points(&curves).map(|point| point.y).chain([0.0]), 5.0)?;
        points(&curves).next()?;
        let (heading, name) = match first {
            true => ("first impact", FIRST_PRESSURE_MAX.name),
            false => ("whole run", PRESSURE_MAX.name),
        };
        let titles = ["p, kPa", "height, m"];
        Some(Chart::new((x, y), titles, [name, HEIGHT.name], curves).under(heading, ""))
    };
    Drawing::new([true, false].into_iter().filter_map(chart).collect(), PANELS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::STOPS;
    use crate::report::fixture;
    use crate::report::study::Key;

    /// The story: of a sweep over depths the figure had the shallowest water, whose F* is largest
    /// and whose pressures are the least.
    #[test]
    fn where_depths_differ_newtons_choose_the_case() {
        let (_directory, mut data) =
            fixture::read(fixture::movable(&[0.5], &[500.0, 600.0], &[250.0]));
        let text = "[scene]\nwall = \"movable\"\n[grid]";
        data = data.made_from(text, &[]);
        let keys = [("spring_stiffness_n_per_m", "500"), ("seawall_mass_kg_per_m", "250")];
        data.keys = keys.map(|(name, cell)| Key::new(name, [cell, cell])).into();
        for (row, force) in data.rows.iter_mut().zip([2.2, 2.0]) {
            row.set(&FIRST_FORCE_MAX, force);
        }
        let first = |data: &Loaded| chosen(data, scales(data).as_deref())[0].id().to_owned();
        assert_eq!(first(&data), "case-0000");
        data.keys.push(Key::new("still_water_depth_m", ["0.2", "0.4"]));
        assert_eq!(first(&data), "case-0001");
    }

    #[test]
    fn envelopes_are_drawn_where_there_are_files_of_them() {
        let (directory, mut data) = fixture::read(fixture::sweep());
        assert!(figures(&data).unwrap().is_empty());
        let folder = directory.path().join("envelopes");
        std::fs::create_dir(&folder).unwrap();
        let rows = "height_m,pressure_max_pa,first_pressure_max_pa\n0.004,3000,2900\n0.1,1500,\n";
        for row in data.finished() {
            std::fs::write(folder.join(format!("{}.csv", row.id())), rows).unwrap();
        }
        let figure = figures(&data).unwrap().remove(0);
        let shown = "Shown are 2 of 11 cases, for each wave the one of the largest F*;";
        assert!(figure.caption.contains(shown), "{}", figure.caption);
        assert!(figure.caption.contains("of the first impact and of the whole run"));
        let svg = figure.svg();
        for word in ["p, kPa", "height, m", "first impact", "whole run"] {
            assert!(svg.contains(word), "{word}");
        }
        // Fixed walls were said to have a stop.
        for (stops, told) in [(0, false), (1, true)] {
            data.set_all(&STOPS, stops);
            let caption = figures(&data).unwrap().remove(0).caption;
            assert_eq!(caption.contains("after the wall hit its stop"), told, "{caption}");
        }
        let mut tables = crate::report::tables::all(&data).into_iter();
        let table = tables.find(|table| table.head.name == "pressure_envelope").unwrap();
        let table = table.whole().unwrap();
        assert_eq!(table.rows.len(), 2 * 11);
        assert_eq!(table.rows[1][2..], ["0.1", "1500", ""]);
        // Without a first impact there is one panel, and the caption names no other.
        for row in data.finished() {
            let rows = rows.replace("2900", "");
            std::fs::write(folder.join(format!("{}.csv", row.id())), rows).unwrap();
        }
        let figure = figures(&data).unwrap().remove(0);
        assert!(figure.is_single() && !figure.caption.contains("first"), "{}", figure.caption);
    }
}
