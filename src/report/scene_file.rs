//! One row of a study as a scene file that `seawall run` takes.

use std::collections::HashMap;
use std::path::Path;

use toml::{Table, Value};

use super::load::Loaded;
use super::study::{file, literal};
use crate::keys::{Section, When};
use crate::scene::{CaseConfig, Place, SeawallScene, place_of};

/// The study's file, without its grid.
#[derive(Debug, Clone)]
pub struct SceneFile {
    name: String,
    scene: Table,
    numerics: Table,
    /// Numerics that were chosen case by case, by the case's id.
    chosen: Option<HashMap<String, Table>>,
    probes: Vec<Table>,
    /// Where each swept key goes.
    swept: Vec<(String, Place)>,
}

impl SceneFile {
    /// Reads the study's file in the manifest. `None` where there is none, and where a swept key is not
    /// known. Numerics that were chosen case by case are those of `max_error.csv`.
    pub fn of(data: &Loaded) -> Option<SceneFile> {
        let file = file(data.manifest.as_ref()?)?;
        let chosen = chosen(&data.directory.join("max_error.csv"));
        let chosen = chosen.or_else(|| file.contains_key("accuracy").then(HashMap::new));
        let table = |key| file.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let scene = table("scene");
        let place = |key: &String| Some((key.clone(), place_of(key, &scene).ok()?));
        let probes = file.get("probe").and_then(Value::as_array).into_iter().flatten();
        let swept = data.keys.iter().map(|key| place(&key.name)).collect::<Option<_>>()?;
        Some(SceneFile {
            name: data.name().unwrap_or("case").to_owned(),
            probes: probes.filter_map(Value::as_table).cloned().collect(),
            numerics: table("numerics"),
            chosen,
            scene,
            swept,
        })
    }

    /// The kind of the scene, as the file states it.
    pub fn kind(&self) -> Option<&str> {
        self.scene.get("kind")?.as_str()
    }

    /// The case of a row, whose swept keys have these cells; `None` where it is not a valid one, or what
    /// was chosen for it is not known.
    pub fn config(&self, id: &str, cells: &[&str]) -> Option<CaseConfig> {
        let (scene, numerics) = self.tables(id, cells)?;
        CaseConfig::with_probes(&scene, &numerics, &self.probes).ok()
    }

    /// The file of a row with `{id}` for the case's id, and for the value of each swept key its name
    /// in braces: rows whose texts are equal share one. `None` where what was chosen for the row is not
    /// known.
    pub fn template(&self, id: &str, cells: &[&str]) -> Option<String> {
        let (mut scene, mut numerics) = self.tables(id, cells)?;
        for ((key, place), cell) in self.swept.iter().zip(cells) {
            if !cell.is_empty() {
                let blank = Value::String(format!("{{{key}}}"));
                table(*place, &mut scene, &mut numerics).insert(key.clone(), blank);
            }
        }
        let name = &self.name;
        let mut text = format!("# Case {{id}} of the study {name}.\nname = \"{name}-{{id}}\"\n");
        for (title, table) in [("[scene]", &scene), ("[numerics]", &numerics)] {
            if !table.is_empty() {
                text.push_str(&format!("\n{title}\n{table}"));
            }
        }
        for probe in &self.probes {
            text.push_str(&format!("\n[[probe]]\n{probe}"));
        }
        Some(self.swept.iter().fold(text, |text, (key, _)| {
            text.replace(&format!("\"{{{key}}}\""), &format!("{{{key}}}"))
        }))
    }

    /// Scene and numerics with the values of a row, without what its wall or paddle does not have.
    fn tables(&self, id: &str, cells: &[&str]) -> Option<(Table, Table)> {
        let mut scene = self.scene.clone();
        let mut numerics = match &self.chosen {
            Some(chosen) => chosen.get(id)?.clone(),
            None => self.numerics.clone(),
        };
        for ((key, place), cell) in self.swept.iter().zip(cells) {
            let table = table(*place, &mut scene, &mut numerics);
            table.remove(key);
            if !cell.is_empty() {
                table.insert(key.clone(), literal(cell));
            }
        }
        let swept = |when: &When| self.swept.iter().any(|(key, _)| key == when.key);
        let values = scene.clone();
        let known = SeawallScene::keys();
        scene.retain(|name, _| {
            let key = known.iter().find(|key| key.name == name);
            key.is_none_or(|key| key.conditions().all(|when| !swept(&when) || when.holds(&values)))
        });
        Some((scene, numerics))
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
            Some((key.to_owned(), literal(value)))
        };
        list.split(", ").filter(|pair| !pair.is_empty()).map(pair).collect()
    };
    Some(rows.filter_map(|row| Some((row.get(0)?.to_owned(), numerics(row.get(of)?)?))).collect())
}

fn table<'a>(place: Place, scene: &'a mut Table, numerics: &'a mut Table) -> &'a mut Table {
    match place {
        Place::Scene => scene,
        Place::Numerics => numerics,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::study::Key;
    use serde_json::json;

    /// A study of these keys and cells, one row.
    fn study(text: &str, overrides: &[&str], keys: &[(&str, &str)]) -> Loaded {
        let key = |(name, cell): &(&str, &str)| Key {
            name: (*name).to_owned(),
            cells: [cell].into_iter().collect(),
        };
        Loaded {
            manifest: Some(json!({ "name": "a", "sweep_file": text, "overrides": overrides })),
            keys: keys.iter().map(key).collect(),
            ..Loaded::default()
        }
    }

    /// The text of the row as a page fills it in.
    fn filled(data: &Loaded) -> String {
        let cells: Vec<_> = data.keys.iter().map(|key| &key.cells[0]).collect();
        let file = SceneFile::of(data).unwrap();
        let text = file.template("0123", &cells).unwrap().replace("{id}", "0123");
        let text = data.keys.iter().fold(text, |text, key| {
            text.replace(&format!("{{{}}}", key.name), &literal(&key.cells[0]).to_string())
        });
        let read: Table = text.parse().unwrap();
        let table =
            |key: &str| read.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let config = CaseConfig::from_tables(&table("scene"), &table("numerics")).unwrap();
        assert_eq!(file.config("0123", &cells), Some(config), "{text}");
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
        let untold = SceneFile::of(&data).unwrap();
        assert!(untold.template("0123", &["sfdi", "10"]).is_none());
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
        let file = SceneFile::of(&data).unwrap();
        assert!(file.config("4567", &["sfdi", "10"]).is_none());
    }

    #[test]
    fn a_study_without_file_or_with_unknown_keys_has_none() {
        assert!(SceneFile::of(&Loaded::default()).is_none());
        assert!(SceneFile::of(&study(TEXT, &[], &[("colour", "blue")])).is_none());
    }
}
