//! Keys that a file gives to cases that do not read them.

use toml::Value;

use super::case::Case;
use super::file::SweepFile;
use crate::keys::{ConfigError, Key, Section, When};
use crate::math::tally::Tally;
use crate::scene::{Kind, Place, numerics_keys, scene_keys};

/// A key that some cases do not read.
#[derive(Debug, Clone, PartialEq)]
pub struct Unread {
    /// The key, its value in the first such case, and what decides that it is not read.
    pub told: ConfigError,
    /// How many cases do not read it.
    pub cases: usize,
}

/// A key that a file gives, and where it is read.
struct Given {
    key: &'static Key,
    when: When,
    place: Place,
    /// Its place in the grid, if it is swept.
    axis: Option<usize>,
}

/// The keys of a file, its grid included, that some of its cases do not read. Values that come from a
/// preset or a default are not given.
pub(super) fn unread(file: &SweepFile, cases: &[Case]) -> Vec<Unread> {
    let given = given(file);
    if given.is_empty() {
        return Vec::new();
    }
    let tell = |case: &Case| {
        let told = given.iter().filter_map(|given| given.unread_by(file, case));
        told.map(|told| (told.key.clone(), told)).collect()
    };
    let counted = Tally::of(cases, tell).counts();
    counted.map(|(told, cases)| Unread { told, cases }).collect()
}

fn given(file: &SweepFile) -> Vec<Given> {
    let Ok(kind) = Kind::of(&file.scene) else { return Vec::new() };
    let swept = |name: &str| file.grid.iter().position(|axis| axis.key == name);
    let given = |place: Place, key: &'static Key| {
        let (when, axis) = (key.rule.read?, swept(key.name));
        // Where the grid sweeps walls, their cases leave out what they do not read.
        let left_out = place == Place::Scene && swept(when.key).is_some();
        let is_given = axis.is_some() || place.table(file).contains_key(key.name);
        (is_given && !left_out).then_some(Given { key, when, place, axis })
    };
    let of_scene = scene_keys(kind).into_iter().filter_map(|key| given(Place::Scene, key));
    let of_numerics = numerics_keys().into_iter().filter_map(|key| given(Place::Numerics, key));
    of_scene.chain(of_numerics).collect()
}

impl Place {
    fn table(self, file: &SweepFile) -> &toml::Table {
        match self {
            Place::Scene => &file.scene,
            Place::Numerics => &file.numerics,
        }
    }
}

impl Given {
    fn unread_by(&self, file: &SweepFile, case: &Case) -> Option<ConfigError> {
        let Given { key, when, place, axis } = self;
        let value = match axis {
            Some(axis) => case.assignments[*axis].as_deref()?,
            None => place.table(file).get(key.name)?,
        };
        let has = match place {
            Place::Scene => case.config.scene.entry(when.key),
            Place::Numerics => case.config.numerics.entry(when.key),
        };
        let decides = has.unwrap_or_else(|| Value::from("none"));
        let section = if axis.is_some() { "grid" } else { place.name() };
        let told = || format!("{} = {decides} does not read it", when.key);
        (!when.has(&decides))
            .then(|| ConfigError::new(&format!("{section}.{}", key.name), value, told()))
    }
}

impl super::Study {
    /// Refuses a swept key that no case reads: its cases would all be equal.
    ///
    /// # Errors
    /// The first such key.
    pub fn refuse_unread_axis(&self) -> Result<(), ConfigError> {
        let all = |unread: &&Unread| unread.cases == self.cases.len();
        let swept = |unread: &&Unread| unread.told.key.starts_with("grid.");
        let Some(unread) = self.unread.iter().filter(all).find(swept) else { return Ok(()) };
        let told = format!("{}, nor does any other case", unread.told.allowed);
        Err(ConfigError::new(&unread.told.key, "", told))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    fn study(text: &str) -> Study {
        Study::new(&SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).unwrap()).unwrap()
    }

    fn told(text: &str) -> Vec<String> {
        let told = |unread: &Unread| format!("{} ({})", unread.told, unread.cases);
        study(text).unread.iter().map(told).collect()
    }

    /// The story: the exponent of a boundary that was not chosen made two equal cases, and nothing was told.
    #[test]
    fn a_key_that_a_case_does_not_read_is_told_with_what_decides() {
        assert_eq!(
            told("[numerics]\nboundary = \"mls-linear\"\n[grid]\nshepard_lambda = [2, 3]"),
            ["grid.shepard_lambda = 2: boundary = \"mls-linear\" does not read it (2)"]
        );
        // The default of a train of waves.
        assert_eq!(
            told(
                "[scene]\npaddle = \"wave-train\"\nwave_period_s = 1.5\nend_time_s = 3\nwave_height_ratio = 0.2\n\
                 [numerics]\nshepard_lambda = 3"
            ),
            ["numerics.shepard_lambda = 3: boundary = \"normalized\" does not read it (1)"]
        );
        assert_eq!(
            told(
                "[numerics]\nshepard_lambda = 3\n[grid]\nboundary = [\"improved-shepard\", \"sfdi\"]"
            ),
            ["numerics.shepard_lambda = 3: boundary = \"sfdi\" does not read it (1)"]
        );
    }

    #[test]
    fn what_is_read_or_comes_from_a_preset_is_not_told() {
        for text in [
            "[numerics]\nshepard_lambda = 3",
            "[numerics]\npreset = \"huang2019\"",
            "[numerics]\npreset = \"isph\"",
            "[numerics]\nboundary = \"sfdi\"\nsfdi_matrix = \"diagonal\"",
            // A grid of walls leaves out what one of them does not read.
            "[scene]\nwall_angle_deg = 90\nspring_stiffness_n_per_m = 9\nseawall_mass_kg_per_m = 50\n\
             [grid]\nwall = [\"fixed\", \"movable\"]",
        ] {
            assert_eq!(told(text), [""; 0], "{text}");
        }
    }

    #[test]
    fn a_grid_over_a_key_that_no_case_reads_is_refused() {
        let refused = |boundaries: &str| {
            study(&format!("[grid]\nboundary = [{boundaries}]\nshepard_lambda = [2, 3]"))
                .refuse_unread_axis()
        };
        assert_eq!(
            refused("\"mls-linear\"").unwrap_err().to_string(),
            "grid.shepard_lambda: boundary = \"mls-linear\" does not read it, nor does any other case"
        );
        assert_eq!(refused("\"mls-linear\", \"improved-shepard\""), Ok(()));
    }
}
