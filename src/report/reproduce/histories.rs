//! Columns of histories over time. Each column has a row of panels; each factor s has a column.
//! Figs. 4, 7 and 9 to 12 of Liang et al. 2017, Fig. 15 of Huang et al. 2019.

use super::laws::{heading, laws, looks, stands, words};
use super::{Drawn, Material, clock, drawn, is_on_clock};
use crate::papers::{PAPER_CLOCK_CENTRE_S, Printed, printed};
use crate::quantities::history;
use crate::quantities::summary::STROKE_CENTRE;
use crate::report::error::ReportError;
use crate::report::load::Loaded;
use crate::report::papers::{self, Found, on_their_clock};
use crate::report::plots::{
    Axis, Chart, Curve, Entry, Layout, Point, lasting, places, printed_entry, printed_point,
};
use crate::report::row::Row;

/// The papers' clock from which on curves are drawn, seconds.
const FROM_S: f64 = 1.5;

/// The curves and marks of one panel.
struct Panel {
    curves: Vec<Curve>,
    heights: Vec<f64>,
}

pub fn drawing(
    material: &Material,
    columns: &[String],
    line: Option<f64>,
) -> Result<Option<Drawn>, ReportError> {
    // `--set` may have changed the law of the figure's cases.
    let own = material.known().into_iter().find_map(|(.., config)| config.value("threshold_ratio"));
    let line = line.map(|printed| own.unwrap_or(printed));
    let cases = material.cases();
    let rows: Vec<&Row> = cases.iter().map(|(_, row)| *row).collect();
    let words = words(&rows);
    let mut panels = Vec::new();
    for name in columns {
        for law in laws(rows.iter().copied()) {
            panels.push((name, law, strip(material, &cases, &words, name, law)?));
        }
    }
    let times = panels.iter().flat_map(|(.., panel)| places(&panel.curves));
    let Some(x) = Axis::within(times, 6.0) else { return Ok(None) };
    let on_clock = is_on_clock(&rows);
    let clock = clock(on_clock);
    let starred = panels.iter().flat_map(|(.., panel)| &panel.curves).any(is_printed);
    let mut charts = Vec::new();
    let heights = |name: &str| {
        let own = panels.iter().filter(|(other, ..)| *other == name);
        own.flat_map(|(.., panel)| panel.heights.clone()).collect::<Vec<_>>()
    };
    let heights: Vec<_> = panels.iter().map(|(name, ..)| heights(name)).collect();
    for ((name, law, mut strip), heights) in panels.into_iter().zip(heights) {
        if let Some(level) = line.filter(|_| *name == columns[0]) {
            strip.curves.push(Curve::level(format!("threshold, {level}"), level, &strip.curves));
        }
        let unit = history::ALL.iter().find(|column| column.name == *name);
        let Some(y) = Axis::around(heights.into_iter().chain(line), 5.0) else { continue };
        let heading = if *name == columns[0] { heading(law) } else { String::new() };
        let titles = [clock, unit.map_or("", |column| column.unit.axis())];
        let chart = Chart::new((x.clone(), y), titles, ["time_s", name], strip.curves);
        charts.push(chart.under(heading, ""));
    }
    let columns = laws(rows.iter().copied()).len();
    let size = if columns > 1 { (390.0, 210.0) } else { (620.0, 240.0) };
    let layout = Layout { columns, size };
    let when = if on_clock {
        format!(
            " Times are the papers', on which the paddle passes the middle of its stroke at {PAPER_CLOCK_CENTRE_S} s."
        )
    } else {
        String::new()
    };
    let stars = match starred {
        true => {
            " A star stands at its printed time, or where none is printed at that of the computed maximum."
        }
        false => "",
    };
    let caption = format!("Forces are unfiltered; spikes may leave the panel.{when}{stars}");
    Ok(drawn(charts, layout, caption))
}

/// Whether a curve has stars.
fn is_printed(curve: &Curve) -> bool {
    curve.entry.look.is_printed() && !curve.points.is_empty()
}

fn strip(
    material: &Material,
    cases: &[(&Loaded, &Row)],
    words: &[String],
    name: &str,
    law: Option<f64>,
) -> Result<Panel, ReportError> {
    let looks = looks(words);
    let first = laws(cases.iter().map(|(_, row)| *row)).into_iter().next().flatten();
    let mut strip = Panel { curves: Vec::new(), heights: Vec::new() };
    let mut marks: Vec<Curve> = Vec::new();
    for (((data, row), word), look) in cases.iter().zip(words).zip(looks) {
        if !stands(row, law) {
            continue;
        }
        let points = points(data, row, name)?;
        strip.heights.extend(lasting(&points));
        // The same wall has one line in the legend, whatever its column.
        let label = if law == first { word } else { "" };
        let entry = Entry::line(label, look).keyed(format!("case={}", row.id()));
        strip.curves.push(Curve::through(entry, points));
        let own = material.of(row).filter_map(|found| {
            mark(found, name).map(|place| printed_point(place, row, found.printed))
        });
        let own: Vec<Point> = own.collect();
        strip.heights.extend(own.iter().map(|mark| mark.y));
        let entry = Entry::dots("", look.printed(), false).keyed("printed");
        marks.push(Curve { entry, points: own });
    }
    if marks.iter().any(|curve| !curve.points.is_empty()) {
        marks.push(Curve { entry: printed_entry(), points: Vec::new() });
    }
    strip.curves.extend(marks);
    Ok(strip)
}

/// A column of a case's history on the papers' clock, or on its own where no paddle moves.
fn points(data: &Loaded, row: &Row, name: &str) -> Result<Vec<(f64, f64)>, ReportError> {
    let history = data.history(row.id())?;
    let points = history.points(name).iter().copied();
    let Some(centre) = row.number(&STROKE_CENTRE) else { return Ok(points.collect()) };
    let shifted = points.map(|(t, y)| (t - centre + PAPER_CLOCK_CENTRE_S, y));
    Ok(shifted.filter(|point| point.0 >= FROM_S).collect())
}

/// The place of a printed number in a panel.
fn mark(found: &Found, name: &str) -> Option<(f64, f64)> {
    let printed = found.printed;
    if printed.quantity == name {
        return Some((printed.time_s?, printed.value));
    }
    if printed.quantity == "onset_time_s" && name == history::DISPLACEMENT.name {
        return Some((printed.value, 0.0));
    }
    let column = papers::column(printed)?;
    let drawn = column.name.trim_start_matches("first_").strip_suffix("_max")? == name;
    let own = || on_their_clock(found.row, found.row.time(column));
    let time = printed_time(printed).or_else(own).filter(|_| drawn)?;
    Some((time, printed.value))
}

/// The printed time of a maximum.
fn printed_time(maximum: &Printed) -> Option<f64> {
    let name = format!("{}_time_s", maximum.quantity);
    let same = |other: &&Printed| {
        other.quantity == name
            && (&other.paper, &other.figure, &other.scene)
                == (&maximum.paper, &maximum.figure, &maximum.scene)
            && other.wave_height_ratio == maximum.wave_height_ratio
            && other.spring_stiffness_n_per_m == maximum.spring_stiffness_n_per_m
            && other.seawall_mass_kg_per_m == maximum.seawall_mass_kg_per_m
    };
    printed().iter().find(same).map(|other| other.value)
}
