//! Figures, one file per family: each yields the figures that the data can fill, and none else.
//!
//! A new family is a new file with a function `figures` and one line in [`all`].

mod accuracy;
mod axes;
mod fixed_wall;
mod history;
mod legend;
mod over_time;
mod pen;
mod printed;
mod probes;
mod response;
mod sheet;
mod swept;

pub use accuracy::{Dot, error_against_time};
pub(super) use axes::Axis;
pub(super) use fixed_wall::{figures as at_fixed_walls, walls as fixed_walls};
pub(super) use legend::Entry;
pub(super) use over_time::lasting;
pub(super) use pen::Look;
pub(super) use printed::{PRINTED, entry as printed_entry, point as printed_point};
pub(super) use sheet::{Chart, Curve, Layout, Point, sheet};

use super::error::ReportError;
use super::load::Loaded;

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name without its ending; a table of the same name may hold its numbers.
    pub name: String,
    /// Heading in the report.
    pub title: String,
    /// What is drawn, in a sentence or two.
    pub caption: String,
    /// The drawing: a whole SVG document on a transparent ground, in black ink.
    pub svg: String,
}

impl Figure {
    /// The drawing as a file of its own, on white.
    pub fn standalone(&self) -> String {
        let ground = "<rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>\n";
        self.svg.replacen(">\n", &format!(">\n{ground}"), 1)
    }

    /// The drawing for use inside a page: ink takes the page's colour, the inside of open markers
    /// the page's ground.
    pub fn inline(&self) -> String {
        let label = format!("role=\"img\" aria-label=\"{}\"", self.title);
        self.svg
            .replacen("xmlns=\"http://www.w3.org/2000/svg\"", &label, 1)
            .replace("\"#000000\"", "\"currentColor\"")
            .replace("fill=\"#FFFFFF\"", "class=\"ground\"")
    }
}

/// Every figure that the sweep's files can fill.
pub fn all(data: &Loaded) -> Result<Vec<Figure>, ReportError> {
    let mut figures = match swept::key(data) {
        Some(key) => swept::figures(data, key)?,
        None => response::figures(data)?,
    };
    figures.extend(fixed_wall::figures(data)?);
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
                let alone = figure.standalone();
                let tree = roxmltree::Document::parse(&alone).unwrap();
                assert!(tree.descendants().any(|node| node.has_tag_name((SVG, "text"))));
                let page = figure.inline();
                roxmltree::Document::parse(&page).unwrap();
                assert!(!page.contains("http") && !page.contains("#000000"), "{}", figure.name);
            }
        }
    }

    const SVG: &str = "http://www.w3.org/2000/svg";

    #[test]
    fn nothing_leaves_the_sheet() {
        for figure in drawn(&fixture::sweep()) {
            let tree = roxmltree::Document::parse(&figure.svg).unwrap();
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
        let movable = "response-displacement response-force response-runup history-wave-0.3 \
                       history-wave-0.5 ";
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
            assert!(!figure.svg.contains("NaN"), "{}", figure.name);
        }
    }

    #[test]
    fn only_truncated_displacements_have_open_markers() {
        for figure in drawn(&fixture::sweep()) {
            let open = figure.svg.contains("fill=\"#FFFFFF\"");
            assert_eq!(open, figure.name == "response-displacement", "{}", figure.name);
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
