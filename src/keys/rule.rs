//! The rule in a key's declaration: its unit, its numbers, where it applies.

use toml::{Table, Value};

use super::error::ConfigError;

/// The part of a declaration besides a key's name, type, default and meaning.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// Unit, empty for names, counts and ratios.
    pub unit: &'static str,
    /// Allowed numbers.
    pub range: Range,
    /// The only place where it is allowed.
    pub only: Option<When>,
    /// The only place where it is read. It is allowed elsewhere.
    pub read: Option<When>,
    /// Another key that has precedence if it is given.
    pub unless: Option<&'static str>,
    /// Its value if none is given, in words.
    pub otherwise: Option<&'static str>,
    /// Its name in `seawall check`, if its own is too long.
    pub label: Option<&'static str>,
    /// Whether it must be given wherever it applies.
    pub needed: bool,
    /// Whether a case with the default leaves it out, and so keeps its identity from before the
    /// key.
    pub newer: bool,
}

/// Allowed numbers of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// All, or checked by the section itself.
    Any,
    /// Finite, above 0.
    AboveZero,
    /// Finite, 0 or above.
    NotNegative,
    /// Both ends included.
    Within(f64, f64),
}

/// Another key of the same section, with its values for which a key applies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct When {
    /// The other key.
    pub key: &'static str,
    /// Its values, those of a flag as `true` and `false`.
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

    /// Refused unless the other key has one of these values.
    pub const fn only(self, key: &'static str, values: &'static [&'static str]) -> Rule {
        Rule { only: Some(When { key, values }), ..self }
    }

    /// Read only if the other key has one of these values; allowed everywhere.
    pub const fn read_where(self, key: &'static str, values: &'static [&'static str]) -> Rule {
        Rule { read: Some(When { key, values }), ..self }
    }

    /// Left out if the other key is given, which has precedence; allowed everywhere.
    pub const fn unless(self, key: &'static str) -> Rule {
        Rule { unless: Some(key), ..self }
    }

    /// Must be given where it applies.
    pub const fn needed(self) -> Rule {
        Rule { needed: true, ..self }
    }

    /// The value if none is given, in words.
    pub const fn otherwise(self, words: &'static str) -> Rule {
        Rule { otherwise: Some(words), ..self }
    }

    /// A short name for `seawall check`.
    pub const fn label(self, label: &'static str) -> Rule {
        Rule { label: Some(label), ..self }
    }

    /// For a key that is added after there are results. At its default it changes no case's
    /// identity. No other key may have a condition `only` or `read_where` for this default.
    pub const fn newer(self) -> Rule {
        Rule { newer: true, ..self }
    }
}

impl Range {
    /// Whether it allows a number.
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

    /// The allowed values of a type, in words.
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
    /// Whether it holds for a section with these values.
    pub fn holds(self, values: &Table) -> bool {
        values.get(self.key).is_some_and(|value| self.has(value))
    }

    /// Whether a value of the other key is one of them. That of a flag is compared by its text.
    pub fn has(self, value: &Value) -> bool {
        let flag = value.as_bool().map(|on| FLAGS[usize::from(on)]);
        value.as_str().or(flag).is_some_and(|value| self.values.contains(&value))
    }
}

/// The values of a flag, in files without quotes.
const FLAGS: [&str; 2] = ["false", "true"];

impl std::fmt::Display for When {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let told = |value: &&str| match FLAGS.contains(value) {
            true => (*value).to_owned(),
            false => format!("{value:?}"),
        };
        let values: Vec<_> = self.values.iter().map(told).collect();
        write!(f, "{} = {}", self.key, values.join(" or "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: a key that is read where a flag is on was read nowhere.
    #[test]
    fn a_condition_may_ask_for_a_flag() {
        let on = When { key: "surface_relief", values: &["true"] };
        let holds = |text: &str| on.holds(&text.parse().unwrap());
        assert!(holds("surface_relief = true"));
        assert!(!holds("surface_relief = false") && !holds("") && !holds("surface_relief = 1"));
        assert_eq!(on.to_string(), "surface_relief = true");
        let named = When { key: "wall", values: &["fixed", "movable"] };
        assert!(named.holds(&"wall = \"movable\"".parse().unwrap()));
        assert_eq!(named.to_string(), "wall = \"fixed\" or \"movable\"");
    }
}
