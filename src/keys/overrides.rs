//! Values set from the command line: `--set numerics.kernel=gaussian`.

use std::str::FromStr;

use toml::{Table, Value};

use super::error::ConfigError;
use crate::math::decimal;

/// One `KEY=VALUE`: a path in the file, and its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    section: Option<String>,
    key: String,
    value: Value,
}

impl FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Override, String> {
        let Some((path, value)) = text.split_once('=') else {
            return Err("must be KEY=VALUE, such as numerics.particle_spacing_m=0.01".to_owned());
        };
        let (section, key) = match path.trim().split_once('.') {
            Some((section, key)) => (Some(section.to_owned()), key.to_owned()),
            None => (None, path.trim().to_owned()),
        };
        if key.is_empty() || key.contains('.') || section.as_deref() == Some("") {
            return Err("the key must be name or SECTION.KEY".to_owned());
        }
        let value = value.trim();
        if has_comment(value) {
            return Err(format!("the value {value} has a # after it, which begins a comment"));
        }
        Ok(Override { section, key, value: read_value(value) })
    }
}

/// Whether TOML would take only a part of a text: what stands before a comment.
fn has_comment(text: &str) -> bool {
    let is_taken = |text: String| text.parse::<Table>().is_ok();
    // A comment hides the bracket.
    let has_mark = text.contains('#') && !text.contains('\n');
    has_mark && is_taken(format!("value = {text}")) && !is_taken(format!("value = [{text}]"))
}

/// The value of a text: a TOML value, a number as in tables, or else a bare string.
pub fn read_value(text: &str) -> Value {
    let parsed = format!("value = {text}").parse::<Table>().ok();
    match parsed {
        Some(mut table) if table.len() == 1 => {
            table.remove("value").unwrap_or_else(|| Value::String(text.to_owned()))
        }
        _ => decimal::read(text).map_or_else(|| Value::String(text.to_owned()), Value::Float),
    }
}

/// A file's text with these settings of the command line; `None` where it cannot be read.
pub fn with_settings(text: &str, sets: &[Override]) -> Option<Table> {
    let mut file = text.parse().ok()?;
    sets.iter().try_for_each(|set| set.apply(&mut file)).ok()?;
    Some(file)
}

impl Override {
    /// The path as written, such as `numerics.boundary`.
    pub fn path(&self) -> String {
        match &self.section {
            Some(section) => format!("{section}.{}", self.key),
            None => self.key.clone(),
        }
    }

    /// The value.
    pub fn value(&self) -> &Value {
        &self.value
    }

    /// Puts the value into a parsed file.
    ///
    /// # Errors
    /// The section is no table, or `[grid]` sweeps the same key. A swept key replaces the single
    /// value in a section of the file.
    pub fn apply(&self, file: &mut Table) -> Result<(), ConfigError> {
        let Some(section) = &self.section else {
            file.insert(self.key.clone(), self.value.clone());
            return Ok(());
        };
        let swept = file.get("grid").and_then(|grid| grid.get(&self.key)).is_some();
        if section != "grid" && swept {
            let allowed = format!("[grid] sweeps this key: set grid.{} instead", self.key);
            return Err(ConfigError::new(&self.path(), &self.value, allowed));
        }
        if section == "grid" {
            let sections = file.iter_mut().filter_map(|(_, section)| section.as_table_mut());
            sections.for_each(|section| drop(section.remove(&self.key)));
        }
        let table = file.entry(section.clone()).or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(table) = table else {
            return Err(ConfigError::new(section, &*table, "must be a table"));
        };
        table.insert(self.key.clone(), self.value.clone());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_toml_or_bare_strings() {
        let value = |text: &str| text.parse::<Override>().unwrap().value;
        assert_eq!(value("numerics.boundary=sfdi"), Value::String("sfdi".into()));
        assert_eq!(value("numerics.courant_number=1e-1"), Value::Float(0.1));
        assert_eq!(value("grid.spring_stiffness_n_per_m=5×10⁴"), Value::Float(5e4));
        assert_eq!(value("name=\"x\""), Value::String("x".into()));
        assert!(value("grid.wave_height_ratio=[0.1, 0.2]").is_array());
        // What is behind a # was left out in silence.
        for bad in ["a.b=0.03#x", "a.b=[1, 2] # two", "name=\"x\"#"] {
            assert!(bad.parse::<Override>().unwrap_err().contains("has a # after it"), "{bad}");
        }
        assert_eq!(value("name=a#b"), Value::String("a#b".into()));
        assert_eq!(value("name=\"a # b\""), Value::String("a # b".into()));
        assert_eq!(value("name=1\nother=2"), Value::String("1\nother=2".into()));
    }

    #[test]
    fn paths_are_checked() {
        for bad in ["name", "=1", ".x=1", "a.b.c=1", "scene.=1"] {
            assert!(bad.parse::<Override>().is_err(), "{bad}");
        }
    }

    #[test]
    fn a_swept_key_is_not_silently_shadowed() {
        let mut file: Table = "[grid]\nwave_height_ratio = [0.1]".parse().unwrap();
        let set: Override = "scene.wave_height_ratio=0.3".parse().unwrap();
        assert!(set.apply(&mut file).is_err());
    }

    #[test]
    fn a_swept_key_takes_the_place_of_a_single_value() {
        let mut file: Table = "[scene]\nwave_height_ratio = 0.3".parse().unwrap();
        let set: Override = "grid.wave_height_ratio=[0.1, 0.2]".parse().unwrap();
        set.apply(&mut file).unwrap();
        assert!(!file["scene"].as_table().unwrap().contains_key("wave_height_ratio"));
        assert_eq!(file["grid"]["wave_height_ratio"].as_array().unwrap().len(), 2);
    }
}
