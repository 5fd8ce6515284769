//! One key of a file, as it is declared: what it means, what it may hold, where it applies.

use toml::{Table, Value};

use super::error::ConfigError;
use super::shape::Shape;
use super::written;

/// A key of a section of scene and sweep files.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The name in files.
    pub name: &'static str,
    /// What it means, as its doc comment says.
    pub meaning: &'static str,
    /// Unit, range, and where it applies.
    pub rule: Rule,
    /// What its type takes.
    pub shape: fn() -> Shape,
    /// The value that it has where a file gives none.
    pub default: fn() -> Option<Value>,
    /// A file must give it, wherever it applies.
    pub required: bool,
}

impl AsRef<str> for Key {
    fn as_ref(&self) -> &str {
        self.name
    }
}

/// What a declaration says of a key besides its name, type, default and meaning.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// Unit, empty for names, counts and ratios.
    pub unit: &'static str,
    /// Numbers that it may hold.
    pub range: Range,
    /// It is refused elsewhere.
    pub only: Option<When>,
    /// It is read here alone, and may stand elsewhere.
    pub read: Option<When>,
    /// What holds where no value is given, in words.
    pub otherwise: Option<&'static str>,
    /// What `seawall check` calls it, where its name is too long.
    pub label: Option<&'static str>,
    /// It must be given wherever it applies.
    pub needed: bool,
    /// A case at the default does not store it, and so keeps the identity that it had before the key.
    pub newer: bool,
}

/// Numbers that a key may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Every one, or what the section itself checks.
    Any,
    /// Finite, above 0.
    AboveZero,
    /// Finite, 0 or above.
    NotNegative,
    /// Both ends included.
    Within(f64, f64),
}

/// Another key of the same section, and the values of it at which a key applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct When {
    /// The other key.
    pub key: &'static str,
    /// Its values.
    pub values: &'static [&'static str],
}

/// A rule for names, flags and ratios.
pub const fn plain() -> Rule {
    unit("")
}

/// A rule for values of this unit.
pub const fn unit(unit: &'static str) -> Rule {
    Rule {
        unit,
        range: Range::Any,
        only: None,
        read: None,
        otherwise: None,
        label: None,
        needed: false,
        newer: false,
    }
}

impl Rule {
    /// Finite numbers above 0.
    pub const fn above_zero(self) -> Rule {
        Rule { range: Range::AboveZero, ..self }
    }

    /// Finite numbers, 0 or above.
    pub const fn not_negative(self) -> Rule {
        Rule { range: Range::NotNegative, ..self }
    }

    /// Numbers from `low` to `high`.
    pub const fn within(self, low: f64, high: f64) -> Rule {
        Rule { range: Range::Within(low, high), ..self }
    }

    /// Refused but where the other key has one of these values.
    pub const fn only(self, key: &'static str, values: &'static [&'static str]) -> Rule {
        Rule { only: Some(When { key, values }), ..self }
    }

    /// Read but where the other key has one of these values, allowed everywhere.
    pub const fn read_where(self, key: &'static str, values: &'static [&'static str]) -> Rule {
        Rule { read: Some(When { key, values }), ..self }
    }

    /// Must be given where it applies.
    pub const fn needed(self) -> Rule {
        Rule { needed: true, ..self }
    }

    /// What holds where no value is given.
    pub const fn otherwise(self, words: &'static str) -> Rule {
        Rule { otherwise: Some(words), ..self }
    }

    /// A short name for `seawall check`.
    pub const fn label(self, label: &'static str) -> Rule {
        Rule { label: Some(label), ..self }
    }

    /// For a key that is added once there are results: at its default it changes no case's identity.
    /// No other key may be `only` there or `read_where` it has that default.
    pub const fn newer(self) -> Rule {
        Rule { newer: true, ..self }
    }
}

impl Range {
    /// Whether it holds a number.
    pub fn allows(self, number: f64) -> bool {
        match self {
            Range::Any => true,
            Range::AboveZero => number.is_finite() && number > 0.0,
            Range::NotNegative => number.is_finite() && number >= 0.0,
            Range::Within(low, high) => number >= low && number <= high,
        }
    }

    /// Refuses a number outside.
    ///
    /// # Errors
    /// The key, the number, and what is allowed.
    pub fn check(self, key: &str, number: f64) -> Result<(), ConfigError> {
        self.check_as(key, number, "a number")
    }

    fn check_as(self, key: &str, number: f64, what: &str) -> Result<(), ConfigError> {
        let allowed = match self {
            _ if self.allows(number) => return Ok(()),
            Range::Any => return Ok(()),
            Range::AboveZero => "must be a finite number above 0".to_owned(),
            Range::NotNegative => "must be a finite number, 0 or above".to_owned(),
            Range::Within(low, high) => format!("must be {what} from {low} to {high}"),
        };
        Err(ConfigError::new(key, number, allowed))
    }
}

impl When {
    /// Whether a section with these values is such a one.
    pub fn holds(self, values: &Table) -> bool {
        let value = values.get(self.key).and_then(Value::as_str);
        value.is_some_and(|value| self.values.contains(&value))
    }
}

impl std::fmt::Display for When {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let values: Vec<_> = self.values.iter().map(|value| format!("{value:?}")).collect();
        write!(f, "{} = {}", self.key, values.join(" or "))
    }
}

impl Key {
    /// Its unit as the end of its name says it: `_kg_per_m3` for kg/m³.
    pub fn unit_in_name(&self) -> String {
        let plain = self.rule.unit.trim_start_matches('1').to_lowercase().replace('/', "_per_");
        let plain = plain.replace('²', "2").replace('³', "3").replace('°', "deg");
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

    /// What must hold where it is read.
    pub fn conditions(&self) -> impl Iterator<Item = When> + use<> {
        [self.rule.only, self.rule.read].into_iter().flatten()
    }

    /// What it holds where no value is given, in words.
    pub fn default_in_words(&self) -> String {
        match (self.rule.otherwise, (self.default)()) {
            (Some(words), _) => words.to_owned(),
            (None, Some(value)) => value.to_string(),
            (None, None) => {
                if self.required || self.rule.needed { "must be given" } else { "none" }.to_owned()
            }
        }
    }

    /// The error of a value that its type does not take, and what the type says of it.
    pub(super) fn refuse(&self, path: &str, value: &Value, why: &str) -> ConfigError {
        match (self.shape)() {
            Shape::Text if value.is_str() => ConfigError::new(path, value, why),
            Shape::Points if value.is_array() => ConfigError::new(path, value, why),
            Shape::Names(names) => ConfigError::one_of(path, value, names),
            shape => {
                let advice = value.as_str().and_then(|text| self.advice(text));
                ConfigError::new(path, value, advice.unwrap_or_else(|| shape.allowed()))
            }
        }
    }

    /// What to write in place of a text, where this key holds a number and the text begins with one.
    pub fn advice(&self, text: &str) -> Option<String> {
        let is_number = matches!((self.shape)(), Shape::Number | Shape::Whole);
        is_number.then(|| written::advice(text, self.rule.unit)).flatten()
    }

    /// The error of a value that is not there.
    pub(super) fn missing(&self, path: &str) -> ConfigError {
        let needed = |when| format!("is needed where {when}");
        let allowed = self.rule.only.map_or_else(|| "is missing".to_owned(), needed);
        ConfigError::new(path, "", allowed)
    }

    /// Refuses numbers outside its range; whatever else has passed its type.
    pub(super) fn check(&self, path: &str, value: &Value) -> Result<(), ConfigError> {
        let Some(number) = number(value) else { return Ok(()) };
        self.rule.range.check_as(path, number, (self.shape)().what())
    }
}

/// A number, whole or not.
pub fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}
