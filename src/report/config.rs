//! All values of `[scene]` and `[numerics]` of each case, from the manifest and from the swept keys
//! in its row.

use serde::Deserialize;
use toml::Table;

use super::case::STROKE;
use super::load::Loaded;
use crate::keys::{Section, number};
use crate::math::tally::Tally;
use crate::quantities::Column;
use crate::scene::odd_by_key;

/// All values of one case, with those that the program chose.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Config {
    /// `[scene]`.
    pub scene: Table,
    /// `[numerics]`.
    pub numerics: Table,
}

impl Config {
    /// The values of a row, with the path of its recorded stroke.
    pub fn of(data: &Loaded, row: usize) -> Option<Config> {
        let (case, stroke) = data.case_and_stroke(row)?;
        let mut scene = case.scene.table();
        if let Some((place, path)) = scene.get_mut(STROKE).zip(stroke) {
            *place = path.into();
        }
        Some(Config { scene, numerics: case.numerics.table() })
    }

    /// A number of the scene.
    pub fn value(&self, key: &str) -> Option<f64> {
        number(self.scene.get(key)?)
    }

    /// The number of a scene key that is also a column.
    pub fn number(&self, column: &Column) -> Option<f64> {
        self.value(column.name)
    }
}

/// The values of each row of the summary. `None` where the files do not tell them: there is no
/// manifest, or its file is no sweep that this program reads.
pub fn configs(data: &Loaded) -> Vec<Option<Config>> {
    each_config(data, 0..data.rows.len()).collect()
}

/// The values of the rows at these places.
pub fn each_config(
    data: &Loaded,
    rows: impl Iterator<Item = usize>,
) -> impl Iterator<Item = Option<Config>> {
    data.in_blocks(rows, |row| Config::of(data, row))
}

/// Values in these rows that look like a slip, each key once with its first sentence, as `seawall
/// check` prints it. It says so where only some of the cases have such a value. Cases that play a
/// record are left out: their file may be out of reach.
pub fn oddities(data: &Loaded, rows: impl Iterator<Item = usize>) -> Vec<String> {
    let odd = |row| match data.case_and_stroke(row)? {
        (case, None) => Some(odd_by_key(&case)),
        _ => None,
    };
    Tally::counted(rows.filter_map(odd)).lines(|_| " (in some cases)".to_owned())
}

/// A gauge of a study.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Gauge {
    /// Its column.
    pub name: String,
    /// `pressure`, `level` or `void`.
    pub kind: String,
    /// Place along the tank, m; only for gauges outside a wall.
    pub x_m: Option<f64>,
    /// Height above the bed, m.
    pub y_m: Option<f64>,
}

/// The gauges of a study.
pub fn gauges(data: &Loaded) -> Vec<Gauge> {
    let probes = data.file.iter().flat_map(|file| &file.probes);
    probes.filter_map(|table| table.clone().try_into().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{FORCE_COUPLING, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};

    fn of(file: &str, overrides: &[&str], keys: &[(&str, &[&str])]) -> Vec<Option<Config>> {
        configs(&Loaded::swept(keys).made_from(file, overrides))
    }

    #[test]
    fn file_command_line_and_row_say_what_a_case_was() {
        let file = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    [grid]\nwave_height_ratio = [0.2]";
        let waves: &[&str] = &["0.2", "0.3"];
        let stiffness: &[&str] = &["10", "1000000"];
        let keys = [("wave_height_ratio", waves), ("spring_stiffness_n_per_m", stiffness)];
        let configs = of(file, &["scene.force_coupling=0.4"], &keys);
        let last = configs[1].as_ref().unwrap();
        let read = [&WAVE_HEIGHT_RATIO, &SPRING_STIFFNESS, &FORCE_COUPLING];
        assert_eq!(read.map(|column| last.number(column)), [Some(0.3), Some(1e6), Some(0.4)]);
        assert_eq!(last.scene["still_water_depth_m"].as_float(), Some(0.2), "a default");
        assert_eq!(last.numerics["support_radius_ratio"].as_float(), Some(5.0), "of a preset");
    }

    #[test]
    fn a_fixed_wall_among_movable_ones_has_no_spring() {
        let file = "[scene]\nseawall_mass_kg_per_m = 50\n[grid]\nwall = [\"fixed\"]";
        let walls: &[&str] = &["fixed", "movable"];
        let stiffness: &[&str] = &["", "10"];
        let configs = of(file, &[], &[("wall", walls), ("spring_stiffness_n_per_m", stiffness)]);
        let numbers = configs.iter().map(|c| c.as_ref().unwrap().number(&SPRING_STIFFNESS));
        assert_eq!(numbers.collect::<Vec<_>>(), [None, Some(10.0)]);
    }

    /// Without the stroke's file the keys of a study were unknown: `compare` then paired every tank
    /// with every other. Where the file is there, its clock counts: a long run has other defaults.
    #[test]
    fn a_recorded_stroke_is_its_path() {
        let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/usace_1995/stroke_b.csv");
        for (path, feedback) in [("no/such/file.csv", true), (shipped, false)] {
            let file = format!(
                "[scene]\npaddle = \"recorded-stroke\"\nrecorded_stroke = \"{path}\"\nend_time_s = 263"
            );
            let configs = of(&file, &[], &[]);
            let Config { scene, numerics } = configs[0].as_ref().unwrap();
            assert_eq!(scene["recorded_stroke"].as_str(), Some(path));
            assert_eq!(numerics.contains_key("volume_feedback"), feedback, "{path}");
        }
    }

    /// The file was opened once for each case, which takes long on a distant disk.
    #[test]
    fn the_file_of_a_stroke_is_opened_once() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("stroke.csv");
        std::fs::write(&path, "time_s,stroke_m\n260,0\n261,0.1\n262,0\n").unwrap();
        let file = "[scene]\npaddle = \"recorded-stroke\"\nend_time_s = 263";
        let keys: &[(_, &[_])] = &[("recorded_stroke", &[path.to_str().unwrap(); 2])];
        let data = || Loaded::swept(keys).made_from(file, &[]);
        let (data, later) = (data(), data());
        let first = Config::of(&data, 0).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(Config::of(&data, 1).unwrap(), first);
        assert_ne!(Config::of(&later, 0).unwrap(), first, "the clock counts");
    }

    #[test]
    fn what_is_no_sweep_file_tells_nothing() {
        assert_eq!(of("[[case]]\nname = \"x\"", &[], &[("case", &["x"])]), [None]);
        assert_eq!(
            configs(&Loaded { rows: vec![Default::default()], ..Loaded::default() }),
            [None]
        );
    }
}
