//! What a declaration says of a key, in words for the terminal.

use super::key::Key;
use super::rule::Range;
use super::shape::Shape;

impl Key {
    /// Its meaning in one line.
    pub fn meaning_in_words(&self) -> String {
        self.meaning.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "")
    }

    /// The same as it is declared, and where it means anything.
    pub fn meaning_in_markdown(&self) -> String {
        let mut text = self.meaning.trim().to_owned();
        for when in self.conditions() {
            text += &format!(" Only with `{when}`.");
        }
        text
    }

    /// What it may hold.
    pub fn allowed_in_words(&self) -> String {
        let whole = if (self.shape)() == Shape::Whole { ", whole" } else { "" };
        match ((self.shape)(), self.rule.range) {
            (Shape::Names(names), _) => {
                names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
            }
            (_, Range::AboveZero) => format!("above 0{whole}"),
            (_, Range::NotNegative) => format!("0 or above{whole}"),
            (_, Range::Within(low, high)) => format!("{low} to {high}{whole}"),
            (shape, Range::Any) => shape.what().to_owned(),
        }
    }

    /// Where it applies; empty where it always does.
    pub fn where_in_words(&self) -> String {
        self.conditions().map(|when| when.to_string()).collect::<Vec<_>>().join(", ")
    }
}
