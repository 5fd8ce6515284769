//! One row of a study as a scene file that `seawall run` takes.

use toml::Value;

use super::load::Loaded;
use super::study::{Key, StudyFile};
use crate::scene::{Place, place_of};

/// Whether rows of a study have such files: its own is there, and knows all swept keys.
pub fn are_there(data: &Loaded) -> bool {
    let known = |file: &StudyFile, key: &Key| place_of(&key.name, &file.scene).is_ok();
    data.file.as_ref().is_some_and(|file| data.keys.iter().all(|key| known(file, key)))
}

/// The file of a row, with `{id}` in place of the case's id. Each swept key's name in braces
/// stands in place of its value. Rows with equal texts share one. `None` if the row's chosen
/// numerics are not known.
pub fn template(data: &Loaded, row: usize) -> Option<String> {
    let [mut scene, mut numerics] = data.tables(row)?;
    let file = data.file.as_ref()?;
    for Key { name, .. } in data.keys.iter().filter(|key| !key.cells[row].is_empty()) {
        let table = match place_of(name, &file.scene).ok()? {
            Place::Scene => &mut scene,
            Place::Numerics => &mut numerics,
        };
        table.insert(name.clone(), Value::String(format!("{{{name}}}")));
    }
    let name = data.name().unwrap_or("case");
    let mut text = format!("# Case {{id}} of the study {name}.\nname = \"{name}-{{id}}\"\n");
    for (title, table) in [("[scene]", &scene), ("[numerics]", &numerics)] {
        if !table.is_empty() {
            text.push_str(&format!("\n{title}\n{table}"));
        }
    }
    for probe in &file.probes {
        text.push_str(&format!("\n[[probe]]\n{probe}"));
    }
    Some(data.keys.iter().fold(text, |text, Key { name, .. }| {
        text.replace(&format!("\"{{{name}}}\""), &format!("{{{name}}}"))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::read_value;
    use crate::quantities::summary::CASE_ID;
    use crate::report::chosen::chosen;
    use crate::report::row::Row;
    use crate::scene::CaseConfig;
    use toml::Table;

    /// A study of these keys and cells, one row.
    fn study(text: &str, overrides: &[&str], keys: &[(&str, &str)]) -> Loaded {
        let keys = keys.iter().map(|(name, cell)| Key::new(name, [cell])).collect();
        let rows = vec![Row::default().with(&CASE_ID, "0123")];
        Loaded { rows, keys, ..Loaded::default() }.made_from(text, overrides)
    }

    /// The text of the row as a page completes it.
    fn filled(data: &Loaded) -> String {
        let text = template(data, 0).unwrap().replace("{id}", "0123");
        let text = data.keys.iter().fold(text, |text, key| {
            text.replace(&format!("{{{}}}", key.name), &read_value(&key.cells[0]).to_string())
        });
        let read: Table = text.parse().unwrap();
        let table =
            |key: &str| read.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let config = CaseConfig::from_tables(&table("scene"), &table("numerics")).unwrap();
        assert_eq!(data.case_as_run(0), Some(config), "{text}");
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
        assert!(template(&data, 0).is_none());
        let root = tempfile::tempdir().unwrap();
        let rows = "case_id,particle_spacing_m,numerics,met\n\
            0123,0.0125,\"particle_spacing_m = 0.0125, boundary = sfdi, sound_speed_ratio = 12.0\",true\n";
        let path = root.path().join("max_error.csv");
        std::fs::write(&path, rows).unwrap();
        data.chosen = chosen(&path, &data.rows);
        let text = filled(&data);
        assert!(
            text.contains("particle_spacing_m = 0.0125")
                && text.contains("sound_speed_ratio = 12.0"),
            "{text}"
        );
        assert!(text.contains("boundary = \"sfdi\""), "{text}");
        // The story: `compare` and the page knew four of the numerics that `--max-error` had chosen.
        assert_eq!(data.case(0).unwrap().numerics.sound_speed_ratio, 12.0);
        data.rows = vec![Row::default().with(&CASE_ID, "4567")];
        data.chosen = chosen(&path, &data.rows);
        assert!(data.case_as_run(0).is_none());
    }

    #[test]
    fn a_study_without_file_or_with_unknown_keys_has_none() {
        assert!(!are_there(&Loaded::default()));
        let other = study(TEXT, &[], &[("colour", "blue")]);
        assert!(!are_there(&other) && template(&other, 0).is_none());
    }
}
