//! How the figures and tables of the papers are made, from `data/paper_figures.toml`.

use std::sync::LazyLock;

use serde::Deserialize;

/// A figure or table of a paper: its content, and how it is made or why it is not.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// `liang2017` or `huang2019`.
    pub paper: String,
    /// Its number; `table-1` for a table.
    pub number: String,
    /// Its content, without a full stop.
    pub shows: String,
    /// The part that is made here, if not all.
    #[serde(default)]
    pub here: String,
    /// Why it is not made; empty if it is.
    #[serde(default)]
    pub why_not: String,
    /// How it is drawn.
    pub draw: Option<Draw>,
    /// The studies that it needs.
    #[serde(default)]
    pub run: Vec<Run>,
}

/// One study.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Its name, and that of its directory.
    pub name: String,
    /// The file, see [`super::files`].
    pub file: String,
    /// Changes of the file, as by `--set`.
    #[serde(default)]
    pub set: Vec<String>,
}

/// A kind of drawing.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Draw {
    /// A column of the summary against the spring's stiffness, one panel per mass.
    Response {
        /// The column.
        column: String,
    },
    /// Columns of the histories over time.
    Histories {
        /// The columns, from the top down.
        columns: Vec<String>,
        /// A level that is drawn as a line, in the panel of the first column.
        line: Option<f64>,
    },
    /// Runup and force at fixed walls against the wave's height.
    Walls,
    /// The force around the largest runup, one panel for some of the waves.
    AroundRunup {
        /// H/h of each panel's waves.
        panels: Vec<Vec<f64>>,
    },
    /// The surface along the tank, one panel per time.
    Surfaces {
        /// Times on the papers' clock, seconds.
        times_s: Vec<f64>,
        /// Whether to draw the first-order solitary wave too.
        #[serde(default)]
        first_order: bool,
    },
    /// Recordings of gauges.
    Gauges {
        /// Their names; one panel each.
        names: Vec<String>,
        /// Whether axes are over √(H/g) and ρgH of the column; otherwise over s and ρgh of the
        /// still water.
        #[serde(default)]
        column: bool,
        /// Whether to draw Buchner's measurements too.
        #[serde(default)]
        measured: bool,
    },
    /// The front of a dam break over time, and Ritter's.
    Front,
    /// Time per step against the number of particles, and over that with improved Shepard.
    StepTime,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    figure: Vec<Recipe>,
}

static ALL: LazyLock<Vec<Recipe>> = LazyLock::new(|| {
    let text = include_str!("../../data/paper_figures.toml");
    toml::from_str::<File>(text).expect("data/paper_figures.toml is tested").figure
});

/// All figures and tables of both papers, in the papers' order.
pub fn recipes() -> &'static [Recipe] {
    &ALL
}

impl Draw {
    /// Whether it shows running times, so that its runs should run one at a time.
    pub fn tells_times(&self) -> bool {
        *self == Draw::StepTime
    }
}

impl Recipe {
    /// Its name: `Fig. 13`, `Table 1`.
    pub fn title(&self) -> String {
        match self.number.strip_prefix("table-") {
            Some(number) => format!("Table {number}"),
            None => format!("Fig. {}", self.number),
        }
    }

    /// The stem of its files: `figure-13`, `table-1`.
    pub fn stem(&self) -> String {
        let figure = self.number.starts_with(|c: char| c.is_ascii_digit());
        if figure { format!("figure-{}", self.number) } else { self.number.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Override;
    use crate::papers::{files, paper};

    #[test]
    fn every_figure_is_made_or_says_why_not() {
        for recipe in recipes() {
            let name = format!("{} {}", recipe.paper, recipe.number);
            assert!(paper(&recipe.paper).is_some(), "{name}");
            assert_eq!(recipe.draw.is_some(), recipe.why_not.is_empty(), "{name}");
            assert_eq!(recipe.draw.is_some(), !recipe.run.is_empty(), "{name}");
            assert!(recipe.why_not.is_empty() || recipe.why_not.ends_with('.'), "{name}");
        }
        let numbers = |paper: &str| {
            let own = recipes().iter().filter(|recipe| recipe.paper == paper);
            own.map(|recipe| recipe.number.as_str()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(numbers("liang2017"), "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 table-1");
        assert_eq!(numbers("huang2019"), "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 table-1");
    }

    #[test]
    fn files_are_there_and_one_name_is_one_study() {
        let runs: Vec<_> =
            recipes().iter().flat_map(|r| r.run.iter().map(|run| (&r.paper, run))).collect();
        for (paper, run) in &runs {
            assert!(files::text(&run.file).is_some(), "{run:?}");
            for set in &run.set {
                set.parse::<Override>().unwrap();
            }
            let same = runs.iter().find(|(p, other)| p == paper && other.name == run.name);
            assert_eq!(same.map(|(_, other)| *other), Some(*run));
        }
    }
}
