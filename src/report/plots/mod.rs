//! Figures, one file per family: each yields the figures that the data can fill, and none else.
//!
//! A new family is a new file with a function `figures` and one line in [`all`].

mod accuracy;
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
mod shape;
mod sheet;
mod slices;
mod swept;
mod text;
mod ticks;
mod trace;

pub use accuracy::{Dot, error_against_time};
pub(super) use axes::Axis;
pub(super) use chart::{Chart, Curve, Point};
pub(super) use fixed_wall::{figures as at_fixed_walls, walls as fixed_walls};
pub(super) use legend::Entry;
pub(super) use look::Look;
pub(super) use marks::{key, point as case_point};
pub(super) use over_time::lasting;
pub(super) use printed::{PRINTED, entry as printed_entry, point as printed_point};
pub(super) use sheet::{Drawing, Layout};

use super::error::ReportError;
use super::load::Loaded;
use super::markup::escape;
#[cfg(feature = "print")]
pub use text::FONT;

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name without its ending; a table of the same name may hold its numbers.
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

/// Series in a panel, and panels of one figure, at most: more than that nobody tells apart.
const SERIES: usize = 6;

/// What a page needs to show figures, in light and in dark.
pub const STYLE: &str = include_str!("plots.css");

impl Figure {
    /// The drawing as a file of its own, on white.
    pub fn svg(&self) -> String {
        self.drawing.svg(self.drawing.layout.columns)
    }

    /// Whether it is a single panel, which leaves much of a page's width to others.
    pub(super) fn is_single(&self) -> bool {
        self.drawing.shown() == 1
    }

    /// The drawing with its caption for a page that has [`STYLE`].
    pub(super) fn inline(&self, place: Place) -> String {
        let drawing = self.drawing.inline(&self.title, place != Place::Usual);
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
    let mut figures = match swept::key(data) {
        Some(key) => swept::figures(data, key),
        None => [response::figures(data), slices::figures(data), map::figures(data)].concat(),
    };
    figures.extend(fixed_wall::figures(data));
    figures.extend(envelope::figures(data)?);
    figures.extend(history::figures(data)?);
    figures.extend(probes::figures(data)?);
    Ok(figures)
}

/// A name with a variant's own words in it, fit for a file.
pub(super) fn file_name(stem: &str, variant: &str) -> String {
    let mut name = stem.to_owned();
    for word in variant.split(|c: char| !c.is_ascii_alphanumeric() && c != '.') {
        if !word.is_empty() {
            name.push('-');
            name.push_str(&word.to_ascii_lowercase());
        }
    }
    name
}

/// The end of a title that tells a variant.
fn of_variant(variant: &str) -> String {
    if variant.is_empty() { String::new() } else { format!(" ({variant})") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn drawn(directory: &tempfile::TempDir) -> Vec<Figure> {
        all(&Loaded::read(directory.path()).unwrap()).unwrap()
    }

    #[test]
    fn every_figure_is_well_formed_alone_and_inline() {
        for directory in [fixture::sweep(), fixture::fixed()] {
            for figure in drawn(&directory) {
                let alone = figure.svg();
                let tree = roxmltree::Document::parse(&alone).unwrap();
                assert!(tree.descendants().any(|node| node.has_tag_name((SVG, "text"))));
                let page = figure.inline(Place::Usual);
                roxmltree::Document::parse(&page).unwrap();
                assert!(!page.contains("http") && !page.contains("NaN"), "{}", figure.name);
            }
        }
    }

    const SVG: &str = "http://www.w3.org/2000/svg";

    #[test]
    fn nothing_leaves_the_sheet() {
        for figure in drawn(&fixture::sweep()) {
            let alone = figure.svg();
            let tree = roxmltree::Document::parse(&alone).unwrap();
            let sheet = tree.root_element().attribute("viewBox").unwrap();
            let size: Vec<f64> = sheet.split(' ').map(|n| n.parse().unwrap()).collect();
            for line in tree.descendants().filter_map(|node| node.attribute("points")) {
                for pair in line.split_whitespace() {
                    let (x, y) = pair.split_once(',').unwrap();
                    let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                    assert!((0.0..=size[2]).contains(&x) && (0.0..=size[3]).contains(&y));
                }
            }
        }
    }

    #[test]
    fn figures_without_data_are_left_out() {
        let names = |directory: &_| -> String {
            drawn(directory).iter().map(|figure| format!("{} ", figure.name)).collect()
        };
        let movable = "response-displacement response-force response-runup against-stiffness \
                       against-mass against-wave history-wave-0.3 history-wave-0.5 ";
        assert_eq!(names(&fixture::sweep()), movable);
        let fixed = "fixed-wall history-wave-0.1 history-wave-0.2 history-wave-0.3 \
                     history-wave-0.4 history-wave-0.5 history-wave-0.6 ";
        assert_eq!(names(&fixture::fixed()), fixed);
    }

    #[test]
    fn one_wave_one_spring_one_mass_is_enough() {
        let figures = drawn(&fixture::movable(&[0.5], &[500.0], &[250.0]));
        assert_eq!(figures.len(), 4);
        for figure in figures {
            assert!(!figure.svg().contains("NaN"), "{}", figure.name);
        }
    }

    #[test]
    fn bounds_are_open_with_an_arrow_and_only_dots_go_through_them() {
        let mut seen = 0;
        for figure in drawn(&fixture::sweep()) {
            let alone = figure.svg();
            let tree = roxmltree::Document::parse(&alone).unwrap();
            let class = |node: &roxmltree::Node, class: &str| {
                node.attribute("class").is_some_and(|own| own.split(' ').any(|one| one == class))
            };
            for series in tree.descendants().filter(|node| class(node, "series")) {
                let solid = |node: &roxmltree::Node| class(node, "line") && !class(node, "loose");
                let lines: Vec<_> = series.children().filter(solid).collect();
                for point in series.children().filter(|node| class(node, "point")) {
                    let told = point.descendants().find(|node| node.has_tag_name((SVG, "title")));
                    let bound = told.unwrap().text().unwrap().contains('≥');
                    let mark = point.children().find(|node| class(node, "mark")).unwrap();
                    assert_eq!(bound, class(&mark, "open"));
                    assert_eq!(bound, point.children().any(|node| class(&node, "arrow")));
                    let at = mark.attribute("d").unwrap().split('m').next().unwrap();
                    let at = at.trim_start_matches('M').replace(' ', ",");
                    let through = |line: &roxmltree::Node| {
                        line.attribute("points").unwrap().split(' ').any(|corner| corner == at)
                    };
                    assert!(!bound || !lines.iter().any(through), "{at}");
                    seen += usize::from(bound);
                }
            }
        }
        assert!(seen > 3, "{seen}");
    }

    #[test]
    fn points_and_panels_say_what_they_stand_for() {
        let page = drawn(&fixture::sweep())[0].inline(Place::Usual);
        for word in [
            "data-x=\"log10_k_star\" data-y=\"displacement_max\"",
            "data-panel=\"m_star=1.25\"",
            "data-series=\"wave_height_ratio=0.5\"",
            "data-case=\"case-0000\"",
            "<title>H/h = 0.3, k = 10 N/m, m = 50 kg/m: X* max ",
        ] {
            assert!(page.contains(word), "{word}");
        }
    }

    #[test]
    fn a_variant_becomes_part_of_a_file_name() {
        assert_eq!(
            file_name("force", "boundary = mls-linear, dx = 0.01"),
            "force-boundary-mls-linear-dx-0.01"
        );
    }
}
