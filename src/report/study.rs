//! What the manifest says of the whole study: its swept keys, and the file that it was made from.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use serde_json::Value as Json;
use toml::{Table, Value};

use super::column::Cells;
use crate::body::Stroke;
use crate::keys::{Override, Section, When, read_value, value_of, with_settings};
use crate::scene::{Place, SeawallScene, place_of};

/// A swept key and its cell in every row of the summary.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Key {
    /// Its name in the sweep's grid.
    pub name: String,
    /// One cell per row.
    pub cells: Cells,
}

impl Key {
    /// A key of this name with these cells.
    pub fn new<S: AsRef<str>>(name: &str, cells: impl IntoIterator<Item = S>) -> Key {
        Key { name: name.to_owned(), cells: cells.into_iter().collect() }
    }
}

/// The keys of the grid, in its order.
pub(super) fn keys(manifest: &Json) -> Vec<String> {
    let keys = manifest.get("keys").and_then(Json::as_array);
    keys.into_iter().flatten().filter_map(|key| key.as_str().map(str::to_owned)).collect()
}

/// The sweep file with the settings of the command line.
#[derive(Debug, Default)]
pub(super) struct StudyFile {
    /// `[scene]`.
    pub scene: Table,
    /// `[numerics]`.
    pub numerics: Table,
    /// `[grid]`.
    pub grid: Table,
    /// `[[probe]]`.
    pub probes: Vec<Table>,
    /// Whether the numerics were chosen case by case.
    pub aims: bool,
    /// The time of the first point in each stroke's file, s, by path. Each file is opened once.
    starts: Mutex<BTreeMap<String, f64>>,
}

impl StudyFile {
    /// Reads it; `None` where the manifest has no file that can be read.
    pub fn of(manifest: Option<&Json>) -> Option<StudyFile> {
        let sets = manifest?.get("overrides").and_then(Json::as_array).into_iter().flatten();
        let sets: Option<Vec<Override>> = sets.map(|set| set.as_str()?.parse().ok()).collect();
        let file = with_settings(manifest?.get("sweep_file")?.as_str()?, &sets?)?;
        let table = |key| file.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let probes = file.get("probe").and_then(Value::as_array).into_iter().flatten();
        Some(StudyFile {
            scene: table("scene"),
            numerics: table("numerics"),
            grid: table("grid"),
            probes: probes.filter_map(Value::as_table).cloned().collect(),
            aims: file.contains_key("accuracy"),
            starts: Mutex::default(),
        })
    }

    /// The kind of the scene, as the file states it.
    pub fn kind(&self) -> Option<&str> {
        self.scene.get("kind")?.as_str()
    }

    /// A paddle at rest on the clock of the stroke in a file.
    pub fn still_stroke(&self, path: &str) -> Option<Value> {
        let mut starts = self.starts.lock().unwrap_or_else(PoisonError::into_inner);
        let read = || Stroke::start_of(path).unwrap_or(0.0);
        let start_s = *starts.entry(path.to_owned()).or_insert_with(read);
        value_of(&[0.0, 1.0, 2.0].map(|later| [start_s + later, 0.0]))
    }

    /// Whether the file gives a key of the scene one value or several.
    pub fn gives(&self, key: &str) -> bool {
        [&self.scene, &self.grid].iter().any(|table| table.contains_key(key))
    }

    /// `[scene]` and `[numerics]` of a row, from these numerics and its swept keys, without keys
    /// that its wall or paddle does not have. `None` where a key is not known.
    pub fn of_row(&self, keys: &[Key], row: usize, numerics: &Table) -> Option<[Table; 2]> {
        let [mut scene, mut numerics] = [&self.scene, numerics].map(Clone::clone);
        for key in keys {
            let table = match place_of(&key.name, &scene).ok()? {
                Place::Scene => &mut scene,
                Place::Numerics => &mut numerics,
            };
            table.remove(&key.name);
            if !key.cells[row].is_empty() {
                table.insert(key.name.clone(), read_value(&key.cells[row]));
            }
        }
        let swept = |when: &When| keys.iter().any(|key| key.name == when.key);
        let values = scene.clone();
        for key in SeawallScene::keys() {
            if !key.conditions().all(|when| !swept(&when) || when.holds(&values)) {
                scene.remove(key.name);
            }
        }
        Some([scene, numerics])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_command_line_wins_over_the_file() {
        let text = "[scene]\nwall_angle_deg = 120\n[numerics]\nwall_angle_deg = 1";
        let read = |overrides: &[&str]| {
            StudyFile::of(Some(&json!({ "sweep_file": text, "overrides": overrides }))).unwrap()
        };
        assert_eq!(read(&[]).scene["wall_angle_deg"].as_integer(), Some(120));
        let twice = read(&["scene.wall_angle_deg=60", "scene.wall_angle_deg=75.5"]);
        assert_eq!(twice.scene["wall_angle_deg"].as_float(), Some(75.5));
        let others = read(&["numerics.boundary=sfdi", "accuracy.max_error_percent=2"]);
        assert_eq!(others.numerics["boundary"].as_str(), Some("sfdi"));
        assert!(others.aims && !twice.aims);
        assert!(StudyFile::of(Some(&json!({}))).is_none());
    }
}
