//! Figures, one file per family. Each family yields only the figures that the data can fill.
//!
//! A new family is a new file with a function `figures` and one line in [`all`].

mod axes;
mod bar;
mod chart;
mod envelope;
#[cfg(test)]
mod eyes;
mod fixed_wall;
mod frame;
mod history;
mod labels;
mod legend;
mod look;
mod map;
mod marks;
mod over_time;
mod panel;
mod pen;
mod printed;
mod probes;
mod response;
mod sheet;
mod slices;
mod swept;
mod text;
mod ticks;
mod trace;

pub(super) use axes::Axis;
pub(super) use chart::{Chart, Curve, Point, places, points};
pub(super) use fixed_wall::{figures as at_fixed_walls, sides, walls as fixed_walls};
pub(super) use legend::Entry;
pub(super) use look::Look;
pub(super) use marks::{key, point as case_point};
pub(super) use over_time::{Line, Strip, lasting, strips, thinned};
pub(super) use printed::{
    PRINTED, coloured as printed_in_colour, entry as printed_entry, point as printed_point,
};
pub(super) use probes::scale as axis_of_gauge;
pub(super) use sheet::{Drawing, Layout};

use super::error::ReportError;
use super::load::Loaded;
use super::markup::escape;
use super::spoken::all_spoken;
use super::variant::file_name;
#[cfg(feature = "print")]
pub use text::FONT;

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name without its ending. A table of the same name may hold its numbers.
    pub name: String,
    /// Heading in the report.
    pub title: String,
    /// What is drawn, in a sentence or two.
    pub caption: String,
    /// What it shows.
    pub drawing: Drawing,
}

/// The room that a page gives to a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    /// The whole width for three panels, or a third of it for one.
    Usual,
    /// Half of the width for one panel.
    Half,
    /// Half of the width for one panel, and its caption in the other half.
    Alone,
}

/// The most series in a panel, panels of a figure, and figures that differ in other keys than the
/// wave. Nobody can tell more apart.
const SERIES: usize = 6;

/// The caption's words for what each figure is one of.
const COMBINATIONS: &str = "combinations of other keys";

/// The style that a page needs for figures, in light and in dark.
pub const STYLE: &str = include_str!("plots.css");

impl Figure {
    /// The drawing as a file of its own, on white.
    pub fn svg(&self) -> String {
        self.drawing.svg(self.drawing.layout.columns)
    }

    /// Whether it is a single panel, which leaves most of a page's width free.
    pub(super) fn is_single(&self) -> bool {
        self.drawing.shown() == 1
    }

    /// The drawing with its caption for a page that has [`STYLE`].
    pub(super) fn inline(&self, place: Place) -> String {
        // Two panels share the page's width.
        let large = place != Place::Usual || self.drawing.shown() == 2;
        let drawing = self.drawing.inline(&self.title, large);
        let (class, name) =
            (if place == Place::Alone { " class=\"alone\"" } else { "" }, &self.name);
        format!(
            "<figure{class}><div class=\"wide\">{drawing}</div><figcaption>{} \
             <span class=\"file\">figures/{name}.svg</span></figcaption></figure>",
            escape(&self.caption)
        )
    }
}

/// Every figure that the sweep's files can fill.
pub fn all(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let key = swept::key(data);
    let mut figures = match key {
        Some(key) => swept::figures(data, key),
        None => [response::figures(data), slices::figures(data), map::figures(data)].concat(),
    };
    figures.extend(swept::caissons(data, key));
    figures.extend(fixed_wall::figures(data));
    figures.extend(envelope::figures(data)?);
    figures.extend(history::figures(data)?);
    figures.extend(probes::figures(data)?);
    Ok(figures)
}

/// The end of a title that names a variant.
fn of_variant(variant: &str) -> String {
    if variant.is_empty() { String::new() } else { format!(" ({})", all_spoken(variant)) }
}

/// The end of a caption: how many have a figure, if not all do.
fn left_out(all: usize, most: usize, what: &str) -> String {
    if all <= most {
        return String::new();
    }
    format!(" Of {all} {what} {most} have such a figure, spread evenly.")
}

#[cfg(test)]
mod tests;
