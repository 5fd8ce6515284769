//! From a sweep file to its cases: the cartesian product, in the order of the file.

use std::collections::HashMap;

use rayon::prelude::*;
use toml::{Table, Value};

use super::axis::{GridAxis, MOST_CASES};
use super::case::{Assignments, Case, CaseId};
use super::file::SweepFile;
use crate::keys::{Key, Recent, Section, Shared, When};
use crate::scene::{CaseConfig, ConfigError, Place, SeawallScene, place_of};

/// So many cases are validated in one go.
const BLOCK: usize = 4096;

/// All cases of a file, each validated; one case where there is no grid.
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
    let mut cases: Vec<Case> = Vec::with_capacity(count);
    let mut seen = HashMap::with_capacity(count);
    let mut numerics = Recent::default();
    // Block by block: cases that do not share their numerics yet take twice the memory.
    let blocks = (0..count).step_by(BLOCK).map(|first| first..count.min(first + BLOCK));
    let points = blocks.flat_map(|block| {
        let points = block.into_par_iter().map(|index| point(file, &places, &values, index));
        points.collect::<Vec<_>>()
    });
    for point in points {
        let (mut case, collapsed) = point?;
        numerics.share(&mut case.config.numerics);
        if let Some(&earlier) = seen.get(&case.id) {
            if collapsed {
                continue;
            }
            let earlier: &Case = &cases[earlier];
            let allowed = format!("is the same case as {}", describe(file, &earlier.assignments));
            return Err(ConfigError::new("grid", describe(file, &case.assignments), allowed));
        }
        seen.insert(case.id, cases.len());
        cases.push(Case { index: cases.len(), ..case });
    }
    Ok(cases)
}

/// The section of each swept key, which does not name the key itself.
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

/// The case with these values of the swept keys, without its place among others.
pub(super) fn case_at(
    file: &SweepFile,
    assignments: &[Option<Shared<Value>>],
) -> Result<Case, ConfigError> {
    at(file, &places(file)?, assignments.to_vec(), usize::MAX).map(|(case, _)| case)
}

/// One point of the grid; true where some swept key meant nothing to it.
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

/// Where a grid sweeps walls or paddles, leaves out what one of them does not have.
fn drop_meaningless(
    file: &SweepFile,
    scene: &mut Table,
    assignments: &mut [Option<Shared<Value>>],
) -> bool {
    let swept = |when: &When| file.grid.iter().any(|axis| axis.key == when.key);
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

/// An error about a swept key is told by its place in `[grid]`.
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
mod tests {
    use super::*;

    fn cases(text: &str) -> Result<Vec<Case>, ConfigError> {
        expand(&SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).unwrap())
    }

    #[test]
    fn the_last_axis_runs_fastest() {
        let cases = cases(
            "[grid]\nwave_height_ratio = [0.2, 0.3]\nparticle_spacing_m = [0.01, 0.02, 0.04]",
        )
        .unwrap();
        let spacings: Vec<_> =
            cases.iter().map(|case| case.config.numerics.particle_spacing_m).collect();
        assert_eq!(spacings, [0.01, 0.02, 0.04, 0.01, 0.02, 0.04]);
        assert_eq!(cases[3].index, 3);
        assert_eq!(cases[3].assignments[0], Some(Value::Float(0.3).into()));
    }

    #[test]
    fn fixed_walls_among_movable_ones_stand_once() {
        let cases = cases(
            "[scene]\nseawall_mass_kg_per_m = 50\n\
             [grid]\nwall = [\"fixed\", \"movable\"]\nspring_stiffness_n_per_m = [1, 10, 100]",
        )
        .unwrap();
        assert_eq!(cases.len(), 1 + 3);
        assert_eq!(cases[0].assignments, [Some(Value::String("fixed".into()).into()), None]);
        assert_eq!(cases[1].index, 1);
    }

    #[test]
    fn every_wall_and_every_paddle_takes_its_own_keys() {
        let walls = cases(
            "[scene]\nseawall_mass_kg_per_m = 50\nspring_stiffness_n_per_m = 1\n\
             static_friction = 0.6\nkinetic_friction = 0.5\nsubmerged_weight_n_per_m = 300\n\
             [grid]\nwall = [\"fixed\", \"movable\", \"caisson\"]\nthreshold_ratio = [1.1, 1.2]",
        );
        assert_eq!(walls.unwrap().len(), 2 + 2 + 1);
        let paddles = cases(
            "[scene]\nend_time_s = 1\n\
             [grid]\npaddle = [\"solitary\", \"wave-train\"]\nwave_period_s = [0.9, 1]",
        );
        assert_eq!(paddles.unwrap().len(), 1 + 2);
    }

    #[test]
    fn every_bad_grid_is_told_with_its_key() {
        let bad = [
            ("[grid]\nwave_height_ratio = [0.2, 1.5]", "grid.wave_height_ratio = 1.5: must be"),
            ("[grid]\nkernal = [\"gaussian\"]", "grid.kernal: unknown key; did you mean kernel?"),
            (
                "[grid]\nkernel = [\"gauss\"]",
                "grid.kernel = \"gauss\": must be one of wendland-c2, ",
            ),
            (
                "[grid]\nparticle_spacing_m = [0.02, 1e-5]",
                "grid.particle_spacing_m = 0.00001: would cut 0.5 m² of water into 5,000,000,000",
            ),
            (
                "[grid]\nspring_stiffness_n_per_m = [1]",
                "grid.spring_stiffness_n_per_m = 1: belongs to wall = \"movable\"",
            ),
            (
                "[scene]\nwave_height_ratio = 0.3\n[grid]\nwave_height_ratio = [0.2]",
                "scene.wave_height_ratio = 0.3: stands in [scene] and in [grid], which sweeps it",
            ),
            (
                "[numerics]\nkernel = \"gaussian\"\n[grid]\nkernel = [\"gaussian\"]",
                "numerics.kernel = \"gaussian\": stands in [numerics] and in [grid]",
            ),
            (
                "[scene]\nseawall_mass = 1\n[grid]\nwave_height_ratio = [0.2]",
                "scene.seawall_mass: unknown key; did you mean seawall_mass_kg_per_m?",
            ),
            (
                "[numerics]\nwave_height_ratio = 0.4\n[grid]\nwave_height_ratio = [0.2]",
                "numerics.wave_height_ratio: unknown key; did you mean scene.wave_height_ratio?",
            ),
            (
                "[grid]\nwave_height_ratio = { from = 0.1, to = 0.7, points = 1001 }\n\
                 artificial_viscosity = { from = 0, to = 1, points = 1000 }",
                "grid = 1001 x 1000: must have at most 1000000 cases",
            ),
        ];
        for (text, message) in bad {
            let told = cases(text).unwrap_err().to_string();
            assert!(told.starts_with(message), "{told:?} should start with {message:?}");
        }
    }
}
