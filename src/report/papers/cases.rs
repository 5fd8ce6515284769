//! The cases of a study, and those that a printed number belongs to.

use crate::papers::{Printed, scenes};
use crate::report::config::{Config, configs};
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row};

/// The cases of a study with all their values.
#[derive(Debug)]
pub struct Cases<'a> {
    pub(in crate::report) data: &'a Loaded,
    configs: Vec<Option<Config>>,
}

impl<'a> Cases<'a> {
    /// The cases of this study.
    pub fn of(data: &'a Loaded) -> Cases<'a> {
        Cases { data, configs: configs(data) }
    }

    /// Finished cases with their values.
    pub(in crate::report) fn finished(&self) -> impl Iterator<Item = (&'a Row, &Config)> {
        let pairs = self.data.rows.iter().zip(&self.configs);
        pairs
            .filter_map(|(row, config)| Some((row, config.as_ref()?)))
            .filter(|(row, _)| row.is_ok())
    }
}

/// Finished cases with the scene of the papers that each is one of.
pub(super) type OfScene<'a> = Vec<(&'static str, &'a Row, &'a Config)>;

pub(super) fn of_scene<'a>(cases: &'a Cases<'a>) -> OfScene<'a> {
    let scenes = |(row, config): (&'a Row, &'a Config)| {
        scenes(&config.scene).map(move |scene| (scene, row, config))
    };
    cases.finished().flat_map(scenes).collect()
}

/// The cases that a number is printed for.
pub(super) fn printed_for<'a>(number: &Printed, all: &OfScene<'a>) -> Vec<(&'a Row, &'a Config)> {
    let place = |row: &Row| PLACE.map(|column| row.number(column));
    let own =
        all.iter().filter(|(scene, row, _)| *scene == number.scene && number.holds_at(place(row)));
    own.map(|&(_, row, config)| (row, config)).collect()
}
