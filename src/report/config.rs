//! All values of `[scene]` and `[numerics]` of each case, from the manifest and from the swept keys
//! in its row.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use rayon::prelude::*;
use serde::Deserialize;
use toml::{Table, Value};

use super::load::Loaded;
use super::study::StudyFile;
use crate::body::Stroke;
use crate::keys::{Section, number, value_of};
use crate::math::tally::Tally;
use crate::quantities::Column;
use crate::quantities::summary::{BOUNDARY, KERNEL, PARTICLE_SPACING, SCHEME};
use crate::scene::{CaseConfig, odd_by_key};

/// All values of one case, with those that the program chose.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Config {
    /// `[scene]`.
    pub scene: Table,
    /// `[numerics]`.
    pub numerics: Table,
}

impl Config {
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

/// How many are made at once, on all cores.
const BLOCK: usize = 1024;

/// The values of the rows at these places, made in blocks: those of a large study take gigabytes.
pub fn each_config(
    data: &Loaded,
    mut rows: impl Iterator<Item = usize>,
) -> impl Iterator<Item = Option<Config>> {
    let (file, starts) = (data.file(), Starts::default());
    let block = move || {
        let block: Vec<usize> = rows.by_ref().take(BLOCK).collect();
        let make = |row: usize| config(file.as_ref()?, data, row, &starts);
        (!block.is_empty()).then(|| block.into_par_iter().map(make).collect::<Vec<_>>())
    };
    std::iter::from_fn(block).flatten()
}

/// Values in these rows that look like a slip, each key once with its first sentence, as `seawall
/// check` prints it. It says so where only some of the cases have such a value. Cases that play a
/// record are left out: their file may be out of reach.
pub fn oddities(data: &Loaded, rows: impl Iterator<Item = usize>) -> Vec<String> {
    let Some(file) = data.file() else { return Vec::new() };
    let odd = |row| {
        let [scene, numerics] = file.of_row(&data.keys, row, &file.numerics)?;
        let case = CaseConfig::with_probes(&scene, &numerics, &file.probes).ok()?;
        (!scene.contains_key(STROKE)).then(|| odd_by_key(&case))
    };
    Tally::counted(rows.filter_map(odd)).lines(|_| " (in some cases)".to_owned())
}

/// The key of a recorded stroke, whose value here is its path. A long record in every case would
/// take gigabytes. Its file may also be out of reach where the report is made.
const STROKE: &str = "recorded_stroke";

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
    let probes = data.file().unwrap_or_default().probes.into_iter();
    probes.filter_map(|table| table.try_into().ok()).collect()
}

/// The time of the first point in each stroke's file, s, by path. Each file is opened once.
type Starts = Mutex<BTreeMap<String, f64>>;

fn config(file: &StudyFile, data: &Loaded, row: usize, starts: &Starts) -> Option<Config> {
    let [mut scene, numerics] = file.of_row(&data.keys, row, &file.numerics)?;
    let stroke = scene.get(STROKE).and_then(Value::as_str).map(str::to_owned);
    if let Some(path) = &stroke {
        let read = || Stroke::start_of(path).unwrap_or(0.0);
        let mut starts = starts.lock().unwrap_or_else(PoisonError::into_inner);
        let start_s = *starts.entry(path.clone()).or_insert_with(read);
        let still = [0.0, 1.0, 2.0].map(|later| [start_s + later, 0.0]);
        scene.insert(STROKE.to_owned(), value_of(&still)?);
    }
    let config = CaseConfig::with_probes(&scene, &numerics, &file.probes).ok()?;
    let row = &data.rows[row];
    let mut numerics = config.numerics.table();
    // What `--max-error` chose for the case.
    for column in [&SCHEME, &BOUNDARY, &KERNEL] {
        set(&mut numerics, column, Some(row.text(column)).filter(|text| !text.is_empty()));
    }
    set(&mut numerics, &PARTICLE_SPACING, row.number(&PARTICLE_SPACING));
    let mut scene = config.scene.table();
    if let Some((place, path)) = scene.get_mut(STROKE).zip(stroke) {
        *place = path.into();
    }
    Some(Config { scene, numerics })
}

/// Sets a key that the case already has.
fn set(table: &mut Table, column: &Column, value: Option<impl Into<Value>>) {
    if let Some((place, value)) = table.get_mut(column.name).zip(value) {
        *place = value.into();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{FORCE_COUPLING, SPRING_STIFFNESS, WAVE_HEIGHT_RATIO};
    use crate::report::study::Key;
    use serde_json::json;

    fn of(file: &str, overrides: &[&str], keys: &[(&str, &[&str])]) -> Vec<Option<Config>> {
        let keys: Vec<_> = keys.iter().map(|(name, cells)| Key::new(name, *cells)).collect();
        let rows = vec![Default::default(); keys.first().map_or(1, |key| key.cells.iter().len())];
        let manifest = Some(json!({ "sweep_file": file, "overrides": overrides }));
        configs(&Loaded { rows, keys, manifest, ..Loaded::default() })
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
        let keys = vec![Key::new("recorded_stroke", [path.to_str().unwrap(); 2])];
        let manifest = Some(json!({ "sweep_file": file }));
        let data =
            Loaded { rows: vec![Default::default(); 2], keys, manifest, ..Loaded::default() };
        let mut all = each_config(&data, 0..2);
        let first = all.next().unwrap().unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(all.next().unwrap().unwrap(), first);
        assert_ne!(configs(&data)[0].as_ref().unwrap(), &first, "the clock counts");
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
