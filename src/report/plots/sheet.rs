//! The layout of all figures: panels side by side and in rows, with a legend above. In a page each
//! panel is its own drawing, and they wrap if the page is narrow.

use svg::node::element::{Group, Rectangle, SVG};

use super::bar::{self, Bar};
use super::chart::Chart;
use super::frame::{Frame, Margins};
use super::legend::{Entry, list, rows};
use super::panel::panel;
use super::pen::{GROUND, INK, bare, tidy};
use super::text::FAMILY;
use crate::math::lists::different;

/// Gaps between panels, and around all of them, CSS pixels.
const GAP: f64 = 14.0;
const EDGE: f64 = 6.0;

/// How many panels stand side by side, and how large each is, CSS pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layout {
    /// Panels in a row, at most.
    pub columns: usize,
    /// Outer width and height of a panel.
    pub size: (f64, f64),
}

/// Three panels in a row of a page; one on a telephone.
pub const PANELS: Layout = Layout { columns: 3, size: (296.0, 226.0) };

/// A lone panel with half of a page's width. Its words keep nine pixels on a telephone.
const LARGE: (f64, f64) = (368.0, 244.0);

/// One of three panels in a row of a journal's page.
const SMALL: (f64, f64) = (214.0, 186.0);

/// Panels and their legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The panels, row by row.
    pub charts: Vec<Chart>,
    /// Their layout in a file.
    pub layout: Layout,
    /// The bar that explains the fields' colours.
    pub bar: Option<Bar>,
}

impl Drawing {
    /// Panels without fields.
    pub fn new(charts: Vec<Chart>, layout: Layout) -> Drawing {
        Drawing { charts, layout, bar: None }
    }

    /// The drawing; `None` without panels.
    pub fn filled(charts: Vec<Chart>, layout: Layout) -> Option<Drawing> {
        (!charts.is_empty()).then(|| Drawing::new(charts, layout))
    }

    /// The drawing on sheets no higher than `tallest` times their width. Each has the legend, and
    /// comes with its width in pixels. Three panels in a row are drawn small, so that words are
    /// large enough on paper.
    pub fn pages(&self, columns: usize, tallest: f64) -> Vec<(String, f64)> {
        let own = self.of_file();
        let columns = columns.min(own.charts.len()).max(1);
        let size = if columns > 2 { SMALL } else { self.layout.size };
        let layout = Layout { size, ..self.layout };
        let (wide, high) = (size.0 + GAP, size.1 + GAP);
        let sheet = 2.0 * EDGE + columns as f64 * wide - GAP;
        let (_, legend) = rows(&own.entries(), EDGE + 6.0, sheet - EDGE);
        let above = legend + if self.bar.is_some() { bar::HEIGHT } else { 0.0 };
        let room = (tallest * sheet - 2.0 * EDGE - above + GAP) / high;
        let page = |charts: &[Chart]| {
            let part = Drawing { charts: charts.to_vec(), layout, ..own.clone() };
            (part.sheet(columns, own.entries()), sheet)
        };
        own.charts.chunks(columns * (room.max(1.0) as usize)).map(page).collect()
    }

    /// The drawing without what only a page shows.
    fn of_file(&self) -> Drawing {
        let mut own = self.clone();
        own.charts.retain(|chart| !chart.spare);
        own.charts.iter_mut().for_each(|chart| chart.curves.retain(|curve| !curve.entry.spare));
        own
    }

    /// The whole drawing as a file, with at most so many panels in a row.
    pub fn svg(&self, columns: usize) -> String {
        let own = self.of_file();
        own.sheet(columns, own.entries())
    }

    fn sheet(&self, columns: usize, entries: Vec<Entry>) -> String {
        let (wide, high) = self.layout.size;
        let columns = columns.min(self.charts.len()).max(1);
        let across = |count: usize| count as f64 * (wide + GAP) - GAP;
        let sheet = 2.0 * EDGE + across(columns);
        let (mut legend, mut top) = rows(&entries, EDGE + 6.0, sheet - EDGE);
        if let Some(bar) = &self.bar {
            legend = legend.add(bar.draw(EDGE + 6.0));
            top += bar::HEIGHT;
        }
        let top = EDGE + top;
        let margins = Margins::of(&self.charts, self.layout.size);
        let mut panels = Group::new();
        for (index, chart) in self.charts.iter().enumerate() {
            let left = EDGE + (wide + GAP) * (index % columns) as f64;
            let above = top + (high + GAP) * (index / columns) as f64;
            let panel = panel(&Frame::new(chart, margins, self.layout.size));
            panels = panels.add(panel.set("transform", format!("translate({left} {above})")));
        }
        let lines = self.charts.len().div_ceil(columns) as f64;
        let size = (sheet, tidy(top + lines * (high + GAP) - GAP + EDGE));
        let ground =
            Rectangle::new().set("width", "100%").set("height", "100%").set("fill", GROUND);
        let legend = legend.set("transform", format!("translate(0 {EDGE})"));
        let sheet = root(size, self.charts.first()).add(ground).add(legend).add(panels);
        format!("{sheet}\n")
    }

    /// How many panels a page shows at first.
    pub fn shown(&self) -> usize {
        self.charts.iter().filter(|chart| !chart.spare).count()
    }

    /// The drawing for a page: a legend and panels, each an SVG. If `large`, each panel has half of
    /// a page's width.
    pub fn inline(&self, label: &str, large: bool) -> String {
        let size = if large { LARGE } else { self.layout.size };
        let margins = Margins::of(&self.charts, size);
        let drawn = |chart: &Chart| {
            let said = format!("{label} {}", chart.heading).replace('"', "'");
            let mut sheet = root(size, Some(chart));
            if chart.spare {
                sheet = sheet.set("class", "spare").set("hidden", "");
            }
            let panel = sheet
                .set("role", "img")
                .set("aria-label", said.trim_end())
                .add(panel(&Frame::new(chart, margins, size)));
            bare(&panel)
        };
        let panels: String = self.charts.iter().map(drawn).collect();
        let entries = self.entries();
        let mut legend = if entries.is_empty() { String::new() } else { list(&entries) };
        if let Some(bar) = &self.bar {
            legend.push_str(&bare(&root((bar.width(), bar::HEIGHT), None).add(bar.draw(2.0))));
        }
        let (wide, count) = (size.0, self.shown());
        format!(
            "<div class=\"plot\" style=\"--panel: {wide}px; --count: {count}\">{legend}\
             <div class=\"panels\">{panels}</div></div>"
        )
    }

    /// The shared legend's entries: every curve with a label, once.
    fn entries(&self) -> Vec<Entry> {
        let share = self.charts.iter().filter(|chart| !chart.legend);
        different(share.flat_map(Chart::entries)).into_iter().cloned().collect()
    }
}

fn root(size: (f64, f64), chart: Option<&Chart>) -> SVG {
    let root = SVG::new()
        .set("width", size.0)
        .set("height", size.1)
        .set("viewBox", (0.0, 0.0, size.0, size.1))
        .set("font-family", FAMILY)
        .set("color", INK);
    let Some(chart) = chart else { return root };
    root.set("data-x", chart.names[0].as_str()).set("data-y", chart.names[1].as_str())
}
