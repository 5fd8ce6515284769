//! Picking one case of a study: by its id, by the start of it, or by values of swept keys.

use std::str::FromStr;

use super::failure::BadInput;
use crate::keys::{Section, When, hint, number};
use crate::math::lists::different;
use crate::math::words::counted;
use crate::quantities::{meant_by, name_of_symbol};
use crate::scene::{ConfigError, SeawallScene};
use crate::study::{Assignments, Case, Override, Study};

/// A case that may be picked: its id, and the values of the swept keys, none where one means nothing.
#[derive(Debug, Clone)]
pub(super) struct Choice {
    pub(super) id: String,
    pub(super) values: Assignments,
}

/// The only case that fits the words: an id or the start of one, or values of swept keys.
pub(super) fn the_case<'a>(study: &'a Study, words: &[String]) -> Result<&'a Case, BadInput> {
    let choice = |case: &Case| Choice { id: case.id.to_string(), values: case.assignments.clone() };
    let choices: Vec<_> = study.cases.iter().map(choice).collect();
    let fixed = |key: &str| in_every_case(study, key);
    the_one(&study.keys, &fixed, &choices, words).map(|place| &study.cases[place])
}

/// The value of a key that all cases of a study share; `None` if they differ, or none has it.
pub(super) fn in_every_case(study: &Study, key: &str) -> Option<toml::Value> {
    let value = |case: &Case| {
        let scene = toml::Table::try_from(&case.config.scene).ok()?;
        scene.get(key).or(case.config.numerics.table().get(key)).cloned()
    };
    let first = value(study.cases.first()?)?;
    study.cases.iter().all(|case| value(case).as_ref() == Some(&first)).then_some(first)
}

/// The place of the only choice that fits the words. `fixed` tells the value of a key that all of them have.
pub(super) fn the_one(
    keys: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
    choices: &[Choice],
    words: &[String],
) -> Result<usize, BadInput> {
    let mut fitting: Vec<&Choice> = choices.iter().collect();
    for word in words.iter().flat_map(|word| parts(word)) {
        if word.contains('=') {
            keep_with_value(&mut fitting, keys, fixed, word)?;
        } else {
            keep_with_id(&mut fitting, word)?;
        }
    }
    let place = |one: &Choice| choices.iter().position(|choice| choice.id == one.id);
    if let [one] = fitting[..]
        && let Some(place) = place(one)
    {
        return Ok(place);
    }
    let open = (0..keys.len()).filter(|&place| values(&fitting, place).contains(','));
    let open: Vec<_> =
        open.map(|place| format!("{} ({})", keys[place], values(&fitting, place))).collect();
    let cases = counted(fitting.len(), "case");
    let by = if open.is_empty() { "more digits of its id".to_owned() } else { open.join(", ") };
    Err(BadInput(format!("{cases} fit; say which one by {by}")))
}

/// The parts of a word such as `H/h=0.3,k=10`. A part begins behind a comma where a key or an id does:
/// commas of lists, of text in quotes and within numbers divide nothing.
fn parts(word: &str) -> Vec<&str> {
    let (mut parts, mut from, mut depth, mut quoted) = (Vec::new(), 0, 0_i32, false);
    for (at, sign) in word.char_indices() {
        match sign {
            '"' => quoted = !quoted,
            '[' | '{' if !quoted => depth += 1,
            ']' | '}' if !quoted => depth -= 1,
            ',' if !quoted && depth == 0 && begins(&word[from..at], &word[at + 1..]) => {
                parts.push(word[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(word[from..].trim());
    parts
}

/// Whether what follows a comma is another part than what stands before it.
fn begins(before: &str, rest: &str) -> bool {
    let next = rest.split(',').next().unwrap_or_default();
    next.contains('=') || !before.contains('=')
}

fn keep_with_id(fitting: &mut Vec<&Choice>, word: &str) -> Result<(), BadInput> {
    fitting.retain(|choice| choice.id.starts_with(word));
    if fitting.is_empty() {
        let allowed = "no case of this study has an id that starts so; name one by its id, the start \
                       of it, or KEY=VALUE of swept keys";
        return Err(BadInput(format!("{word}: {allowed}")));
    }
    Ok(())
}

fn keep_with_value(
    fitting: &mut Vec<&Choice>,
    keys: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
    word: &str,
) -> Result<(), BadInput> {
    let wanted = Override::from_str(word).map_err(|error| BadInput(format!("{word}: {error}")))?;
    let path = wanted.path();
    let key = path.rsplit('.').next().unwrap_or_default();
    let place = |key: &str| keys.iter().position(|swept| swept == key);
    let Some(place) = place(key).or_else(|| place(name_of_symbol(key)?)) else {
        if let Some(value) = fixed(key).or_else(|| fixed(name_of_symbol(key)?)) {
            let told = || format!("{word}: is {} in every case of this study", in_words(&value));
            return if alike(&value, wanted.value(), FOUR_DIGITS) {
                Ok(())
            } else {
                Err(BadInput(told()))
            };
        }
        if let Some(told) = elsewhere(name_of_symbol(key).unwrap_or(key), keys, fixed) {
            return Err(BadInput(format!("{word}: {told}")));
        }
        let told = ConfigError::unknown(&path, keys).to_string();
        let swept = || format!("; this study sweeps {}", keys.join(", "));
        let help = match keys {
            [_, ..] if hint(key, keys).is_empty() => meant_by(key).unwrap_or_else(swept),
            _ => String::new(),
        };
        return Err(BadInput(told + &help));
    };
    let values = values(fitting, place);
    let fits = |choice: &Choice, share: f64| {
        choice.values[place].as_deref().is_some_and(|value| alike(value, wanted.value(), share))
    };
    let exact = fitting.iter().any(|choice| fits(choice, 0.0));
    fitting.retain(|choice| fits(choice, if exact { 0.0 } else { FOUR_DIGITS }));
    if fitting.is_empty() {
        return Err(BadInput(format!("{word}: no such case; there is {values}")));
    }
    Ok(())
}

/// Why no case of the study has a key of walls or paddles. For example, a spring's key has no
/// meaning at a fixed wall. `None` if there is another reason.
fn elsewhere(
    key: &str,
    swept: &[String],
    fixed: &dyn Fn(&str) -> Option<toml::Value>,
) -> Option<String> {
    // Other kinds of scenes have none of these keys.
    fixed("wall")?;
    let all = SeawallScene::keys();
    let key = all.iter().find(|known| known.name == key)?;
    let told = |when: When| {
        // A case may leave out a key that is at its default.
        let default = || (all.iter().find(|known| known.name == when.key)?.default)();
        let is_swept = swept.iter().any(|key| key == when.key);
        let has = fixed(when.key).or_else(default).filter(|_| !is_swept)?;
        let differs = !when.has(&has);
        differs.then(|| {
            format!("{} belongs to {when}; {} is {has} in every case here", key.name, when.key)
        })
    };
    key.conditions().find_map(told)
}

/// The values of a swept key among some cases, in words.
fn values(cases: &[&Choice], place: usize) -> String {
    let values = cases.iter().filter_map(|case| case.values[place].as_deref());
    different(values.map(in_words)).join(", ")
}

/// A value as people write it: without quotes, and without decimals if it is whole.
fn in_words(value: &toml::Value) -> String {
    match value {
        toml::Value::String(word) => word.clone(),
        toml::Value::Float(number) => number.to_string(),
        other => other.to_string(),
    }
}

/// Four digits of a number: nobody types more.
const FOUR_DIGITS: f64 = 5e-4;

/// Whether settings are equal. Numbers may differ by a share of themselves.
fn alike(value: &toml::Value, wanted: &toml::Value, share: f64) -> bool {
    match (number(value), number(wanted)) {
        (Some(value), Some(wanted)) => (value - wanted).abs() <= share * value.abs(),
        _ => match (value.as_array(), wanted.as_array()) {
            (Some(value), Some(wanted)) => {
                let mut both = value.iter().zip(wanted);
                value.len() == wanted.len() && both.all(|(a, b)| alike(a, b, share))
            }
            _ => value == wanted,
        },
    }
}

#[cfg(test)]
pub(super) mod tests;
