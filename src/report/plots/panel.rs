//! Draws one panel: its axes and its content.

use svg::node::element::Group;

use super::frame::{Frame, GAP, STROKE, own_legend};
use super::pen::{Align, drawn, group, line, strokes, text, tidy};
use super::text::{NORMAL, SMALL, width};
use super::trace::{field, notes, series};

/// From a panel's own legend to its frame, CSS pixels.
const LEGEND: f64 = 6.0;

/// Axes, fields and curves.
pub fn panel(frame: &Frame) -> Group {
    let chart = frame.chart;
    let mut panel = group("panel").set("data-panel", chart.key.as_str());
    panel = panel.add(grid(frame));
    for cell in &chart.cells {
        panel = panel.add(field(frame, cell));
    }
    panel = panel.add(axis_x(frame)).add(axis_y(frame));
    for curve in chart.curves.iter().filter(|curve| !curve.points.is_empty()) {
        panel = panel.add(series(frame, curve));
    }
    if let Some(notes) = notes(frame, &chart.curves) {
        panel = panel.add(notes);
    }
    if chart.legend {
        let (legend, height) = own_legend(chart, frame.left + frame.wide);
        let above = tidy(frame.top - height - LEGEND);
        panel = panel.add(legend.set("transform", format!("translate(0 {above})")));
    }
    if chart.heading.is_empty() {
        return panel;
    }
    let middle = heading_at(frame.left, frame.wide, width(&chart.heading, NORMAL));
    let above = (middle, frame.top - 11.0);
    panel.add(text(above, &chart.heading, NORMAL, Align::Centre).set("class", "heading"))
}

/// The middle of a heading: that of the axes, or further left if it would leave the panel.
fn heading_at(left: f64, wide: f64, words: f64) -> f64 {
    (left + wide / 2.0).min(left + wide - words / 2.0).max(words / 2.0)
}

fn grid(frame: &Frame) -> Group {
    let (right, bottom) = (frame.left + frame.wide, frame.top + frame.high);
    let upright = |x: f64| [(x, frame.top), (x, bottom)];
    let level = |y: f64| [(frame.left, y), (right, y)];
    let xs = frame.chart.x.ticks.iter().map(|tick| upright(frame.x(tick.at)));
    let ys = frame.chart.y.ticks.iter().map(|tick| level(frame.y(tick.at)));
    let lines: Vec<_> =
        if frame.chart.cells.is_empty() { xs.chain(ys).collect() } else { Vec::new() };
    drawn(group("grid")).add(strokes("", &lines, 1.0).set("stroke-opacity", 0.13))
}

fn axis_x(frame: &Frame) -> Group {
    let (chart, bottom) = (frame.chart, frame.top + frame.high);
    let mut axis = drawn(group("axis x")).set("data-name", chart.names[0].as_str());
    axis = axis.add(line("", &[(frame.left, bottom), (frame.left + frame.wide, bottom)], 1.0));
    let stroke = |at: f64, long: f64| [(frame.x(at), bottom), (frame.x(at), bottom + long)];
    let long = chart.x.ticks.iter().map(|tick| stroke(tick.at, STROKE));
    let short = chart.x.minor.iter().map(|at| stroke(*at, 0.5 * STROKE));
    axis = axis.add(strokes("strokes", &long.chain(short).collect::<Vec<_>>(), 1.0));
    let below = bottom + STROKE + 4.0 + SMALL / 2.0;
    let mut free = f64::NEG_INFINITY;
    for tick in &chart.x.ticks {
        let (x, half) = (frame.x(tick.at), width(&tick.label, SMALL) / 2.0);
        // Labels that would overlap the one before are left out; their stroke stays.
        if tick.label.is_empty() || x - half < free {
            continue;
        }
        free = x + half + 3.0;
        let label = text((x, below), &tick.label, SMALL, Align::Centre);
        axis = axis.add(label.set("class", "tick"));
    }
    let under = below + SMALL / 2.0 + 6.0 + NORMAL / 2.0;
    let middle = (frame.left + frame.wide / 2.0, under);
    axis.add(text(middle, &chart.titles[0], NORMAL, Align::Centre).set("class", "title"))
}

fn axis_y(frame: &Frame) -> Group {
    let chart = frame.chart;
    let mut axis = drawn(group("axis y")).set("data-name", chart.names[1].as_str());
    axis =
        axis.add(line("", &[(frame.left, frame.top), (frame.left, frame.top + frame.high)], 1.0));
    let stroke = |at: f64, long: f64| [(frame.left, frame.y(at)), (frame.left - long, frame.y(at))];
    let long = chart.y.ticks.iter().map(|tick| stroke(tick.at, STROKE));
    let short = chart.y.minor.iter().map(|at| stroke(*at, 0.5 * STROKE));
    axis = axis.add(strokes("strokes", &long.chain(short).collect::<Vec<_>>(), 1.0));
    for tick in &chart.y.ticks {
        let at = (frame.left - GAP, frame.y(tick.at));
        axis = axis.add(text(at, &tick.label, SMALL, Align::Right).set("class", "tick"));
    }
    let middle = (3.0 + NORMAL / 2.0, frame.top + frame.high / 2.0);
    axis.add(text(middle, &chart.titles[1], NORMAL, Align::Upwards).set("class", "title"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The end of the long name of the crest's discharge was cut off at the edge of the figure.
    #[test]
    fn a_long_heading_stays_in_its_panel() {
        let (left, wide) = (52.0, 143.0);
        let words = width("overtopping_discharge_m2_per_s", NORMAL);
        assert!(words > wide && words < left + wide);
        let middle = heading_at(left, wide, words);
        assert!(middle - words / 2.0 >= 0.0 && middle + words / 2.0 <= left + wide);
        assert_eq!(heading_at(left, wide, 100.0), left + wide / 2.0);
    }
}
