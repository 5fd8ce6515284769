//! The list of cases: from the command line, from a table, from the grid of a sweep file.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use serde::Deserialize;

use super::law::Spring;

/// One wave at one wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    /// H/h of the paddle's law.
    pub wave_height_ratio: f64,
    /// `None`: a fixed wall.
    pub spring: Option<Spring>,
}

impl Case {
    /// A fixed wall.
    pub fn fixed(wave_height_ratio: f64) -> Case {
        Case { wave_height_ratio, spring: None }
    }

    /// The three parameters as they stand in tables.
    pub fn parameters(&self) -> [String; 3] {
        let told =
            |of: fn(&Spring) -> f64| self.spring.map_or(String::new(), |s| of(&s).to_string());
        [self.wave_height_ratio.to_string(), told(|s| s.stiffness), told(|s| s.mass)]
    }
}

#[derive(Deserialize)]
struct Line {
    wave_height_ratio: f64,
    spring_stiffness_n_per_m: Option<f64>,
    seawall_mass_kg_per_m: Option<f64>,
}

/// Cases of a table with the columns wave_height_ratio, spring_stiffness_n_per_m and
/// seawall_mass_kg_per_m; the last two are empty for fixed walls.
///
/// # Errors
/// Where the file cannot be read.
pub fn of_table(path: &Path) -> Result<Vec<Case>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let mut cases = Vec::new();
    for line in reader.deserialize() {
        let line: Line = line.with_context(|| format!("in {}", path.display()))?;
        let pair = line.seawall_mass_kg_per_m.zip(line.spring_stiffness_n_per_m);
        let spring = pair.map(|(mass, stiffness)| Spring { mass, stiffness });
        cases.push(Case { wave_height_ratio: line.wave_height_ratio, spring });
    }
    Ok(cases)
}

#[derive(Deserialize)]
struct Sweep {
    grid: Grid,
}

#[derive(Deserialize)]
struct Grid {
    wave_height_ratio: Vec<f64>,
    spring_stiffness_n_per_m: Vec<f64>,
    seawall_mass_kg_per_m: Vec<f64>,
}

/// Every combination of a sweep file's grid, the last parameter fastest.
///
/// # Errors
/// Where the file cannot be read.
pub fn of_sweep(path: &Path) -> Result<Vec<Case>> {
    let text =
        fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let Sweep { grid } = toml::from_str(&text).with_context(|| format!("in {}", path.display()))?;
    let mut cases = Vec::new();
    for &wave_height_ratio in &grid.wave_height_ratio {
        for &stiffness in &grid.spring_stiffness_n_per_m {
            for &mass in &grid.seawall_mass_kg_per_m {
                let spring = Some(Spring { mass, stiffness });
                cases.push(Case { wave_height_ratio, spring });
            }
        }
    }
    Ok(cases)
}
