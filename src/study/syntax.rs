//! Errors in a file that is not TOML, in plain words.

use crate::scene::{ConfigError, Kind, numerics_keys, scene_keys};

/// The line that is not TOML, and why.
pub(super) fn syntax_error(text: &str, error: &toml::de::Error) -> ConfigError {
    let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
    let line = before.matches('\n').count() + 1;
    let message = error.message().trim().replace('\n', ", ");
    let place = format!("line {line}");
    text.lines()
        .nth(line - 1)
        .and_then(|line| {
            number_with_more(&place, line)
                .or_else(|| number_with_comma(&place, line))
                .or_else(|| key_twice(&place, line, &message))
        })
        .unwrap_or_else(|| ConfigError::new(&place, "", message))
}

/// The two sides of a line, without a comment.
fn key_and_value(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.split_once('=')?;
    Some((name.trim(), value.split('#').next()?.trim()))
}

/// A key that a table has twice. The parser gives only its line.
fn key_twice(place: &str, line: &str, message: &str) -> Option<ConfigError> {
    let (name, _) = key_and_value(line).filter(|_| message == "duplicate key")?;
    Some(ConfigError::new(&format!("{place}: {name}"), "", "stands there twice: duplicate key"))
}

/// A comma within a number, as decimal comma or between thousands.
fn number_with_comma(place: &str, line: &str) -> Option<ConfigError> {
    let (name, value) = key_and_value(line)?;
    let mut parts = value.split(',');
    let is_one = value.contains(',') && parts.all(|part| part.parse::<f64>().is_ok());
    let told = "has a comma: write decimals with a point, as in 0.5, and thousands without a mark";
    is_one.then(|| ConfigError::new(&format!("{place}: {name}"), value, told))
}

/// A number with a unit, which TOML does not allow.
fn number_with_more(place: &str, line: &str) -> Option<ConfigError> {
    let (name, value) = key_and_value(line)?;
    let first = value.trim_matches(['[', ']']).split(',').map(str::trim);
    let key = Kind::ALL.iter().flat_map(|&kind| scene_keys(kind)).chain(numerics_keys());
    let key = key.into_iter().find(|key| key.name == name)?;
    let more = first.filter(|value| value.parse::<f64>().is_err());
    let told = |value: &str| {
        Some(ConfigError::new(&format!("{place}: {name}"), value, key.advice(value)?))
    };
    more.filter_map(told).next()
}
