//! A declared key of a file: its meaning, its values, where it applies, also in words.

use toml::{Table, Value};

use super::error::ConfigError;
use super::rule::{Range, Rule, When};
use super::shape::Shape;
use super::written;

/// A key of a section of scene and sweep files.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The name in files.
    pub name: &'static str,
    /// Its meaning, from its doc comment.
    pub meaning: &'static str,
    /// Unit, range, and where it applies.
    pub rule: Rule,
    /// The values of its type.
    pub shape: fn() -> Shape,
    /// Its value if a file gives none.
    pub default: fn() -> Option<Value>,
    /// Whether a file must give it wherever it applies.
    pub required: bool,
}

impl AsRef<str> for Key {
    fn as_ref(&self) -> &str {
        self.name
    }
}

impl Key {
    /// Its unit as in the end of its name: `_kg_per_m3` for kg/m³.
    pub fn unit_in_name(&self) -> String {
        let plain = self.rule.unit.trim_start_matches('1').to_lowercase().replace('/', "_per_");
        let plain = plain.replace(' ', "_").replace('²', "2").replace('³', "3").replace('°', "deg");
        if plain.is_empty() { plain } else { format!("_{}", plain.trim_start_matches('_')) }
    }

    /// A few words for people: its name without underscores and unit.
    pub fn label(&self) -> String {
        let name = self.name.strip_suffix(&self.unit_in_name()).unwrap_or(self.name);
        self.rule.label.map_or_else(|| name.replace('_', " "), str::to_owned)
    }

    /// Whether a section with these values reads it.
    pub fn applies(&self, values: &Table) -> bool {
        self.conditions().all(|when| when.holds(values))
    }

    /// Whether a section with these values has it on: it is read, no other key has precedence, and
    /// it is not off by default.
    pub fn is_on(&self, values: &Table) -> bool {
        let off = |value: &Value| {
            number(value) == Some(0.0)
                || matches!(value.as_str(), Some("none"))
                || *value == false.into()
        };
        let off_by_default = (self.default)().is_none_or(|default| off(&default));
        let value = values.get(self.name);
        let applies =
            self.applies(values) && !self.rule.unless.is_some_and(|key| values.contains_key(key));
        value.is_some_and(|value| applies && !(off_by_default && off(value)))
    }

    /// The conditions under which it is read.
    pub fn conditions(&self) -> impl Iterator<Item = When> + use<> {
        [self.rule.only, self.rule.read].into_iter().flatten()
    }

    /// Its value if none is given, in words.
    pub fn default_in_words(&self) -> String {
        match (self.rule.otherwise, (self.default)()) {
            (Some(words), _) => words.to_owned(),
            (None, Some(value)) => value.to_string(),
            (None, None) => {
                if self.required || self.rule.needed { "must be given" } else { "none" }.to_owned()
            }
        }
    }

    /// Its meaning in one line.
    pub fn meaning_in_words(&self) -> String {
        self.meaning.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "")
    }

    /// The same as declared, and where it applies.
    pub fn meaning_and_place(&self) -> String {
        let mut text = self.meaning.trim().to_owned();
        if let Some(when) = self.rule.only {
            text += &format!(" Only with `{when}`.");
        }
        if let Some(when) = self.rule.read {
            text += &format!(" Read only with `{when}`.");
        }
        text
    }

    /// Its allowed values.
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

    /// Where it is allowed; empty if everywhere.
    pub fn allowed_where(&self) -> String {
        self.rule.only.map(|when| when.to_string()).unwrap_or_default()
    }

    /// Where it is read, if it is not read wherever it is allowed; else empty.
    pub fn read_where(&self) -> String {
        self.rule.read.map(|when| when.to_string()).unwrap_or_default()
    }

    /// The error of a value that its type does not take, with the type's reason.
    pub(super) fn refuse(&self, path: &str, value: &Value, why: &str) -> ConfigError {
        match (self.shape)() {
            Shape::Text if value.is_str() => ConfigError::new(path, value, why),
            Shape::Points if value.is_array() => ConfigError::new(path, value, why),
            Shape::Names(names) => ConfigError::one_of(path, value, names),
            shape => {
                let advice = value.as_str().and_then(|text| self.advice(text));
                let allowed = || self.rule.range.allowed(shape.what());
                ConfigError::new(path, value, advice.unwrap_or_else(allowed))
            }
        }
    }

    /// Advice for a text that begins with a number, if this key has a number.
    pub fn advice(&self, text: &str) -> Option<String> {
        let is_number = matches!((self.shape)(), Shape::Number | Shape::Whole);
        is_number.then(|| written::advice(text, self.rule.unit)).flatten()
    }

    /// The error of a missing value.
    pub(super) fn missing(&self, path: &str) -> ConfigError {
        let needed = |when| format!("is needed where {when}");
        let allowed = self.rule.only.map_or_else(|| "is missing".to_owned(), needed);
        ConfigError::new(path, "", allowed)
    }

    /// Refuses numbers outside its range. Other values have already passed its type.
    pub(super) fn check(&self, path: &str, value: &Value) -> Result<(), ConfigError> {
        let Some(number) = number(value) else { return Ok(()) };
        self.rule.range.check_as(path, number, (self.shape)().what())
    }
}

/// A number, whole or not.
pub fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}
