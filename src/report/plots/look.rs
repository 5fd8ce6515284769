//! What tells one series from another: hue, shape of the markers and dashes of the line.
//!
//! The hues differ in lightness as well, so that they can be told apart in grey and by the
//! colour-blind; the tests hold them to that.

use svg::node::element::{Group, Path};

use super::pen::{GROUND, INK, drawn, group};
use super::shape::{self, outline};

/// Hues on a white ground. A page has a second set for a dark one, in `plots.css`.
const HUES: [&str; 6] = ["#5360ff", "#943909", "#00492a", "#c60d58", "#079bb3", "#5e0156"];

/// Dashes of lines; the first is solid.
const DASHES: [&str; 6] = ["", "8 3", "4 2", "9 2.5 2 2.5", "15 3", "6 2 1.5 2 1.5 2"];

/// Line through a lower bound: dots, which no series has.
pub const DOTS: &str = "0.8 3.4";

/// The look of one series, the same wherever it appears.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    series: Option<usize>,
}

impl Look {
    /// The look of the `index`-th series. The first 24 differ in hue, shape or dash; the first six in
    /// all three.
    pub fn of(index: usize) -> Look {
        Look { series: Some(index) }
    }

    /// A round marker and a solid line in ink, for what is compared with.
    pub fn plain() -> Look {
        Look { series: None }
    }

    /// A group in this colour; what is in it is drawn in `currentColor`.
    pub fn group(self, class: &str) -> Group {
        let (hue, name) = match self.series {
            Some(index) => (HUES[index % HUES.len()], format!("hue-{}", index % HUES.len())),
            None => (INK, "ink".to_owned()),
        };
        drawn(group(&format!("{class} {name}")).set("color", hue))
    }

    /// The dashes of its line; empty for a solid one.
    pub fn dash(self) -> &'static str {
        self.series.map_or("", |index| DASHES[index % DASHES.len()])
    }

    /// A marker; open ones show the ground inside.
    pub fn marker(self, at: (f64, f64), open: bool) -> Path {
        let shape = self.series.map_or(0, |index| index % shape::COUNT);
        let path = Path::new().set("d", outline(shape, at)).set("stroke-width", 1.3);
        if open {
            return path.set("class", "mark open").set("fill", GROUND);
        }
        path.set("class", "mark").set("fill", "currentColor")
    }
}
