//! The sweep file: a name, a scene, numerics, and a grid.

use std::path::Path;

use toml::{Table, Value};

use super::axis::GridAxis;
use super::limits;
use super::refine::Refine;
use super::syntax::syntax_error;
use super::unknown;

use crate::keys::{Key, Override, Section, read_alone, section};
use crate::scene::{ConfigError, place_of, takes_whole};
use crate::simulation::Limits;

/// A parsed sweep file; the values inside its tables are checked case by case in
/// [`super::Study`].
#[derive(Debug, Clone, PartialEq)]
pub struct SweepFile {
    /// The study's name; also the default output directory's.
    pub name: String,
    /// `[scene]`.
    pub scene: Table,
    /// `[numerics]`.
    pub numerics: Table,
    /// The `[[probe]]` tables.
    pub probes: Vec<Table>,
    /// `[accuracy] max_error_percent`.
    pub max_error_percent: Option<f64>,
    /// `[limits]`.
    pub limits: Limits,
    /// `refine` in `[grid]`.
    pub refine: Option<Refine>,
    /// `[grid]`, in the order of the file; empty for a file that describes a single scene.
    pub grid: Vec<GridAxis>,
    /// The file as written.
    pub text: String,
    /// The command line's values.
    pub sets: Vec<Override>,
}

section! {
    /// `[accuracy]`.
    pub(super) struct Accuracy in "accuracy" {
        /// `--max-error` in the file: the largest error bar that is taken for force and displacement.
        max_error_percent: Option<f64> = None, unit("%").above_zero();
    }
}

/// The keys of `[accuracy]`.
pub fn accuracy_keys() -> Vec<&'static Key> {
    Accuracy::keys()
}

const KEYS: [&str; 7] = ["name", "scene", "numerics", "probe", "accuracy", "limits", "grid"];
/// The key that names another file.
const STROKE: &str = "recorded_stroke";
/// What others call probes.
const GAUGES: [&str; 4] = ["gauge", "gauges", "sensor", "sensors"];
/// Keys in the files of two other commands.
const OF_A_MATRIX: [&str; 2] = ["case", "method"];

impl SweepFile {
    /// The other files that its cases depend on, recorded strokes of a paddle, with the section
    /// that names each.
    fn strokes(&self) -> impl Iterator<Item = (&'static str, &Value)> {
        let swept = self.grid.iter().filter(|axis| axis.key == STROKE);
        let swept = swept.flat_map(|axis| &axis.values).map(|value| ("grid", value));
        self.scene.get(STROKE).map(|value| ("scene", value)).into_iter().chain(swept)
    }

    /// Whether its cases depend on another file.
    pub fn names_stroke(&self) -> bool {
        self.strokes().next().is_some()
    }

    /// The first file of a recorded stroke that is not where its path says, and the section that
    /// names it.
    pub fn missing_stroke(&self) -> Option<(&'static str, &Path)> {
        self.strokes().find_map(|(section, value)| {
            let path = Path::new(value.as_str()?);
            (!path.exists()).then_some((section, path))
        })
    }

    /// Reads a file's text and applies the command line's values.
    ///
    /// # Errors
    /// A syntax error, an unknown top-level key, a missing name, several unknown keys anywhere, a malformed axis, an
    /// empty `[grid]`.
    pub fn read(text: &str, overrides: &[Override]) -> Result<SweepFile, ConfigError> {
        let mut file = text.parse::<Table>().map_err(|error| syntax_error(text, &error))?;
        for set in overrides {
            set.apply(&mut file)?;
        }
        if let Some(key) = OF_A_MATRIX.iter().find(|key| file.contains_key(**key)) {
            let allowed = "is for `seawall accuracy FILE` and `seawall stress FILE`, which take a file of many cases";
            return Err(ConfigError::new(key, "", allowed));
        }
        let others = file.keys().filter(|key| !KEYS.contains(&key.as_str()));
        let unknown = others.map(|key| unknown_at_the_top(key, &file));
        let name = read_name(file.get("name"));
        unknown::refuse(unknown.chain(name.clone().err()).collect(), &file)?;
        let name = name?;
        let mut grid = table(&file, "grid")?;
        let refine = Refine::take(&mut grid)?;
        if file.contains_key("grid") && grid.is_empty() {
            let allowed =
                "holds no key: sweep at least one, or leave [grid] out for a single scene";
            return Err(ConfigError::new("grid", "", allowed));
        }
        let scene = table(&file, "scene")?;
        let axis =
            |(key, value): (&String, &Value)| GridAxis::read(key, value, takes_whole(key, &scene));
        let grid = grid.iter().map(axis).collect::<Result<Vec<_>, _>>()?;
        let accuracy = read_alone::<Accuracy>(&table(&file, Accuracy::NAME)?)?;
        if refine.is_some() {
            Refine::check(&grid)?;
            if let Some(percent) = accuracy.max_error_percent {
                let allowed = "cannot stand beside grid.refine: give one of the two";
                return Err(ConfigError::new("accuracy.max_error_percent", percent, allowed));
            }
        }
        Ok(SweepFile {
            name,
            scene,
            numerics: table(&file, "numerics")?,
            probes: tables(&file, "probe")?,
            max_error_percent: accuracy.max_error_percent,
            limits: limits::read(&table(&file, "limits")?)?,
            refine,
            grid,
            text: text.to_owned(),
            sets: overrides.to_vec(),
        })
    }

    /// Fails if there is nothing to sweep.
    ///
    /// # Errors
    /// An absent `[grid]`.
    pub fn require_grid(&self) -> Result<(), ConfigError> {
        if self.grid.is_empty() {
            let allowed = "is required, with at least one key (`seawall run` takes a single scene)";
            return Err(ConfigError::new("grid", "", allowed));
        }
        Ok(())
    }

    /// Fails if there is more than one scene.
    ///
    /// # Errors
    /// A `[grid]`.
    pub fn refuse_grid(&self) -> Result<(), ConfigError> {
        if let Some(axis) = self.grid.first() {
            let cases: usize = self.grid.iter().map(|axis| axis.values.len()).product();
            let each: Vec<_> = self.grid.iter().map(GridAxis::first).collect();
            let allowed = format!(
                "this file has {cases} cases, and `seawall run` takes one: name it by the values of \
                 the swept keys, as in `seawall run FILE {}`, or run all with `seawall sweep FILE`",
                each.join(" ")
            );
            return Err(ConfigError::new(&format!("grid.{}", axis.key), "", allowed));
        }
        Ok(())
    }
}

/// The error of a key outside its section names the path of the key.
fn unknown_at_the_top(key: &str, file: &Table) -> ConfigError {
    if GAUGES.contains(&key) {
        return ConfigError::new(key, "", "unknown key; did you mean [[probe]]?");
    }
    match table(file, "scene").and_then(|scene| place_of(key, &scene)) {
        Ok(place) => ConfigError::misplaced(key, &format!("{}.{key}", place.name())),
        Err(_) => {
            unknown::meant(key, file).unwrap_or_else(|| ConfigError::unknown_in_table(key, &KEYS))
        }
    }
}

fn read_name(value: Option<&Value>) -> Result<String, ConfigError> {
    let allowed = "must be a word of the letters a to z and A to Z, digits, '-', '_' and '.', not \
                   starting with '.'";
    match value {
        Some(Value::String(name)) => {
            let fits = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
            let wrong = name.chars().find(|&c| !fits(c));
            if name.is_empty() || name.starts_with('.') || wrong.is_some() {
                let wrong = wrong.map(|c| format!("; {c:?} is none of these"));
                let allowed = format!("{allowed}{}", wrong.unwrap_or_default());
                return Err(ConfigError::new("name", format!("{name:?}"), allowed));
            }
            Ok(name.clone())
        }
        Some(other) => Err(ConfigError::new("name", other, allowed)),
        None => Err(ConfigError::new("name", "", format!("is required and {allowed}"))),
    }
}

fn table(file: &Table, key: &str) -> Result<Table, ConfigError> {
    match file.get(key) {
        None => Ok(Table::new()),
        Some(Value::Table(table)) => Ok(table.clone()),
        Some(other) => Err(ConfigError::new(key, other, format!("must be a table: [{key}]"))),
    }
}

fn tables(file: &Table, key: &str) -> Result<Vec<Table>, ConfigError> {
    let wrong = |value: &Value| {
        ConfigError::new(key, value, format!("must be an array of tables: [[{key}]]"))
    };
    match file.get(key) {
        None => Ok(Vec::new()),
        Some(Value::Array(values)) => {
            values.iter().map(|value| value.as_table().cloned().ok_or(wrong(value))).collect()
        }
        Some(other) => Err(wrong(other)),
    }
}

#[cfg(test)]
mod tests;
