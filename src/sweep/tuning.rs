//! Numerics that meet a wanted error: the cheapest particle spacing that the stored accuracy table
//! expects to do it, case by case, verified afterwards with the error bars.
//!
//! What counts is the force over the first impact and the displacement, in percent; the table is
//! `results/accuracy/accuracy.csv`, made by `seawall accuracy` from the cases and methods of
//! `sweeps/accuracy.toml`. Only methods that change nothing but the spacing are looked at.

use std::collections::BTreeMap;

use sha2::{Digest, Sha256};

use super::error_bars::ErrorBars;
use super::matrix::Matrix;
use super::record::CaseRecord;
use super::study::Study;
use crate::scene::{CaseConfig, WallChoice};
use crate::simulation::Maximum;

/// Measured errors by spacing: what the program knows about itself.
#[derive(Debug, Clone, PartialEq)]
pub struct AccuracyTable {
    /// By spacing over depth, the coarsest last: cases with their error, percent.
    rungs: Vec<(f64, Vec<Known>)>,
}

#[derive(Debug, Clone, PartialEq)]
struct Known {
    name: String,
    movable: bool,
    wave_height_ratio: f64,
    error_percent: f64,
}

/// A chosen spacing and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Metres.
    pub particle_spacing_m: f64,
    /// The largest measured error of the table's nearest cases, percent.
    pub expected_percent: f64,
    /// Those cases.
    pub because: String,
    /// Whether the table expects the wanted error to be met.
    pub meets: bool,
}

impl AccuracyTable {
    /// The table stored with this program.
    pub fn stored() -> AccuracyTable {
        let matrix = Matrix::read(include_str!("../../sweeps/accuracy.toml"));
        let rows = include_str!("../../results/accuracy/accuracy.csv");
        AccuracyTable::read(&matrix.expect("the shipped matrix is tested"), rows)
    }

    /// Reads `accuracy.csv` with the matrix that it was made from.
    pub fn read(matrix: &Matrix, rows: &str) -> AccuracyTable {
        let spacing = |name: &str| {
            let method = matrix.methods.iter().find(|method| method.name == name)?;
            let only = method.numerics.len() == 1;
            method.numerics.get("particle_spacing_m")?.as_float().filter(|_| only)
        };
        let mut rungs: BTreeMap<u64, (f64, Vec<Known>)> = BTreeMap::new();
        let mut reader = csv::Reader::from_reader(rows.as_bytes());
        for row in reader.records().flatten() {
            let cell = |column: usize| row.get(column).unwrap_or_default();
            let case = matrix.cases.iter().find(|case| case.name == cell(0));
            let Some((case, spacing)) = case.zip(spacing(cell(1))) else { continue };
            let (scene, numerics) = (&case.scene, &case.numerics);
            let Ok(config) = CaseConfig::from_tables(scene, numerics) else { continue };
            let Some(scene) = config.scene.seawall() else { continue };
            let errors = [cell(2), cell(4)].into_iter().filter_map(|e| e.parse::<f64>().ok());
            let Some(error) = errors.map(f64::abs).max_by(f64::total_cmp) else { continue };
            if scene.wave_height_ratio == 0.0 {
                continue;
            }
            let rung = rungs.entry(spacing.to_bits());
            let relative = spacing / scene.still_water_depth_m;
            rung.or_insert((relative, Vec::new())).1.push(Known {
                name: case.name.clone(),
                movable: scene.wall == WallChoice::Movable,
                wave_height_ratio: scene.wave_height_ratio,
                error_percent: error,
            });
        }
        AccuracyTable { rungs: rungs.into_values().collect() }
    }

    /// The coarsest spacing, no coarser than `at_most` of the depth, that is expected to keep the
    /// error within `percent`; the finest where none is.
    pub fn choose(&self, config: &CaseConfig, percent: f64, at_most: f64) -> Option<Choice> {
        let scene = config.scene.seawall()?;
        let choice = |rung: &(f64, Vec<Known>)| {
            let near = nearest(&rung.1, scene.wall == WallChoice::Movable, scene.wave_height_ratio);
            let worst = near.iter().max_by(|a, b| a.error_percent.total_cmp(&b.error_percent))?;
            let names: Vec<_> = near.iter().map(|known| known.name.as_str()).collect();
            Some(Choice {
                particle_spacing_m: rung.0 * scene.still_water_depth_m,
                expected_percent: worst.error_percent,
                because: names.join(", "),
                meets: worst.error_percent <= percent,
            })
        };
        let fitting = self.rungs.iter().filter(|rung| rung.0 <= at_most * (1.0 + 1e-9));
        let choices: Vec<_> = fitting.filter_map(choice).collect();
        let coarsest = choices.iter().rev().find(|choice| choice.meets);
        coarsest.or(choices.first()).or(None).cloned()
    }
}

/// The table's cases of the same kind of wall next below and above in wave height.
fn nearest(known: &[Known], movable: bool, wave: f64) -> Vec<&Known> {
    let kind = || known.iter().filter(move |known| known.movable == movable);
    let order = |a: &&Known, b: &&Known| a.wave_height_ratio.total_cmp(&b.wave_height_ratio);
    let below = kind().filter(|known| known.wave_height_ratio <= wave).max_by(order);
    let above = kind().filter(|known| known.wave_height_ratio >= wave).min_by(order);
    let mut both: Vec<_> = below.into_iter().chain(above).collect();
    both.dedup();
    both
}

/// The larger of the bars of force and displacement, percent of their values.
pub fn bar_percent(record: &CaseRecord, bars: &ErrorBars) -> Option<f64> {
    let outcome = record.outcome.as_ref()?;
    let share = |bar: Option<f64>, value: Option<Maximum>| {
        let value = value?.value;
        (value > 0.0).then_some(100.0 * bar? / value)
    };
    let force = share(bars.force, outcome.first_force_max);
    let displacement = share(bars.displacement, outcome.displacement_max);
    force.into_iter().chain(displacement).max_by(f64::total_cmp)
}

impl Study {
    /// The same cases as a sweep of its own, which aims at an error in percent.
    pub fn aiming_at(mut self, percent: f64) -> Study {
        let digest = Sha256::digest(format!("{} max-error {percent}", self.identity));
        self.identity = digest[..8].iter().map(|byte| format!("{byte:02x}")).collect();
        self
    }

    /// The same sweep with the spacing of every case chosen by `choose`, where it chooses one, and
    /// with a pair of error bars. The sweep keeps its identity through every such choice, so that
    /// its directory takes them all.
    pub fn with_spacings(&self, choose: impl Fn(usize, &CaseConfig) -> Option<f64>) -> Study {
        let mut cases = self.cases.clone();
        for case in &mut cases {
            if let Some(spacing) = choose(case.index, &case.config) {
                case.config.numerics.particle_spacing_m = spacing;
                case.id = super::case::CaseId::of(&case.config);
            }
        }
        let bars = vec![crate::scene::ErrorBars::Pair; cases.len()];
        let (name, keys) = (self.name.clone(), self.keys.clone());
        let study = Study::of(name, keys, cases, &bars, &self.file_text);
        Study { identity: self.identity.clone(), ..study }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn config(wave: f64) -> CaseConfig {
        let scene = format!("wave_height_ratio = {wave:?}").parse().unwrap();
        CaseConfig::from_tables(&scene, &toml::Table::new()).unwrap()
    }

    fn table() -> AccuracyTable {
        let text = r#"
name = "a"
[[case]]
name = "low"
about = ""
scene = { wave_height_ratio = 0.2 }
[[case]]
name = "high"
about = ""
scene = { wave_height_ratio = 0.6 }
[[method]]
name = "coarse"
numerics = { particle_spacing_m = 0.02 }
[[method]]
name = "fine"
numerics = { particle_spacing_m = 0.01 }
[[method]]
name = "other"
numerics = { particle_spacing_m = 0.04, courant_number = 1.0 }
"#;
        let rows = "case,method,f,r,x\nlow,coarse,-1.0,,\nlow,fine,0.5,9.0,\nhigh,coarse,3.0,,\n\
                    high,fine,1.5,,\nlow,other,0.0,,\nall,fine,,,\n";
        AccuracyTable::read(&Matrix::read(text).unwrap(), rows)
    }

    #[test]
    fn the_coarsest_spacing_that_is_good_enough_is_chosen() {
        let choose = |wave, percent| table().choose(&config(wave), percent, 1.0).unwrap();
        let low = choose(0.2, 2.0);
        assert!((low.particle_spacing_m - 0.02).abs() < 1e-12 && low.meets);
        let between = choose(0.4, 2.0);
        assert!((between.particle_spacing_m - 0.01).abs() < 1e-12);
        assert_eq!((between.expected_percent, &*between.because), (1.5, "low, high"));
        assert!(!choose(0.6, 1.0).meets);
        let finer = table().choose(&config(0.2), 2.0, 0.06).unwrap();
        assert!((finer.particle_spacing_m - 0.01).abs() < 1e-12);
    }

    #[test]
    fn choices_keep_the_sweeps_identity() {
        let text = "name = \"a\"\n[grid]\nwave_height_ratio = [0.2, 0.3]";
        let study = Study::new(&crate::sweep::SweepFile::read(text, &[]).unwrap()).unwrap();
        let chosen = study.with_spacings(|index, _| (index == 1).then_some(0.016));
        assert_eq!(chosen.identity, study.identity);
        assert_eq!(chosen.cases[0].id, study.cases[0].id);
        assert_ne!(chosen.cases[1].id, study.cases[1].id);
        assert_eq!(chosen.companions.len(), 2);
    }

    #[test]
    fn the_stored_table_has_rungs() {
        let choice = AccuracyTable::stored().choose(&config(0.4), 5.0, 1.0).unwrap();
        assert!(choice.meets && choice.particle_spacing_m > 0.0, "{choice:?}");
    }
}
