//! From a sweep file to its cases: the cartesian product, in the order of the file.

use std::collections::HashSet;
use std::collections::hash_map::Entry;
use std::sync::LazyLock;

use rayon::prelude::*;
use toml::{Table, Value};

use super::axis::{GridAxis, MOST_CASES};
use super::case::{Assignments, Case, CaseId};
use super::case_map::CaseMap;
use super::file::SweepFile;
use crate::keys::{Key, Recent, Section, Shared, When};
use crate::scene::{CaseConfig, ConfigError, Place, SeawallScene, place_of};

/// This many cases are validated at once.
const BLOCK: usize = 4096;

/// All cases of a file, each validated; one case without a grid.
pub(super) fn expand(file: &SweepFile) -> Result<Vec<Case>, ConfigError> {
    let places = places(file)?;
    let count = file.grid.iter().try_fold(1_usize, |count, axis| {
        count.checked_mul(axis.values.len()).filter(|&count| count <= MOST_CASES)
    });
    let Some(count) = count else {
        let sizes: Vec<_> = file.grid.iter().map(|axis| axis.values.len().to_string()).collect();
        let allowed = format!("must have at most {MOST_CASES} cases");
        return Err(ConfigError::new("grid", sizes.join(" x "), allowed));
    };
    let shared = |axis: &GridAxis| axis.values.iter().cloned().map(Shared::from).collect();
    let values: Vec<Vec<_>> = file.grid.iter().map(shared).collect();
    if plays_several_heights(file) {
        point(file, &places, &values, 0)?;
        let allowed =
            "changes no wave: a recorded stroke makes its own. Sweep recorded_stroke instead";
        return Err(ConfigError::new("grid.wave_height_ratio", "", allowed));
    }
    let mut cases: Vec<Case> = Vec::with_capacity(count);
    let mut seen = CaseMap::with_capacity_and_hasher(count, Default::default());
    let mut numerics = Recent::default();
    let mut add = |point: Result<(Case, bool), ConfigError>| {
        let (mut case, collapsed) = point?;
        numerics.share(&mut case.config.numerics);
        match seen.entry(case.id) {
            Entry::Vacant(place) => {
                place.insert(cases.len());
                cases.push(Case { index: cases.len(), ..case });
                Ok(())
            }
            Entry::Occupied(_) if collapsed => Ok(()),
            Entry::Occupied(earlier) => {
                let earlier = describe(file, &cases[*earlier.get()].assignments);
                let allowed = format!("is the same case as {earlier}");
                Err(ConfigError::new("grid", describe(file, &case.assignments), allowed))
            }
        }
    };
    // Block by block: cases that do not yet share their numerics take twice the memory.
    let block = |first: usize| -> Vec<_> {
        let block = (first..count.min(first + BLOCK)).into_par_iter();
        block.map(|index| point(file, &places, &values, index)).collect()
    };
    let mut points = block(0);
    for first in (0..count).step_by(BLOCK) {
        // The next block is made while this one is added.
        let (added, next) =
            rayon::join(|| points.into_iter().try_for_each(&mut add), || block(first + BLOCK));
        added?;
        points = next;
    }
    Ok(cases)
}

/// Whether the height of a wave is swept that a recorded stroke makes.
fn plays_several_heights(file: &SweepFile) -> bool {
    let heights = |axis: &GridAxis| axis.key == "wave_height_ratio" && axis.values.len() > 1;
    file.scene.get("paddle").and_then(Value::as_str) == Some("recorded-stroke")
        && file.grid.iter().any(heights)
}

/// The section of each swept key. The key itself does not name it.
fn places(file: &SweepFile) -> Result<Vec<Place>, ConfigError> {
    let place = |axis: &GridAxis| {
        let place = place_of(&axis.key, &file.scene)?;
        let table = match place {
            Place::Scene => &file.scene,
            Place::Numerics => &file.numerics,
        };
        let Some(value) = table.get(&axis.key) else { return Ok(place) };
        let path = format!("{}.{}", place.name(), axis.key);
        let allowed = format!(
            "stands in [{}] and in [grid], which sweeps it: leave one of the two out",
            place.name()
        );
        Err(ConfigError::new(&path, value, allowed))
    };
    file.grid.iter().map(place).collect()
}

/// The sections of a file with the values of its swept keys.
fn filled(
    file: &SweepFile,
    places: &[Place],
    assignments: &[Option<Shared<Value>>],
) -> (Table, Table) {
    let (mut scene, mut numerics) = (file.scene.clone(), file.numerics.clone());
    for (place, (axis, value)) in places.iter().zip(file.grid.iter().zip(assignments)) {
        let table = match place {
            Place::Scene => &mut scene,
            Place::Numerics => &mut numerics,
        };
        table.extend(value.as_ref().map(|value| (axis.key.clone(), Value::clone(value))));
    }
    (scene, numerics)
}

/// The `[scene]` and `[numerics]` of a case with these values of the swept keys.
pub(super) fn tables(
    file: &SweepFile,
    assignments: &[Option<Shared<Value>>],
) -> Result<(Table, Table), ConfigError> {
    let (mut scene, numerics) = filled(file, &places(file)?, assignments);
    drop_meaningless(file, &mut scene, &mut assignments.to_vec());
    Ok((scene, numerics))
}

/// The case with these values of the swept keys, without its index.
pub(super) fn case_at(
    file: &SweepFile,
    assignments: &[Option<Shared<Value>>],
) -> Result<Case, ConfigError> {
    at(file, &places(file)?, assignments.to_vec(), usize::MAX).map(|(case, _)| case)
}

/// One point of the grid; true if some swept key meant nothing to it.
fn point(
    file: &SweepFile,
    places: &[Place],
    values: &[Vec<Shared<Value>>],
    index: usize,
) -> Result<(Case, bool), ConfigError> {
    let mut assignments = vec![None; values.len()];
    let mut rest = index;
    for (place, values) in values.iter().enumerate().rev() {
        assignments[place] = Some(values[rest % values.len()].clone());
        rest /= values.len();
    }
    at(file, places, assignments, index)
}

/// The case with some values.
fn at(
    file: &SweepFile,
    places: &[Place],
    mut assignments: Assignments,
    index: usize,
) -> Result<(Case, bool), ConfigError> {
    let (mut scene, numerics) = filled(file, places, &assignments);
    let collapsed = drop_meaningless(file, &mut scene, &mut assignments);
    let config = CaseConfig::with_probes(&scene, &numerics, &file.probes)
        .map_err(|error| blame_axis(file, places, error))?;
    Ok((Case { index, id: CaseId::of(&config), config, assignments }, collapsed))
}

/// The keys that decide which other keys a seawall has.
static DECIDING: LazyLock<HashSet<&str>> = LazyLock::new(|| {
    SeawallScene::keys().into_iter().flat_map(Key::conditions).map(|when| when.key).collect()
});

/// If a grid sweeps walls or paddles, leaves out the keys that one of them does not have.
fn drop_meaningless(
    file: &SweepFile,
    scene: &mut Table,
    assignments: &mut [Option<Shared<Value>>],
) -> bool {
    let swept = |when: &When| file.grid.iter().any(|axis| axis.key == when.key);
    if !file.grid.iter().any(|axis| DECIDING.contains(&*axis.key)) {
        return false;
    }
    let fits = |key: &&Key| key.conditions().all(|when| !swept(&when) || when.holds(scene));
    let foreign: Vec<_> = SeawallScene::keys().into_iter().filter(|key| !fits(key)).collect();
    let mut dropped = false;
    for key in foreign {
        scene.remove(key.name);
        if let Some(place) = file.grid.iter().position(|axis| axis.key == key.name) {
            assignments[place] = None;
            dropped = true;
        }
    }
    dropped
}

/// The error of a swept key names its place in `[grid]`.
fn blame_axis(file: &SweepFile, places: &[Place], error: ConfigError) -> ConfigError {
    let (section, leaf) = error.key.rsplit_once('.').unwrap_or_default();
    let mut swept = file.grid.iter().zip(places);
    if swept.any(|(axis, place)| axis.key == leaf && place.name() == section) {
        return ConfigError::new(&format!("grid.{leaf}"), error.value, error.allowed);
    }
    error
}

fn describe(file: &SweepFile, assignments: &[Option<Shared<Value>>]) -> String {
    let pairs = file.grid.iter().zip(assignments);
    let set =
        pairs.filter_map(|(axis, value)| Some(format!("{} = {}", axis.key, **value.as_ref()?)));
    set.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;
