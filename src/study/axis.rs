//! One axis of the grid: a list of values, or a range.

use std::collections::HashSet;

use toml::{Table, Value};

use crate::keys::number;
use crate::math::scale::Scale;
use crate::scene::ConfigError;

/// A swept key and its values, in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct GridAxis {
    /// The key, without its section.
    pub key: String,
    /// Its values: strings, numbers, booleans, or the points of beds.
    pub values: Vec<Value>,
    /// Their scale: that of a range, or else from the values of a list.
    pub scale: Scale,
    /// Whether it only takes whole numbers.
    pub whole: bool,
}

const SHAPE: &str =
    "must be a list, or { from = 1, to = 100, points = 3, spacing = \"log\" or \"linear\" }";

impl GridAxis {
    /// Its first value in the form of the command line: `KEY=VALUE`.
    pub fn first(&self) -> String {
        let word = |value: &Value| match value {
            Value::String(word) => word.clone(),
            other => other.to_string(),
        };
        format!("{}={}", self.key, self.values.first().map(word).unwrap_or_default())
    }

    /// Its values, if they are numbers.
    pub(super) fn numbers(&self) -> Option<Vec<f64>> {
        self.values.iter().map(number).collect()
    }

    /// The place of a value in the order of the axis: its index, or between those of its
    /// neighbours.
    pub(super) fn position(&self, value: &Value) -> f64 {
        let exact = self.values.iter().position(|one| one == value);
        if let Some(place) = exact {
            return place as f64;
        }
        let Some((values, value)) = self.numbers().zip(number(value)) else { return 0.0 };
        let place = |value: f64| self.scale.place(value);
        let between = |pair: &[f64]| (pair[0] < value) != (pair[1] < value);
        let first = values.windows(2).position(between).unwrap_or(0);
        let [low, high] = [values[first], values[first + 1]].map(place);
        first as f64 + (place(value) - low) / (high - low)
    }

    /// The value halfway between two of its numbers, rounded if it only takes whole numbers. `None`
    /// if nothing is left between them.
    pub fn middle(&self, [low, high]: [f64; 2]) -> Option<Value> {
        let [from, to] = [low, high].map(|number| self.scale.place(number));
        let exact = self.scale.value(0.5 * (from + to));
        let middle = if self.whole { exact.round() } else { exact };
        (middle != low && middle != high).then(|| as_value(middle, self.whole))
    }

    /// Reads the value of a key in `[grid]`; `whole` is whether it only takes whole numbers.
    ///
    /// # Errors
    /// An empty list, a value that is neither a scalar nor a list of points, one that is not finite, a
    /// duplicate, a malformed range.
    pub fn read(key: &str, value: &Value, whole: bool) -> Result<GridAxis, ConfigError> {
        let path = format!("grid.{key}");
        let values = match value {
            Value::Array(values) => values.clone(),
            Value::Table(range) => {
                let numbers = read_range(&path, range)?;
                numbers.into_iter().map(|number| as_value(number, whole)).collect()
            }
            other => return Err(ConfigError::new(&path, other, SHAPE)),
        };
        if values.is_empty() {
            return Err(ConfigError::new(&path, "[]", "must have at least one value"));
        }
        let mut seen = HashSet::with_capacity(values.len());
        for value in &values {
            if let Value::Float(number) = value
                && !number.is_finite()
            {
                let number = number.to_string().to_lowercase();
                return Err(ConfigError::new(&path, number, "must be a finite number"));
            }
            if matches!(value, Value::Table(_) | Value::Datetime(_))
                || value.as_array().is_some_and(|points| !points.iter().all(Value::is_array))
            {
                let allowed =
                    "must be numbers, strings or booleans, or beds: lists of points [x, y]";
                return Err(ConfigError::new(&path, value, allowed));
            }
            if !seen.insert(meaning(value)) {
                return Err(ConfigError::new(&path, value, "stands in the list twice"));
            }
        }
        let scale = scale(value, &values);
        Ok(GridAxis { key: key.to_owned(), values, scale, whole })
    }
}

fn scale(written: &Value, values: &[Value]) -> Scale {
    match written.get("spacing").and_then(Value::as_str) {
        Some("log") => Scale::Log,
        _ if written.is_table() => Scale::Linear,
        _ => Scale::of(values.iter().filter_map(number)),
    }
}

/// A number. One without a fraction becomes a whole number if `whole`.
fn as_value(number: f64, whole: bool) -> Value {
    let is_whole = whole && number.fract() == 0.0 && number.abs() < 1e15;
    if is_whole { Value::Integer(number as i64) } else { Value::Float(number) }
}

/// A text that is equal for equal settings: `1` and `1.0` are the same, and 0 and -0.
fn meaning(value: &Value) -> String {
    number(value).map_or_else(|| value.to_string(), |number| format!("{:?}", number + 0.0))
}

pub(super) const RANGE_KEYS: [&str; 4] = ["from", "to", "points", "spacing"];

/// No sweep is larger than this, and no range is longer.
pub(super) const MOST_CASES: usize = 1_000_000;

/// The name here of a range's key that other programs use.
fn meant(key: &str) -> Option<&'static str> {
    match key {
        "start" | "begin" | "min" | "low" => Some("from"),
        "stop" | "end" | "max" | "high" => Some("to"),
        "count" | "num" | "number" | "n" | "steps" => Some("points"),
        "scale" => Some("spacing"),
        _ => None,
    }
}

fn read_range(path: &str, range: &Table) -> Result<Vec<f64>, ConfigError> {
    if let Some(key) = range.keys().find(|key| !RANGE_KEYS.contains(&key.as_str())) {
        let own = format!("{path}.{key}");
        return Err(match meant(key) {
            Some(meant) => ConfigError::misplaced(&own, meant),
            None => ConfigError::unknown_in_table(&own, &RANGE_KEYS),
        });
    }
    let bad = |key: &str, allowed: &str| {
        let shown = range.get(key).map(Value::to_string).unwrap_or_default();
        ConfigError::new(&format!("{path}.{key}"), shown, allowed)
    };
    let bound = |key: &str| {
        let value = range.get(key).and_then(number).filter(|number| number.is_finite());
        value.ok_or_else(|| bad(key, "must be a finite number, without a unit"))
    };
    let (from, to) = (bound("from")?, bound("to")?);
    let points = match range.get("points") {
        Some(Value::Integer(points)) if (2..=MOST_CASES as i64).contains(points) => {
            *points as usize
        }
        _ => {
            let allowed = format!("must be a whole number from 2 to {MOST_CASES}");
            return Err(bad("points", &allowed));
        }
    };
    let log = match range.get("spacing").map(Value::as_str) {
        None | Some(Some("linear")) => false,
        Some(Some("log")) => true,
        _ => return Err(bad("spacing", "must be \"log\" or \"linear\"")),
    };
    if let Some((key, _)) = [("from", from), ("to", to)].iter().find(|(_, end)| log && *end <= 0.0)
    {
        return Err(bad(key, "must be above 0 where spacing = \"log\""));
    }
    let value = |index: usize| {
        if index == 0 {
            return from;
        }
        if index == points - 1 {
            return to;
        }
        let share = index as f64 / (points - 1) as f64;
        if log {
            let (low, high) = (libm::log10(from), libm::log10(to));
            tidy(libm::pow(10.0, low + (high - low) * share))
        } else {
            tidy(from + (to - from) * share)
        }
    };
    Ok((0..points).map(value).collect())
}

/// Rounds so that decades look as if written by hand.
fn tidy(number: f64) -> f64 {
    crate::math::decimal::significant(number, 15)
}

#[cfg(test)]
mod tests;
