//! The one layout of all figures: panels side by side and one below the other, legends above them.

use super::axes::{Axis, Panel};
use super::legend::{Entry, Legend};
use super::pen::{Align, Fault, Look, Pen, draw};
use crate::report::error::ReportError;

const LEFT: f64 = 66.0;
const RIGHT: f64 = 16.0;
/// Between panels side by side: with a title of their own, and without.
const GAPS: [f64; 2] = [84.0, 46.0];
/// Above a panel: with a heading, and without.
const HEADS: [f64; 2] = [26.0, 14.0];
/// Below a panel: with the labels of its axis, and without.
const FEET: [f64; 2] = [46.0, 6.0];
/// Room for the words beside the points of the last column.
const NOTES: f64 = 94.0;
const NARROWEST: f64 = 420.0;

/// One point of a curve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Point {
    /// Place on the horizontal axis.
    pub x: f64,
    /// Place on the vertical axis.
    pub y: f64,
    /// Half the length of its error bar.
    pub error: f64,
    /// With an open marker.
    pub open: bool,
    /// What stands beside it.
    pub note: String,
}

impl From<(f64, f64)> for Point {
    fn from((x, y): (f64, f64)) -> Point {
        Point { x, y, ..Point::default() }
    }
}

/// Points that belong together, and how they look.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its words in the legend, if any, and its look.
    pub entry: Entry,
    /// Its points; none where it stands in the legend alone.
    pub points: Vec<Point>,
}

impl Curve {
    /// The lower and upper ends of all points.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        self.points.iter().flat_map(|point| [point.y - point.error, point.y + point.error])
    }
}

/// One panel. Where another stands below it, that one has the labels of the horizontal axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What stands above it; may be empty.
    pub heading: String,
    /// Titles of the horizontal and the vertical axis.
    pub titles: [String; 2],
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, the last on top.
    pub curves: Vec<Curve>,
}

/// How many panels stand side by side, and how large each is, CSS pixels.
#[derive(Debug, Clone, Copy)]
pub struct Layout {
    /// Panels in a row, at most.
    pub columns: usize,
    /// Width and height of a panel.
    pub size: (f64, f64),
}

/// The drawing of panels, row by row. A row has a legend where it differs from the one above.
pub fn sheet(name: &str, charts: &[Chart], layout: Layout) -> Result<String, ReportError> {
    let (width, height) = layout.size;
    let columns = layout.columns.min(charts.len()).max(1);
    let one_title = charts.iter().all(|chart| chart.titles[1] == charts[0].titles[1]);
    let pitch = width + GAPS[usize::from(one_title)];
    let has_notes = points(charts).any(|point| !point.note.is_empty());
    let notes = if has_notes { NOTES } else { 0.0 };
    let right = LEFT + pitch * (columns - 1) as f64 + width + notes;
    let sheet_width = (right + RIGHT).max(NARROWEST);
    let is_last = |index: usize| index + columns >= charts.len();

    let (mut tops, mut legends) = (Vec::new(), Vec::new());
    let (mut bottom, mut said) = (0.0, Vec::new());
    for (row, charts) in charts.chunks(columns).enumerate() {
        let entries = entries(charts);
        if !entries.is_empty() && entries != said {
            let legend = Legend::new(entries.clone(), LEFT, sheet_width - RIGHT);
            bottom += 6.0;
            let top = bottom;
            bottom += legend.height();
            legends.push((legend, top));
        }
        said = entries;
        let is_bare = charts.iter().all(|chart| chart.heading.is_empty());
        let top = bottom + HEADS[usize::from(is_bare)];
        tops.push(top);
        let has_labels = (0..charts.len()).any(|column| is_last(row * columns + column));
        bottom = top + height + FEET[usize::from(!has_labels)];
    }
    draw(name, (sheet_width, bottom + 4.0), |pen| {
        for (legend, top) in &legends {
            legend.draw(pen, *top)?;
        }
        for (index, chart) in charts.iter().enumerate() {
            let column = index % columns;
            let (left, top) = (LEFT + pitch * column as f64, tops[index / columns]);
            let (x, y) = (chart.x.clone(), chart.y.clone());
            let panel = Panel { left, top, width, height, x, y };
            panel.draw(pen, is_last(index))?;
            if is_last(index) {
                panel.title_x(pen, &chart.titles[0])?;
            }
            if column == 0 || !one_title {
                panel.title_y(pen, &chart.titles[1])?;
            }
            panel.heading(pen, &chart.heading)?;
            chart.curves.iter().try_for_each(|curve| draw_curve(pen, &panel, curve))?;
        }
        Ok(())
    })
}

fn points(charts: &[Chart]) -> impl Iterator<Item = &Point> {
    charts.iter().flat_map(|chart| &chart.curves).flat_map(|curve| &curve.points)
}

/// What the legend of a row says: every curve with words, once.
fn entries(charts: &[Chart]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for entry in charts.iter().flat_map(|chart| &chart.curves).map(|curve| &curve.entry) {
        if !entry.label.is_empty() && !entries.contains(entry) {
            entries.push(entry.clone());
        }
    }
    entries
}

fn draw_curve(pen: &Pen, panel: &Panel, curve: &Curve) -> Result<(), Fault> {
    let Entry { look, line, marker, .. } = curve.entry;
    let at = |point: &Point| panel.at(point.x, point.y);
    if line && curve.points.len() > 1 {
        let width = if marker.is_some() { 1.8 } else { 1.5 };
        pen.line(&curve.points.iter().map(at).collect::<Vec<_>>(), look.colour, width)?;
    }
    for point in curve.points.iter().filter(|_| marker.is_some()) {
        if point.error > 0.0 {
            let ends = [-point.error, point.error].map(|error| panel.at(point.x, point.y + error));
            pen.line(&ends, look.colour, 1.2)?;
        }
        pen.marker(at(point), look, point.open)?;
        let (x, y) = at(point);
        pen.text((x + 7.0, y - 6.0), &point.note, 9.5, Align::Left)?;
    }
    Ok(())
}

impl Entry {
    /// A line with filled markers.
    pub fn marked(label: String, look: Look) -> Entry {
        Entry { label, look, line: true, marker: Some(false) }
    }

    /// A line without markers.
    pub fn line(label: String, look: Look) -> Entry {
        Entry { label, look, line: true, marker: None }
    }

    /// Markers without a line, filled or open.
    pub fn dots(label: &str, look: Look, open: bool) -> Entry {
        Entry { label: label.to_owned(), look, line: false, marker: Some(open) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(labels: &[&str]) -> Chart {
        let axis = Axis::around([0.0, 1.0].into_iter(), 5.0).unwrap();
        let curve = |label: &&str| Curve {
            entry: Entry::line((*label).to_owned(), Look::of(0)),
            points: vec![(0.0, 0.0).into(), (1.0, 1.0).into()],
        };
        Chart {
            heading: String::new(),
            titles: ["t, s", "F"].map(str::to_owned),
            x: axis.clone(),
            y: axis,
            curves: labels.iter().map(curve).collect(),
        }
    }

    fn times(word: &str, charts: &[Chart], columns: usize) -> usize {
        let svg = sheet("a", charts, Layout { columns, size: (200.0, 100.0) }).unwrap();
        svg.lines().filter(|line| line.trim() == word).count()
    }

    #[test]
    fn a_legend_is_said_once() {
        let alike = [chart(&["one", "two"]), chart(&["one", "two"])];
        assert_eq!((times("one", &alike, 1), times("one", &alike, 2)), (1, 1));
        let changed = [chart(&["one"]), chart(&["two"]), chart(&["one"])];
        assert_eq!((times("one", &changed, 1), times("two", &changed, 1)), (2, 1));
        assert_eq!(entries(&[chart(&[""])]), []);
    }

    #[test]
    fn only_panels_with_nothing_below_name_their_axis() {
        let five = [0; 5].map(|_| chart(&[]));
        assert_eq!(times("t, s", &five, 1), 1);
        assert_eq!(times("t, s", &five, 3), 3);
        assert_eq!(times("F", &five, 3), 2, "the first of every row");
    }
}
