//! The scene of one case in words, as far as no column of the summary tells it.

use toml::Value;

use super::config::Config;
use super::load::Loaded;
use super::number::{as_typed, minus};
use crate::keys::{Key, alike, number};
use crate::quantities::named;
use crate::scene::{Kind, scene_keys};

/// A list of more points is told by their number.
const POINTS: usize = 8;

/// Name and value of each scene key of a row that is on and not as by default. Swept keys and those
/// with a column are left out; so is everything where the study's files do not tell it.
pub fn scene_values(data: &Loaded, row: usize) -> Vec<(String, String)> {
    let Some(Config { scene, .. }) = Config::of(data, row) else { return Vec::new() };
    let kind = scene.get("kind").and_then(Value::as_str);
    let kind = Kind::ALL.iter().find(|one| Some(one.name()) == kind).copied();
    let swept = |key: &Key| data.keys.iter().any(|one| one.name == key.name);
    let usual =
        |key: &Key, value: &Value| (key.default)().is_some_and(|default| alike(value, &default));
    let told = |key: &'static Key| {
        let value = scene.get(key.name).filter(|_| key.is_on(&scene))?;
        let elsewhere = swept(key) || named(key.name).is_some();
        (!elsewhere && !usual(key, value)).then(|| (key.label(), in_words(key, value)))
    };
    scene_keys(kind.unwrap_or(Kind::DEFAULT)).into_iter().filter_map(told).collect()
}

/// What the key `wall` says of a row. None where its scene has no such key, or the study's files do not tell it.
pub fn wall_of(data: &Loaded, row: usize) -> Option<String> {
    data.case(row)?.scene.entry("wall")?.as_str().map(str::to_owned)
}

/// A value with its unit. A bed is told by its points, if they are few.
fn in_words(key: &Key, value: &Value) -> String {
    if let Some(value) = number(value) {
        return format!("{} {}", minus(&as_typed(value)), key.rule.unit).trim_end().to_owned();
    }
    match value {
        Value::Boolean(on) => if *on { "yes" } else { "no" }.to_owned(),
        Value::Array(points) if points.len() > POINTS => format!("{} points", points.len()),
        Value::Array(points) => points.iter().map(point).collect::<Vec<_>>().join(", "),
        Value::String(word) => word.clone(),
        other => other.to_string(),
    }
}

/// A point as in a file, without decimals where there are none.
fn point(value: &Value) -> String {
    let Some(places) = value.as_array() else { return value.to_string() };
    let places = places.iter().filter_map(number).map(|place| minus(&as_typed(place)));
    format!("[{}]", places.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(file: &str, key: &str) -> String {
        let data = Loaded::swept(&[(key, &["0.1"])]).made_from(file, &[]);
        let told = scene_values(&data, 0).into_iter();
        told.map(|(name, value)| format!("{name}: {value}\n")).collect()
    }

    /// The story: `seawall show` of a train at a crest told neither period nor bed, freeboard or
    /// width.
    #[test]
    fn what_no_column_tells_is_told_unless_it_is_as_by_default() {
        let file = "name = \"a\"\n[scene]\nstill_water_depth_m = 0.2\npaddle = \"wave-train\"\n\
                    wave_period_s = 1.5\nend_time_s = 8\nbed = [[0, 0], [1.6, 0], [2.5, 0.05]]\n\
                    behind = \"outflow\"\ncrest_freeboard_m = 0.05\ncrest_width_m = 0.3\n\
                    [grid]\nwave_height_ratio = [0.1]";
        let all = told(file, "wave_height_ratio");
        for line in [
            "wave period: 1.5 s\n",
            "bed: [0, 0], [1.6, 0], [2.5, 0.05]\n",
            "crest freeboard: 0.05 m\n",
            "crest width: 0.3 m\n",
            "end time: 8 s\n",
        ] {
            assert!(all.contains(line), "{line}{all}");
        }
        assert!(!all.contains("still water depth") && !all.contains("gravity"), "{all}");
        assert!(!all.contains("wave height ratio"), "{all}");
        let swept = "\nwave_height_ratio = 0.1\n[grid]\ncrest_width_m = [0.3]";
        let file = file.replace("crest_width_m = 0.3\n", "").replace("[grid]", "");
        let file = file.replace("\nwave_height_ratio = [0.1]", swept);
        let all = told(&file, "crest_width_m");
        assert!(all.contains("crest freeboard") && !all.contains("crest width"), "{all}");
    }

    #[test]
    fn a_bed_of_many_points_is_told_by_their_number() {
        let points: Vec<_> = (0..20).map(|at| format!("[{at}, 0.0{at:02}]")).collect();
        let file = format!(
            "name = \"a\"\n[scene]\nbed = [{}]\n[grid]\nwave_height_ratio = [0.1]",
            points.join(", ")
        );
        let key = scene_keys(Kind::DEFAULT).into_iter().find(|key| key.name == "bed").unwrap();
        let bed = file.parse::<toml::Table>().unwrap()["scene"]["bed"].clone();
        assert_eq!(in_words(key, &bed), "20 points");
    }
}
