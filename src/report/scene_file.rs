//! One row of a study as a scene file that `seawall run` takes.

use std::collections::HashMap;
use std::path::Path;

use toml::{Table, Value};

use super::load::Loaded;
use super::study::{Key, StudyFile};
use crate::disk::names::MAX_ERROR;
use crate::keys::read_value;
use crate::scene::{CaseConfig, Place, place_of};

/// The study's file, of which each row is one case.
#[derive(Debug, Clone)]
pub struct SceneFile {
    name: String,
    file: StudyFile,
    /// Numerics that were chosen case by case, by the case's id.
    chosen: Option<HashMap<String, Table>>,
}

impl SceneFile {
    /// Reads the study's file from the manifest. `None` where there is none, or a swept key is not
    /// known. Numerics that were chosen case by case come from `max_error.csv`.
    pub fn of(data: &Loaded) -> Option<SceneFile> {
        let file = data.file()?;
        let chosen = chosen(&data.directory.join(MAX_ERROR));
        let chosen = chosen.or_else(|| file.aims.then(HashMap::new));
        let known = data.keys.iter().all(|key| place_of(&key.name, &file.scene).is_ok());
        let name = data.name().unwrap_or("case").to_owned();
        known.then_some(SceneFile { name, file, chosen })
    }

    /// The kind of the scene, as the file states it.
    pub fn kind(&self) -> Option<&str> {
        self.file.scene.get("kind")?.as_str()
    }

    /// Whether each case reads the file of a stroke.
    pub fn reads_strokes(&self) -> bool {
        self.file.scene.contains_key("recorded_stroke")
    }

    /// The case of a row; `None` where it is not valid, or its chosen numerics are not known.
    pub fn config(&self, data: &Loaded, row: usize) -> Option<CaseConfig> {
        let [scene, numerics] = self.tables(data, row)?;
        CaseConfig::with_probes(&scene, &numerics, &self.file.probes).ok()
    }

    /// The file of a row, with `{id}` in place of the case's id. Each swept key's name in braces
    /// stands in place of its value. Rows with equal texts share one. `None` if the row's chosen
    /// numerics are not known.
    pub fn template(&self, data: &Loaded, row: usize) -> Option<String> {
        let [mut scene, mut numerics] = self.tables(data, row)?;
        for Key { name, .. } in data.keys.iter().filter(|key| !key.cells[row].is_empty()) {
            let table = match place_of(name, &self.file.scene).ok()? {
                Place::Scene => &mut scene,
                Place::Numerics => &mut numerics,
            };
            table.insert(name.clone(), Value::String(format!("{{{name}}}")));
        }
        let name = &self.name;
        let mut text = format!("# Case {{id}} of the study {name}.\nname = \"{name}-{{id}}\"\n");
        for (title, table) in [("[scene]", &scene), ("[numerics]", &numerics)] {
            if !table.is_empty() {
                text.push_str(&format!("\n{title}\n{table}"));
            }
        }
        for probe in &self.file.probes {
            text.push_str(&format!("\n[[probe]]\n{probe}"));
        }
        Some(data.keys.iter().fold(text, |text, Key { name, .. }| {
            text.replace(&format!("\"{{{name}}}\""), &format!("{{{name}}}"))
        }))
    }

    fn tables(&self, data: &Loaded, row: usize) -> Option<[Table; 2]> {
        let numerics = match &self.chosen {
            Some(chosen) => chosen.get(data.rows[row].id())?,
            None => &self.file.numerics,
        };
        self.file.of_row(&data.keys, row, numerics)
    }
}

/// The numerics of each case in `max_error.csv`; `None` where there is no such file.
fn chosen(path: &Path) -> Option<HashMap<String, Table>> {
    let mut reader = csv::Reader::from_path(path).ok()?;
    let of = reader.headers().ok()?.iter().position(|name| name == "numerics")?;
    let rows = reader.records().map_while(Result::ok);
    let numerics = |list: &str| -> Option<Table> {
        let pair = |pair: &str| {
            let (key, value) = pair.split_once(" = ")?;
            Some((key.to_owned(), read_value(value)))
        };
        list.split(", ").filter(|pair| !pair.is_empty()).map(pair).collect()
    };
    Some(rows.filter_map(|row| Some((row.get(0)?.to_owned(), numerics(row.get(of)?)?))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::CASE_ID;
    use crate::report::row::Row;
    use serde_json::json;

    /// A study of these keys and cells, one row.
    fn study(text: &str, overrides: &[&str], keys: &[(&str, &str)]) -> Loaded {
        Loaded {
            manifest: Some(json!({ "name": "a", "sweep_file": text, "overrides": overrides })),
            keys: keys.iter().map(|(name, cell)| Key::new(name, [cell])).collect(),
            rows: vec![Row::default().with(&CASE_ID, "0123")],
            ..Loaded::default()
        }
    }

    /// The text of the row as a page completes it.
    fn filled(data: &Loaded) -> String {
        let file = SceneFile::of(data).unwrap();
        let text = file.template(data, 0).unwrap().replace("{id}", "0123");
        let text = data.keys.iter().fold(text, |text, key| {
            text.replace(&format!("{{{}}}", key.name), &read_value(&key.cells[0]).to_string())
        });
        let read: Table = text.parse().unwrap();
        let table =
            |key: &str| read.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let config = CaseConfig::from_tables(&table("scene"), &table("numerics")).unwrap();
        assert_eq!(file.config(data, 0), Some(config), "{text}");
        text
    }

    const TEXT: &str = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
        [grid]\nboundary = [\"sfdi\"]\nspring_stiffness_n_per_m = [10, 21544.3469003188]";

    #[test]
    fn a_row_is_its_file_with_the_swept_values_in_their_sections() {
        let cells = [("boundary", "sfdi"), ("spring_stiffness_n_per_m", "21544.3469003188")];
        let text = filled(&study(TEXT, &["numerics.particle_spacing_m=0.02"], &cells));
        assert_eq!(
            text,
            "# Case 0123 of the study a.\nname = \"a-0123\"\n\n[scene]\nwall = \"movable\"\n\
             seawall_mass_kg_per_m = 50\nspring_stiffness_n_per_m = 21544.3469003188\n\n\
             [numerics]\nparticle_spacing_m = 0.02\nboundary = \"sfdi\"\n"
        );
    }

    #[test]
    fn a_wall_of_several_has_its_own_keys_alone() {
        let cells = [("wall", "fixed"), ("spring_stiffness_n_per_m", "")];
        let text = filled(&study(TEXT, &[], &cells));
        assert!(!text.contains("mass") && text.contains("wall = \"fixed\""), "{text}");
    }

    #[test]
    fn numerics_that_were_chosen_case_by_case_are_those_of_max_error() {
        let with = format!("{TEXT}\n[accuracy]\nmax_error_percent = 2");
        let cells = [("boundary", "sfdi"), ("spring_stiffness_n_per_m", "10")];
        let mut data = study(&with, &["numerics.particle_spacing_m=0.02"], &cells);
        assert!(SceneFile::of(&data).unwrap().template(&data, 0).is_none());
        let root = tempfile::tempdir().unwrap();
        let rows = "case_id,particle_spacing_m,numerics,met\n\
            0123,0.0125,\"particle_spacing_m = 0.0125, boundary = sfdi, sound_speed_ratio = 12.0\",true\n";
        std::fs::write(root.path().join("max_error.csv"), rows).unwrap();
        data.directory = root.path().to_owned();
        let text = filled(&data);
        assert!(
            text.contains("particle_spacing_m = 0.0125")
                && text.contains("sound_speed_ratio = 12.0"),
            "{text}"
        );
        assert!(text.contains("boundary = \"sfdi\""), "{text}");
        data.rows = vec![Row::default().with(&CASE_ID, "4567")];
        assert!(SceneFile::of(&data).unwrap().config(&data, 0).is_none());
    }

    #[test]
    fn a_study_without_file_or_with_unknown_keys_has_none() {
        assert!(SceneFile::of(&Loaded::default()).is_none());
        assert!(SceneFile::of(&study(TEXT, &[], &[("colour", "blue")])).is_none());
    }
}
