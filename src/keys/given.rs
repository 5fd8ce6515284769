//! Conditions between the keys of a table.

use std::cell::LazyCell;

use toml::Table;

use super::error::ConfigError;
use super::rule::When;
use super::section::{self, Section};

/// Reads a table that stands by itself.
///
/// # Errors
/// The first unknown key, with the nearest known one; the first value that does not fit; the first
/// key that needs another value of another key.
pub fn read_alone<S: Section>(table: &Table) -> Result<S, ConfigError> {
    let known = S::keys();
    if let Some(name) = table.keys().find(|name| known.iter().all(|key| key.name != name.as_str()))
    {
        return Err(ConfigError::unknown_in_table(&format!("{}.{name}", S::NAME), &known));
    }
    let section = S::read(table, None)?;
    check_conditions(table, &section)?;
    Ok(section)
}

/// Checks conditions between keys. `given` has the file's values, `section` all final values.
///
/// # Errors
/// A key that needs another value of another key; a required key that is missing.
pub fn check_conditions<S: Section>(given: &Table, section: &S) -> Result<(), ConfigError> {
    // Usually no condition must be checked, and writing a table takes as long as reading it.
    let complete = LazyCell::new(|| section.table());
    let holds = |when: &When| match given.contains_key(when.key) {
        true => when.holds(given),
        false => when.holds(&complete),
    };
    for key in S::KEYS.iter().chain(S::GROUPS.iter().copied().flatten()) {
        let path = || format!("{}.{}", S::NAME, key.name);
        let missed = key.rule.needed && !given.contains_key(key.name);
        if missed && key.applies(&complete) && !complete.contains_key(key.name) {
            return Err(key.missing(&path()));
        }
        let Some(when) = key.rule.only else { continue };
        let Some(value) = section::given(given, key.name) else { continue };
        if !holds(&when) {
            return Err(ConfigError::new(&path(), value, format!("belongs to {when}")));
        }
    }
    Ok(())
}
