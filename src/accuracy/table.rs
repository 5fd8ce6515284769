//! The program's own accuracy: finds the cheapest numerics that a table of measured errors expects
//! to meet a wanted error.
//!
//! Only the force over the first impact and the displacement count, in percent. The table is
//! `data/accuracy.csv`, which is part of this program. `scripts/accuracy` makes it from the cases
//! and methods of `sweeps/accuracy.toml`.
//!
//! Only some of these methods can be chosen: those of the default scheme that set nothing but the
//! spacing and the precision. Others may be good by chance in the one or two cases that count.
//! Error bars are only proven for the default scheme.

use toml::Table;

use super::matrix::Matrix;
use crate::quantities::accuracy::Line;
use crate::scene::CaseConfig;

/// Keys that a method may set, besides the spacing, to be chosen.
const CHOSEN: [&str; 1] = ["precision"];

/// Measured errors and costs by method.
#[derive(Debug, Clone, PartialEq)]
pub struct AccuracyTable {
    cases: Vec<Known>,
    methods: Vec<Recipe>,
}

#[derive(Debug, Clone, PartialEq)]
struct Known {
    name: String,
    movable: bool,
    wave_height_ratio: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Recipe {
    name: String,
    /// Spacing over depth.
    spacing: f64,
    /// Other keys that it sets.
    numerics: Table,
    /// By the number of the case: error of force and displacement, percent, and processor seconds.
    measured: Vec<Option<(f64, f64)>>,
}

/// Chosen numerics, and the reason.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The case with them.
    pub config: CaseConfig,
    /// Name of the method.
    pub method: String,
    /// The largest measured error of the table's nearest cases, percent.
    pub expected_percent: f64,
    /// Their total cost, processor seconds.
    pub cost_s: f64,
    /// Those cases.
    pub because: String,
    /// Whether the table expects the wanted error to be met.
    pub meets: bool,
}

impl AccuracyTable {
    /// The table stored with this program.
    pub fn stored() -> AccuracyTable {
        let matrix = Matrix::read(include_str!("../../sweeps/accuracy.toml"));
        let rows = include_str!("../../data/accuracy.csv");
        AccuracyTable::read(&matrix.expect("the shipped matrix is tested"), rows)
    }

    /// Reads `accuracy.csv` with the matrix from which it was made.
    pub fn read(matrix: &Matrix, rows: &str) -> AccuracyTable {
        let mut depths = Vec::new();
        let mut cases = Vec::new();
        for case in &matrix.cases {
            let Ok(config) = CaseConfig::from_tables(&case.scene, &case.numerics) else { continue };
            let Some(scene) = config.scene.seawall() else { continue };
            if scene.wave_height_ratio > 0.0 {
                depths.push(scene.still_water_depth_m);
                cases.push(Known {
                    name: case.name.clone(),
                    movable: scene.wall.moves(),
                    wave_height_ratio: scene.wave_height_ratio,
                });
            }
        }
        let depth = depths.first().copied().unwrap_or(1.0);
        let recipe = |method: &super::matrix::Method| {
            let mut numerics = method.numerics.clone();
            let spacing = numerics.remove("particle_spacing_m")?.as_float()? / depth;
            if !numerics.keys().all(|key| CHOSEN.contains(&key.as_str())) {
                return None;
            }
            let measured = vec![None; cases.len()];
            Some(Recipe { name: method.name.clone(), spacing, numerics, measured })
        };
        let mut methods: Vec<Recipe> = matrix.methods.iter().filter_map(recipe).collect();
        let mut reader = csv::Reader::from_reader(rows.as_bytes());
        for row in reader.deserialize::<Line>().flatten() {
            let case = cases.iter().position(|case| case.name == row.case);
            let method = methods.iter_mut().find(|method| method.name == row.method);
            let Some((case, method)) = case.zip(method) else { continue };
            let errors = [row.force_error_percent, row.displacement_error_percent];
            let error = errors.into_iter().flatten().map(f64::abs).max_by(f64::total_cmp);
            method.measured[case] = error.zip(row.cpu_time_s);
        }
        AccuracyTable { cases, methods }
    }

    /// The cheapest method that is expected to keep the error within `percent`, with a spacing of
    /// at most `at_most` of the depth. If there is none, it is the most accurate. A method that
    /// sets a key in `swept`, or one that the case has set, is not used.
    pub fn choose(
        &self,
        config: &CaseConfig,
        percent: f64,
        at_most: f64,
        swept: &[String],
    ) -> Option<Choice> {
        let scene = config.scene.seawall()?;
        let near = self.nearest(scene.wall.moves(), scene.wave_height_ratio);
        let names: Vec<_> = near.iter().map(|&case| self.cases[case].name.as_str()).collect();
        let choice = |method: &Recipe| {
            let results = near.iter().map(|&case| method.measured[case]);
            let results = results.collect::<Option<Vec<(f64, f64)>>>()?;
            let worst = results.iter().map(|result| result.0).max_by(f64::total_cmp)?;
            Some(Choice {
                config: method.applied(config, scene.still_water_depth_m, swept)?,
                method: method.name.clone(),
                expected_percent: worst,
                cost_s: results.iter().map(|result| result.1).sum(),
                because: names.join(", "),
                meets: worst <= percent,
            })
        };
        let fitting = self.methods.iter().filter(|one| one.spacing <= at_most * (1.0 + 1e-9));
        let choices: Vec<_> = fitting.filter_map(choice).collect();
        let good = choices.iter().filter(|choice| choice.meets);
        let cheapest = good.min_by(|a, b| a.cost_s.total_cmp(&b.cost_s));
        let best =
            || choices.iter().min_by(|a, b| a.expected_percent.total_cmp(&b.expected_percent));
        cheapest.or_else(best).cloned()
    }

    /// The table's cases of the same kind of wall next below and above in wave height.
    fn nearest(&self, movable: bool, wave: f64) -> Vec<usize> {
        let of_kind = |&case: &usize| self.cases[case].movable == movable;
        let height = |case: usize| self.cases[case].wave_height_ratio;
        let order = |a: &usize, b: &usize| height(*a).total_cmp(&height(*b));
        let all = || (0..self.cases.len()).filter(of_kind);
        let below = all().filter(|&case| height(case) <= wave).max_by(order);
        let above = all().filter(|&case| height(case) >= wave).min_by(order);
        let mut both: Vec<_> = below.into_iter().chain(above).collect();
        both.dedup();
        both
    }
}

impl Recipe {
    /// A case with this method's numerics. `None` if they would override the case's file, or the
    /// case cannot take them.
    fn applied(&self, config: &CaseConfig, depth: f64, swept: &[String]) -> Option<CaseConfig> {
        let mut numerics = config.numerics_of_its_own();
        for (key, value) in &self.numerics {
            if swept.contains(key) || numerics.contains_key(key) {
                return None;
            }
            numerics.insert(key.clone(), value.clone());
        }
        numerics.insert("particle_spacing_m".to_owned(), (self.spacing * depth).into());
        let scene = Table::try_from(&config.scene).ok()?;
        let read = CaseConfig::from_tables(&scene, &numerics).ok()?;
        Some(CaseConfig { numerics: read.numerics, ..config.clone() })
    }
}

/// The numerics of a case that differ from its scene's defaults, in words: `particle_spacing_m =
/// 0.02, ...`.
pub fn differences(config: &CaseConfig) -> String {
    let word =
        |value: &toml::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let own = config.numerics_of_its_own();
    own.iter().map(|(key, value)| format!("{key} = {}", word(value))).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests;
