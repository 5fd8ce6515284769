//! A case in words.

use super::{PLACE, Row, WALL};
use crate::quantities::Column;
use crate::report::number;
use crate::report::spoken::all_spoken;

impl Row {
    /// What tells this case from the sweep's others; empty for a sweep's only case.
    pub fn words(&self) -> String {
        let mut parts = self.place_in_words();
        parts.extend((!self.variant.is_empty()).then(|| all_spoken(&self.variant)));
        // Fixed, with a spring or a caisson: numbers alone do not show which.
        let wall = Some(self.named(WALL)).filter(|wall| !wall.is_empty());
        let wall = wall.map(|wall| format!("{WALL} = {wall}"));
        parts.extend(wall.filter(|wall| !self.variant.contains(wall)));
        parts.join(", ")
    }

    /// Those words, or the case's id where there are none.
    pub fn title(&self) -> String {
        Some(self.words()).filter(|words| !words.is_empty()).unwrap_or_else(|| self.id().to_owned())
    }

    /// Wave, stiffness and mass in words, as far as the case has them.
    pub(in crate::report) fn place_in_words(&self) -> Vec<String> {
        self.words_of(&PLACE[usize::from(self.unasked)..])
    }

    /// Stiffness and mass in words.
    pub(in crate::report) fn wall_in_words(&self) -> Vec<String> {
        self.words_of(&PLACE[1..])
    }

    fn words_of(&self, columns: &[&'static Column]) -> Vec<String> {
        columns.iter().filter_map(|column| Some(label(column, self.number(column)?))).collect()
    }
}

/// A parameter and its value as one writes them: `k = 10 N/m`.
pub(in crate::report) fn label(column: &Column, value: f64) -> String {
    column.with_value("=", &number::minus(&number::as_typed(value)))
}
