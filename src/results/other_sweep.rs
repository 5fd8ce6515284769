//! The difference between the study of a directory and another one, for users who have edited a
//! file and want to go on.

use std::path::Path;

use toml::{Table, Value};

use super::manifest::Manifest;
use crate::keys::brief;
use crate::study::{PHYSICS_VERSION, Study};

/// The first difference in words: the physics version, a key of the two files, or a setting of the
/// command line there. `None` if none of these differs.
pub(super) fn difference(directory: &Path, study: &Study) -> Option<String> {
    let there = Manifest::read(directory)?;
    if there.physics_version != PHYSICS_VERSION {
        let version = there.physics_version;
        return Some(format!(
            "it is of physics version {version}, this program of {PHYSICS_VERSION}"
        ));
    }
    let files = [&there.sweep_file, &study.file_text].map(|text| text.parse::<Table>());
    let in_files = match &files {
        [Ok(before), Ok(here)] => first("", before, here),
        _ => None,
    };
    // Settings that are in no file.
    let sets: Vec<_> = there.overrides.iter().map(|set| format!("--set {}", brief(set))).collect();
    let set = (!sets.is_empty()).then(|| format!("it was made with {}", sets.join(" ")));
    in_files.or(set)
}

/// Keys that are not part of a study's identity.
const FREE: [&str; 4] = ["name", "limits", "accuracy", "numerics.error_bars"];

/// Whether two values are equal: 1 is 1.0.
fn same([one, other]: [Option<&Value>; 2]) -> bool {
    let number = |value: Option<&Value>| crate::keys::number(value?);
    one == other || number(one).is_some_and(|value| number(other) == Some(value))
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
        if same(both) {
            return None;
        }
        if let [Some(there), Some(here)] = both.map(table) {
            return first(&path, &there, &here);
        }
        let told = |value: Option<&Value>| {
            value.map_or("not given".to_owned(), |value| brief(&value.to_string()))
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
    use super::*;

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
        let longer = file.replace("[grid]", "end_time_s = 3\n[grid]");
        assert_eq!(told(file, &longer).unwrap(), "scene.end_time_s is not given there and 3 here");
        let finer = format!("{file}\n[numerics]\nparticle_spacing_m = 0.01");
        let wanted = "numerics.particle_spacing_m is 0.01 there and not given here";
        assert_eq!(told(&finer, file).unwrap(), wanted);
    }
}
