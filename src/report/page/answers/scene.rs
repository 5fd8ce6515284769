//! The tank and the water that all cases share: unswept keys, with values that files left out.

use toml::Table;

use crate::keys::Key;
use crate::keys::number as read;
use crate::math::lists::rising;
use crate::math::words::{capitalised, listed};
use crate::report::config::{each_config, oddities};
use crate::report::curves::spread_places;
use crate::report::load::Loaded;
use crate::report::page::words::range;
use crate::scene::{Kind, scene_keys};

/// How many cases are looked at: in further cases only swept keys may differ.
const LOOKED_AT: usize = 50;

/// Keys that are no part of the tank, or are reported with the number of cases.
const UNSAID: [&str; 2] = ["kind", "history_interval_s"];

/// Every scene key that is on and was not swept, with its value; `None` where the files do not hold
/// it.
pub fn shared(data: &Loaded) -> Option<String> {
    let configs = each_config(data, spread_places(data.rows.len(), LOOKED_AT));
    let scenes: Vec<Table> = configs.flatten().map(|config| config.scene).collect();
    let kind = scenes.first()?.get("kind")?.as_str()?.to_owned();
    let kind = Kind::ALL.iter().find(|one| one.name() == kind)?;
    let swept = |key: &&Key| data.keys.iter().any(|one| one.name == key.name);
    let keys = scene_keys(*kind).into_iter().filter(|key| !swept(key));
    let told = keys.filter(|key| !UNSAID.contains(&key.name));
    let told: Vec<_> = told.filter_map(|key| value(key, &scenes)).collect();
    (!told.is_empty()).then(|| capitalised(&format!("{}.", told.join(", "))))
}

/// What looks like a slip in the scene, in the words of `seawall check`. Someone who gets only the
/// page has not read them. `None` where nothing does.
pub fn odd(data: &Loaded) -> Option<String> {
    let told = oddities(data, spread_places(data.rows.len(), LOOKED_AT));
    (!told.is_empty()).then(|| format!("{}.", told.join(". ")))
}

/// A key and its values in a sentence's words: `tank length 2.5 m`.
fn value(key: &Key, scenes: &[Table]) -> Option<String> {
    let on = scenes.iter().filter(|scene| key.is_on(scene));
    let values: Vec<_> = on.filter_map(|scene| scene.get(key.name)).collect();
    let name = key.label();
    let numbers = rising(values.iter().filter_map(|value| read(value)));
    if !numbers.is_empty() {
        let symbol = if key.name == "still_water_depth_m" { " h =" } else { "" };
        return Some(format!("{name}{symbol} {}", range(&numbers, key.rule.unit)));
    }
    let mut words: Vec<String> = values.iter().map(|value| word(value)).collect();
    words.dedup();
    match &words[..] {
        [] => None,
        [off] if off == "nothing" => None,
        [yes] if yes == "true" => Some(name),
        _ => Some(format!("{name} {}", listed(&words))),
    }
}

fn word(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => text.replace('-', " "),
        toml::Value::Array(points) => format!("through {} points", points.len()),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(file: &str, key: &str, cells: &[&str]) -> Option<String> {
        shared(&Loaded::swept(&[(key, cells)]).made_from(file, &[]))
    }

    #[test]
    fn what_files_leave_out_is_told_too_and_what_was_swept_is_not() {
        let file = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    spring_stiffness_n_per_m = 10\n[grid]\nwave_height_ratio = [0.2, 0.3]";
        assert_eq!(
            of(file, "wave_height_ratio", &["0.2", "0.3"]).unwrap(),
            "Still water depth h = 0.2 m, tank length 2.5 m, gravity 9.81 m/s², water density 1000 \
             kg/m³, end after stroke 3 s, paddle ramp 0.05, wall movable, threshold \
             ratio 1.1, force coupling 1, spring stiffness 10 N/m, seawall mass 50 kg/m, wave gauge \
             1.5 m."
        );
    }

    /// The story: a run ended before its wave reached the wall. The page called the force of still
    /// water the largest, and no result doubtful.
    #[test]
    fn a_slip_that_check_tells_of_is_on_the_page() {
        let of = |end: &str| {
            let file = format!(
                "name = \"a\"\n[scene]\ntank_length_m = 12\n{end}\n[grid]\nwave_height_ratio = [0.2, 0.3]"
            );
            let data = Loaded::swept(&[("wave_height_ratio", &["0.2", "0.3"])]);
            odd(&data.made_from(&file, &[]))
        };
        let told = of("").unwrap();
        assert!(
            told.contains("before the crest can be at the wall") && told.ends_with('.'),
            "{told}"
        );
        assert_eq!(told.matches("tank_length_m = ").count(), 1, "{told}");
        assert!(!told.contains("in some cases"), "{told}");
        assert_eq!(of("end_time_s = 30"), None);
        let file =
            "name = \"a\"\n[scene]\nwave_height_ratio = 0.2\n[grid]\ntank_length_m = [2.5, 12]";
        let data = Loaded::swept(&[("tank_length_m", &["2.5", "12"])]);
        let told = odd(&data.made_from(file, &[])).unwrap();
        assert!(told.ends_with("(in some cases)."), "{told}");
        assert_eq!(odd(&Loaded::default()), None);
    }

    /// The story: pages of runs of 8 s began with "end after stroke 3 s, end time 8 s".
    #[test]
    fn one_end_of_a_run_is_told() {
        let told = |more: &str| {
            of(
                &format!("name = \"a\"\n[scene]\n{more}\n[grid]\nwave_height_ratio = [0.2]"),
                "wave_height_ratio",
                &["0.2"],
            )
            .unwrap()
        };
        assert!(told("").contains("end after stroke 3 s") && !told("").contains("end time"));
        let given = told("end_time_s = 8");
        assert!(given.contains("end time 8 s") && !given.contains("after stroke"), "{given}");
    }

    #[test]
    fn other_scenes_have_their_own_keys() {
        let file = "name = \"a\"\n[scene]\nkind = \"dam-break\"\n[grid]\ncolumn_height_m = [0.6]";
        let told = of(file, "column_height_m", &["0.6"]).unwrap();
        assert!(told.starts_with("Column length 1.2 m, tank length 3.22 m"), "{told}");
        assert_eq!(of("[[case]]", "case", &["a"]), None);
    }
}
