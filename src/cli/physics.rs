//! Which physics and numerics are on, for `seawall check`.

use std::collections::HashSet;

use rayon::prelude::*;
use toml::{Table, Value};

use crate::keys::{Key, Section, Shared};
use crate::math::decimal::significant;
use crate::scene::{Kind, Numerics, Scene, numerics_keys, scene_keys};
use crate::study::{Case, Study};

/// A key that is on, and the values that occur among the cases, `none` where a case has none.
pub(super) struct Line {
    /// The key's name in files.
    pub name: &'static str,
    /// The key in a few words.
    pub label: String,
    /// Its unit, empty for names, counts and ratios.
    pub unit: &'static str,
    /// The values, in the order of the cases.
    pub values: Vec<String>,
}

/// Cases that are looked at in one go.
const CHUNK: usize = 1000;
/// Values of a key that are written out.
const MOST: usize = 8;
/// Digits that numbers have as people write them, at most, and as the program tells those that it derives.
const WRITTEN: usize = 9;
const TOLD: usize = 4;

impl Line {
    /// The values, or the first ones of many, for who knows what the file says.
    pub(super) fn text(&self, file: &str) -> String {
        let first = self.values.iter().take(MOST).map(|value| brief(value, file));
        let mut text = first.collect::<Vec<_>>().join(", ");
        if self.values.len() > MOST {
            text += &format!(", ... ({} values)", self.values.len());
        }
        if self.unit.is_empty() { text } else { format!("{text} {}", self.unit) }
    }
}

/// A value with few digits, where it is neither short nor in the file.
fn brief(value: &str, file: &str) -> String {
    let derived = |number: &f64| significant(*number, WRITTEN) != *number && !file.contains(value);
    let number = value.parse().ok().filter(derived);
    number.map_or_else(|| value.to_owned(), |number| significant(number, TOLD).to_string())
}

/// What is on, key by key in the order of their declarations.
pub(super) fn physics(study: &Study) -> Vec<Line> {
    let keys = keys(study);
    let chunks = study.cases.par_chunks(CHUNK).map(|cases| occurring(&keys, cases));
    let mut columns: Vec<Column> = keys.iter().map(|_| Column::default()).collect();
    for chunk in chunks.collect::<Vec<_>>() {
        for (column, more) in columns.iter_mut().zip(chunk) {
            column.is_on |= more.is_on;
            more.values.into_iter().for_each(|value| column.take(value));
        }
    }
    let pairs = keys.iter().zip(columns);
    let mut lines: Vec<Line> = pairs.filter_map(|(key, column)| line(key, column)).collect();
    let probes = study.cases.first().map(|case| &case.config.probes[..]).unwrap_or_default();
    if !probes.is_empty() {
        let names: Vec<_> = probes.iter().map(|probe| probe.name.as_str()).collect();
        let values = vec![names.join(" ")];
        lines.push(Line { name: "probes", label: "probes".to_owned(), unit: "", values });
    }
    lines
}

/// The keys of all kinds of scenes that occur, and of the numerics.
fn keys(study: &Study) -> Vec<&'static Key> {
    let kinds: HashSet<_> = study.cases.iter().map(|case| case.config.scene.kind()).collect();
    let kinds = Kind::ALL.iter().filter(|kind| kinds.contains(kind.name()));
    let mut keys: Vec<&Key> = Vec::new();
    for key in kinds.flat_map(|&kind| scene_keys(kind)).chain(numerics_keys()) {
        if keys.iter().all(|earlier| earlier.name != key.name) {
            keys.push(key);
        }
    }
    keys
}

fn values(scene: &Scene, numerics: &Table) -> Table {
    let mut values = Table::try_from(scene).unwrap_or_default();
    values.extend(numerics.iter().map(|(key, value)| (key.clone(), value.clone())));
    values
}

/// The different values of a key, in the order in which they come, `none` where a case has none.
#[derive(Default)]
struct Column {
    values: Vec<String>,
    seen: HashSet<String>,
    /// Whether any case has one.
    is_on: bool,
}

impl Column {
    fn take(&mut self, value: String) {
        if self.values.last() != Some(&value) && self.seen.insert(value.clone()) {
            self.values.push(value);
        }
    }
}

/// The values of each key among some cases. A case with all its keys is large: none is kept.
fn occurring(keys: &[&'static Key], cases: &[Case]) -> Vec<Column> {
    let mut columns: Vec<Column> = keys.iter().map(|_| Column::default()).collect();
    let mut shared: Option<(&Shared<Numerics>, Table)> = None;
    for case in cases {
        let own = &case.config.numerics;
        let numerics = match shared.take() {
            Some((known, table)) if known == own => table,
            _ => own.table(),
        };
        let numerics = &shared.insert((own, numerics)).1;
        let case = values(&case.config.scene, numerics);
        for (key, column) in keys.iter().zip(&mut columns) {
            let value = case.get(key.name).filter(|_| key.is_on(&case));
            column.is_on |= value.is_some();
            column.take(value.map_or_else(|| "none".to_owned(), text));
        }
    }
    columns
}

fn line(key: &'static Key, column: Column) -> Option<Line> {
    let (name, label, unit) = (key.name, key.label(), key.rule.unit);
    column.is_on.then_some(Line { name, label, unit, values: column.values })
}

fn text(value: &Value) -> String {
    match value {
        Value::String(name) => name.clone(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(on) => if *on { "yes" } else { "no" }.to_owned(),
        Value::Array(points) => format!("{} points", points.len()),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::SweepFile;

    fn value(text: &str, name: &str) -> Option<String> {
        let text = format!("name = \"a\"\n{text}");
        let lines = physics(&Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap());
        lines.into_iter().find(|line| line.name == name).map(|line| line.text(&text))
    }

    #[test]
    fn what_is_on_is_told_and_only_that() {
        let some = |text: &str| Some(text.to_owned());
        for off in ["kinematic_viscosity_m2_per_s", "retries", "stop_when_settled", "probes"] {
            assert_eq!(value("", off), None, "{off}");
        }
        let on = "[numerics]\nkinematic_viscosity_m2_per_s = 1e-6\nretries = 2\n\
                  stop_when_settled = true\nprecision = \"f32\"\n\
                  [[probe]]\nname = \"P1\"\nkind = \"level\"\nx_m = 1";
        assert_eq!(value(on, "kinematic_viscosity_m2_per_s"), some("0.000001 m²/s"));
        assert_eq!(value(on, "retries"), some("2"));
        assert_eq!(value(on, "stop_when_settled"), some("yes"));
        assert_eq!(value(on, "precision"), some("f32"));
        assert_eq!(value(on, "probes"), some("P1"));
    }

    /// The story: the relaxation time of a beach stood there as `5.711372491708257 s`.
    #[test]
    fn a_derived_number_has_few_digits_and_a_written_one_all() {
        let bed = "[scene]\nbed = [[0, 0], [2.25, 0], [4, 0.35]]\ntank_length_m = 4\n";
        let told = |more: &str| value(&format!("{bed}{more}"), "relaxation_time_s").unwrap();
        assert_eq!(told(""), "5.711 s");
        let written = "[numerics]\nrelaxation_time_s = 5.711372491708257";
        assert_eq!(told(written), "5.711372491708257 s");
    }

    #[test]
    fn a_scheme_and_a_wall_show_their_own_keys() {
        let some = |text: &str| Some(text.to_owned());
        let isph = "[numerics]\nscheme = \"isph\"";
        assert_eq!(value(isph, "laplacian"), some("exact"));
        assert_eq!(value("", "laplacian"), None);
        for other in ["boundary", "density_diffusion", "bulk_damping", "sound_speed_ratio"] {
            assert_eq!(value(isph, other), None, "{other}");
            assert!(value("", other).is_some(), "{other}");
        }
        let both = "[grid]\nscheme = [\"wcsph\", \"isph\"]";
        assert_eq!(value(both, "scheme"), some("wcsph, isph"));
        assert_eq!(value(both, "laplacian"), some("none, exact"));
        assert_eq!(value("[scene]\nkind = \"rotating-patch\"", "wall"), None);
        let movable = "[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                       spring_stiffness_n_per_m = 10";
        assert_eq!(value(movable, "wall_angle_deg"), None);
        assert_eq!(value(movable, "spring_stiffness_n_per_m"), some("10 N/m"));
        assert_eq!(value("", "wall_angle_deg"), some("90 °"));
        let many = "[grid]\nwave_height_ratio = { from = 0.1, to = 0.5, points = 9 }";
        let told = "0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, ... (9 values)";
        assert_eq!(value(many, "wave_height_ratio"), some(told));
    }
}
