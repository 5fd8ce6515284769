//! The difference between the study of a directory and another one, for users who have edited a
//! file and want to go on.

use std::path::Path;

use toml::{Table, Value};

use super::manifest::Manifest;
use crate::keys::{Override, alike, number, shortened, with_settings};
use crate::study::{GridAxis, PHYSICS_VERSION, Study};

/// The first difference in words: the physics version, a key of the two files with the settings of
/// their command lines, or the aim. `None` if none of these differs.
pub(super) fn difference(directory: &Path, study: &Study) -> Option<String> {
    let there = Manifest::read(directory)?;
    if there.physics_version != PHYSICS_VERSION {
        let version = there.physics_version;
        return Some(format!(
            "it is of physics version {version}, this program of {PHYSICS_VERSION}"
        ));
    }
    let sets: Vec<Override> = there.overrides.iter().filter_map(|set| set.parse().ok()).collect();
    let before = with_settings(&there.sweep_file, &sets);
    let both = before.zip(with_settings(&study.file_text, &study.sets));
    let told = both.and_then(|(before, here)| first("", &before, &here));
    // A setting that was not given again.
    let set = told.as_ref().and_then(|told| {
        let is_told = |set: &&Override| told.starts_with(&format!("{} ", set.path()));
        let set = sets.iter().rfind(is_told)?;
        let again = study.sets.iter().any(|here| here.path() == set.path());
        let value = shortened(&set.value().to_string());
        (!again).then(|| format!("it was made with --set {}={value}", set.path()))
    });
    let in_files = set.or(told);
    // What is in no file.
    let told = |aim: Option<f64>| {
        aim.map_or("without --max-error".to_owned(), |aim| format!("with --max-error {aim}"))
    };
    let [then, now] = [there.max_error_percent, study.max_error_percent].map(told);
    let aim = (then != now).then(|| format!("it was made {then}, this one {now}"));
    in_files.or(aim)
}

/// Keys that are not part of a study's identity.
const FREE: [&str; 4] = ["name", "limits", "accuracy", "numerics.error_bars"];

/// Whether two values are equal: 1 is 1.0. But 0 and -0 make other cases.
fn same(one: &Value, other: &Value) -> bool {
    match (number(one), number(other), one, other) {
        (Some(one), Some(other), ..) => one.to_bits() == other.to_bits(),
        (_, _, Value::Array(one), Value::Array(other)) => {
            one.len() == other.len() && one.iter().zip(other).all(|(one, other)| same(one, other))
        }
        _ => alike(one, other),
    }
}

/// Whether an axis of two grids has the same values, be it as a list or as a range.
fn same_axis(key: &str, values: [&Value; 2]) -> bool {
    match values.map(|value| GridAxis::read(key, value, false)) {
        [Ok(one), Ok(other)] => same(&one.values.into(), &other.values.into()),
        _ => false,
    }
}

/// The first key at which two tables differ.
fn first(section: &str, there: &Table, here: &Table) -> Option<String> {
    let keys = there.keys().chain(here.keys().filter(|key| !there.contains_key(*key)));
    let paths = keys.map(|key| {
        (key, if section.is_empty() { key.clone() } else { format!("{section}.{key}") })
    });
    paths.filter(|(_, path)| !FREE.contains(&path.as_str())).find_map(|(key, path)| {
        let empty = Table::new();
        let table = |value: Option<&Value>| {
            value.map_or(Some(empty.clone()), |value| value.as_table().cloned())
        };
        let both = [there.get(key), here.get(key)];
        if let [Some(one), Some(other)] = both
            && (same(one, other) || section == "grid" && same_axis(key, [one, other]))
        {
            return None;
        }
        if let [Some(there), Some(here)] = both.map(table) {
            return first(&path, &there, &here);
        }
        let told = |value: Option<&Value>| {
            value.map_or("not given".to_owned(), |value| shortened(&value.to_string()))
        };
        let [there, here] = both.map(told);
        // Long values are cut.
        let differs = there == here;
        let is = || format!("{path} is {there} there and {here} here");
        Some(if differs { format!("{path} differs") } else { is() })
    })
}

#[cfg(test)]
mod tests {
    use super::super::trial;
    use super::*;
    use crate::study::SweepFile;

    fn told(there: &str, here: &str) -> Option<String> {
        let [there, here] = [there, here].map(|text| text.parse().unwrap());
        first("", &there, &here)
    }

    #[test]
    fn the_first_key_that_differs_is_told() {
        let file =
            "name = \"a\"\n[scene]\nwall = \"fixed\"\n[grid]\nwave_height_ratio = [0.3, 0.4]";
        assert_eq!(told(file, &file.replace("\"a\"", "\"b\"")), None);
        let free = file
            .replace("[grid]", "[numerics]\nerror_bars = \"pair\"\n[limits]\nsteps = 9\n[grid]");
        assert_eq!(told(file, &free), None);
        assert_eq!(told("[scene]\nend_time_s = 3", "[scene]\nend_time_s = 3.0"), None);
        let [long, other] = [0, 1]
            .map(|middle| format!("bed = [{}{middle}{}]", "1, ".repeat(60), ", 1".repeat(60)));
        assert_eq!(told(&long, &other).unwrap(), "bed differs");
        let more = file.replace("0.4]", "0.4, 0.5]");
        let wanted = "grid.wave_height_ratio is [0.3, 0.4] there and [0.3, 0.4, 0.5] here";
        assert_eq!(told(file, &more).unwrap(), wanted);
        // The story: the same grid, written another way, was told in place of what differs.
        let grids =
            ["[0.2, 0.3, 0.4]", "[0.20, 3e-1, 4.0e-1]", "{ from = 0.2, to = 0.4, points = 3 }"];
        let [list, other, range] = grids.map(|grid| format!("[grid]\nwave_height_ratio = {grid}"));
        assert_eq!(
            (told(&list, &other), told("[grid]\na = [0, 1]", "[grid]\na = [0.0, 1.0]")),
            (None, None)
        );
        let linear = range.replace("points = 3", "points = 3, spacing = \"linear\"");
        assert_eq!(told(&range, &linear), None);
        assert_eq!(
            told("[grid]\na = [1, 2]", "[grid]\na = { from = 1, to = 2, points = 2 }"),
            None
        );
        let wanted = "grid.a is [-0.0, 0.2] there and [0.0, 0.2] here";
        assert_eq!(told("[grid]\na = [-0.0, 0.2]", "[grid]\na = [0.0, 0.2]").unwrap(), wanted);
        let longer = file.replace("[grid]", "end_time_s = 3\n[grid]");
        assert_eq!(told(file, &longer).unwrap(), "scene.end_time_s is not given there and 3 here");
        let finer = format!("{file}\n[numerics]\nparticle_spacing_m = 0.01");
        let wanted = "numerics.particle_spacing_m is 0.01 there and not given here";
        assert_eq!(told(&finer, file).unwrap(), wanted);
    }

    /// The story: a setting of this command line was never told, one of the other's in place of what
    /// differed, or one that does not matter.
    #[test]
    fn settings_of_both_command_lines_count_as_if_they_stood_in_the_files() {
        let text = "name = \"a\"\n[scene]\nwall = \"fixed\"\n[grid]\nwave_height_ratio = [0.3]";
        let told = |there: &[&str], here: &[&str]| {
            let root = tempfile::tempdir().unwrap();
            let [then, now] = [there, here].map(|sets| {
                let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
                Study::new(&SweepFile::read(text, &sets).unwrap()).unwrap()
            });
            let sets: Vec<_> = there.iter().map(|set| (*set).to_owned()).collect();
            Manifest::new(root.path(), &then, &sets, trial::SIMD).write(root.path()).unwrap();
            difference(root.path(), &now)
        };
        let [spacing, finer] = [0.02, 0.01].map(|it| format!("numerics.particle_spacing_m={it}"));
        let is = |there, here| {
            Some(format!("numerics.particle_spacing_m is {there} there and {here} here"))
        };
        assert_eq!(told(&[&spacing], &[&finer]), is("0.02", "0.01"));
        assert_eq!(told(&[], &[&finer]), is("not given", "0.01"));
        let set = told(&["limits.steps=9", &spacing], &[]);
        assert_eq!(set, Some(format!("it was made with --set {spacing}")));
        assert_eq!(told(&[&finer], &[&finer]), None);
    }

    #[test]
    fn an_aim_that_is_in_no_file_is_told() {
        let root = tempfile::tempdir().unwrap();
        let study = trial::study("0.2, 0.3");
        let there = Study { max_error_percent: Some(5.0), ..study.clone() };
        Manifest::new(root.path(), &there, &[], trial::SIMD).write(root.path()).unwrap();
        let told = difference(root.path(), &study).unwrap();
        assert_eq!(told, "it was made with --max-error 5, this one without --max-error");
        assert_eq!(difference(root.path(), &there), None);
    }
}
