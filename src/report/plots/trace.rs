//! Draws a curve: its line, its bars, its markers.

use svg::node::element::{Group, Path, Polyline};

use super::chart::{Cell, Curve, Point};
use super::frame::Frame;
use super::labels::place;
use super::look::{DOTS, Look};
use super::pen::{Align, arrow, drawn, group, hex, line, strokes, text, tidy, tooltip};
use super::text::{SMALL, width};

/// The whole curve in a panel.
pub fn series(frame: &Frame, curve: &Curve) -> Group {
    let entry = &curve.entry;
    let class = if entry.spare { "series spare" } else { "series" };
    let mut series = entry.look.group(class).set("data-series", entry.key.as_str());
    if entry.spare {
        series = series.set("hidden", "");
    }
    let seen = |point: &&Point| frame.holds(point.x, point.y);
    let points: Vec<&Point> = curve.points.iter().filter(seen).collect();
    if entry.line {
        let width = if entry.marker.is_some() { 1.5 } else { 1.4 };
        for piece in pieces(frame, &points, entry.look, width) {
            series = series.add(piece);
        }
    }
    if entry.marker.is_some() {
        for point in &points {
            series = series.add(marked(frame, point, entry.look));
        }
    }
    series
}

/// The line in pieces: in the series' dashes between values, dotted to and from bounds.
fn pieces(frame: &Frame, points: &[&Point], look: Look, width: f64) -> Vec<Polyline> {
    let at = |point: &&Point| frame.at(point.x, point.y);
    let piece = |run: &[&Point], class: &str, dash: &str, width: f64| {
        let drawn = line(class, &run.iter().map(at).collect::<Vec<_>>(), width);
        if dash.is_empty() { drawn } else { drawn.set("stroke-dasharray", dash) }
    };
    let sound = points.split(|point| point.bound).filter(|run| run.len() > 1);
    let mut pieces: Vec<_> = sound.map(|run| piece(run, "line", look.dash(), width)).collect();
    let loose = points.windows(2).filter(|pair| pair.iter().any(|point| point.bound));
    let dots =
        loose.map(|pair| piece(pair, "line loose", DOTS, 1.2).set("stroke-linecap", "round"));
    pieces.extend(dots);
    pieces
}

/// A marker with its bar, its arrow and its note.
fn marked(frame: &Frame, point: &Point, look: Look) -> Group {
    let (x, y) = frame.at(point.x, point.y);
    let mut marked = group("point").set("data-case", point.case.as_str());
    if !point.told.is_empty() {
        marked = marked.add(tooltip(&point.told));
    }
    if point.error > 0.0 {
        marked = marked.add(Path::new().set("class", "bar").set("d", bar(frame, point)));
    }
    if point.bound {
        marked = marked.add(arrow((x, y)));
    }
    marked.add(look.marker((x, y), point.open || point.bound))
}

/// The notes beside a panel's points. Those of filled markers come first, as they matter more.
pub fn notes(frame: &Frame, curves: &[Curve]) -> Option<Group> {
    let noted = |curve: &&Curve| curve.entry.marker.is_some();
    let points = curves.iter().filter(noted).flat_map(|curve| &curve.points);
    let mut points: Vec<&Point> = points.filter(|point| !point.note.is_empty()).collect();
    points.sort_by_key(|point| point.open);
    let at = |point: &Point| frame.at(point.x, point.y);
    let words: Vec<_> = points.iter().map(|p| (at(p), width(&p.note, SMALL))).collect();
    let lines = curves.iter().filter(|curve| curve.entry.line).flat_map(|curve| &curve.points);
    let lines: Vec<_> = lines.map(at).collect();
    let mut notes = drawn(group("notes"));
    for (point, placed) in points.iter().zip(place(&words, SMALL, frame.field(), &lines)) {
        let Some(placed) = placed else { continue };
        let lead: Vec<_> = placed.lead.into_iter().collect();
        if !lead.is_empty() {
            notes = notes.add(strokes("lead", &lead, 0.7).set("stroke-opacity", 0.6));
        }
        notes = notes.add(text(placed.middle, &point.note, SMALL, Align::Centre));
    }
    (!words.is_empty()).then_some(notes)
}

/// An error bar with its ends. A bound's bar reaches only down.
fn bar(frame: &Frame, point: &Point) -> String {
    let up = if point.bound { 0.0 } else { point.error };
    let (x, low) = frame.at(point.x, point.y - point.error);
    let (_, high) = frame.at(point.x, point.y + up);
    let (x, low, high) = (tidy(x), tidy(low), tidy(high));
    let foot = format!("M{x} {high}V{low}m-2.5 0h5");
    if point.bound { foot } else { format!("{foot}M{} {high}h5", tidy(x - 2.5)) }
}

/// A field of a map with its number.
pub fn field(frame: &Frame, cell: &Cell) -> Group {
    let (column, row) = (cell.at.0 as f64, cell.at.1 as f64);
    let (left, bottom) = frame.at(column - 0.5, row - 0.5);
    let (right, top) = frame.at(column + 0.5, row + 0.5);
    let square = svg::node::element::Rectangle::new()
        .set("x", tidy(left))
        .set("y", tidy(top))
        .set("width", tidy(right - left))
        .set("height", tidy(bottom - top))
        .set("fill", hex(cell.colour));
    let mut field = group("point field")
        .set("data-case", cell.case.as_str())
        .set("color", on(cell.colour))
        .add(tooltip(&cell.told))
        .add(square);
    if !cell.label.is_empty() {
        let middle = ((left + right) / 2.0, (top + bottom) / 2.0);
        field = field.add(text(middle, &cell.label, SMALL, Align::Centre));
    }
    field
}

/// Black or white, whichever is readable on a colour.
fn on([red, green, blue]: [u8; 3]) -> &'static str {
    let light = |channel: u8| libm::pow(f64::from(channel) / 255.0, 2.2);
    let shine = 0.2126 * light(red) + 0.7152 * light(green) + 0.0722 * light(blue);
    if shine > 0.18 { "#000000" } else { "#ffffff" }
}
