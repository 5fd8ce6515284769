//! One case of a sweep file as a scene file of its own.

use toml::{Table, Value};

use super::case::Case;
use super::file::SweepFile;
use super::{grid, limits};
use crate::keys::Section;
use crate::scene::{CaseConfig, ConfigError, Place};

/// Digits of a case's id in the name of its own file.
const DIGITS: usize = 8;

impl SweepFile {
    /// A case of this file as the text of a scene file for `seawall run`. It has all settings of
    /// this file with its limits, the values of the swept keys, and the numerics that were chosen
    /// for the case.
    ///
    /// # Errors
    /// A swept key that no section knows.
    pub fn single(&self, case: &Case) -> Result<String, ConfigError> {
        let (scene, mut numerics) = grid::tables(self, &case.assignments)?;
        // Repeated after a change, because some defaults follow the particle spacing.
        loop {
            let plain = CaseConfig::with_probes(&scene, &numerics, &self.probes)?.numerics.table();
            let mut chosen = case.config.numerics.table();
            chosen.retain(|key, value| plain.get(key) != Some(&*value) && key != "error_bars");
            if chosen.is_empty() {
                break;
            }
            numerics.extend(chosen);
        }
        let id = case.id.to_string();
        let mut file = Table::new();
        file.insert("name".to_owned(), format!("{}-{}", self.name, &id[..DIGITS]).into());
        for (place, table) in [(Place::Scene, scene), (Place::Numerics, numerics)] {
            if !table.is_empty() {
                file.insert(place.name().to_owned(), Value::Table(table));
            }
        }
        if !self.probes.is_empty() {
            let probes = self.probes.iter().cloned().map(Value::Table);
            file.insert("probe".to_owned(), Value::Array(probes.collect()));
        }
        let limits = limits::table(&self.limits);
        if !limits.is_empty() {
            file.insert("limits".to_owned(), Value::Table(limits));
        }
        Ok(file.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{CaseId, Study};

    #[test]
    fn the_file_of_a_case_is_that_case() {
        let text = "name = \"a\"\n[scene]\nseawall_mass_kg_per_m = 50\n\
            [numerics]\npreset = \"huang2019\"\nerror_bars = \"pair\"\n\
            [grid]\nwall = [\"fixed\", \"movable\"]\nspring_stiffness_n_per_m = [1, 21544.3469003188]\n\
            particle_spacing_m = [0.02, 0.025]\n\
            [[probe]]\nname = \"P1\"\nkind = \"level\"\nx_m = 1";
        let file = SweepFile::read(text, &[]).unwrap();
        let study = Study::new(&file).unwrap();
        assert_eq!(study.cases.len(), 2 + 4);
        for case in &study.cases {
            let text = file.single(case).unwrap();
            let single = SweepFile::read(&text, &[]).unwrap();
            let read = Study::new(&single).unwrap();
            assert_eq!(read.cases.len(), 1);
            assert_eq!(read.cases[0].id, case.id, "{text}");
            assert_eq!(read.companions.len(), 1);
            assert!(read.name.starts_with("a-"), "{text}");
        }
    }

    /// `run FILE KEY=VALUE` once ran a case of a file with `[limits]` without limits.
    #[test]
    fn limits_of_a_study_hold_for_its_cases_alone_too() {
        let of = |limits: &str| {
            let text = format!("name = \"a\"\n{limits}[grid]\nwave_height_ratio = [0.2, 0.3]");
            let file = SweepFile::read(&text, &[]).unwrap();
            let case = Study::new(&file).unwrap().cases.remove(1);
            file.single(&case).unwrap()
        };
        let limited = of("[limits]\nsteps = 700\nmemory_mib = 64\n");
        let limits = SweepFile::read(&limited, &[]).unwrap().limits;
        assert_eq!(
            (limits.steps, limits.memory_mib, limits.wall_time_s),
            (Some(700), Some(64.0), None)
        );
        assert!(!of("").contains("limits"));
    }

    #[test]
    fn numerics_that_were_chosen_for_a_case_are_in_its_file() {
        let text = "name = \"a\"\n[numerics]\nerror_bars = \"pair\"\n[grid]\nwave_height_ratio = [0.2, 0.3]";
        let file = SweepFile::read(text, &[]).unwrap();
        let mut case = Study::new(&file).unwrap().cases.remove(1);
        case.config.numerics.particle_spacing_m = 0.016;
        case.config.numerics.courant_number = 1.0;
        case.id = CaseId::of(&case.config);
        let text = file.single(&case).unwrap();
        let read = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
        assert_eq!(read.cases[0].id, case.id, "{text}");
        assert!(!text.contains("kernel"), "{text}");
    }
}
