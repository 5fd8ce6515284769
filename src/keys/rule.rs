//! What a declaration says of a key: its unit, the numbers that it may hold, where it applies.

use toml::{Table, Value};

use super::error::ConfigError;

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
    /// Another key that wins over it where it is given.
    pub unless: Option<&'static str>,
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
        unless: None,
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

    /// Not told where the other key is given, which wins over it; allowed everywhere.
    pub const fn unless(self, key: &'static str) -> Rule {
        Rule { unless: Some(key), ..self }
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

    pub(super) fn check_as(self, key: &str, number: f64, what: &str) -> Result<(), ConfigError> {
        let wrong = || ConfigError::new(key, number, self.allowed(what));
        if self.allows(number) { Ok(()) } else { Err(wrong()) }
    }

    /// What it allows of a type, in words.
    pub(super) fn allowed(self, what: &str) -> String {
        match self {
            Range::Any => format!("must be {what}"),
            Range::AboveZero => "must be a finite number above 0".to_owned(),
            Range::NotNegative => "must be a finite number, 0 or above".to_owned(),
            Range::Within(low, high) => format!("must be {what} from {low} to {high}"),
        }
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
