//! Output: a row per case, a history per case.

use std::fs::{self, File};
use std::path::Path;

use anyhow::Result;
use seawall::simulation::Maximum;

use super::cases::Case;
use super::readings::Readings;

/// Columns of the table.
const COLUMNS: [&str; 29] = [
    "wave_height_ratio",
    "spring_stiffness_n_per_m",
    "seawall_mass_kg_per_m",
    "crest_at_1.5_m_over_h",
    "first_force_max",
    "first_force_max_time_s",
    "first_runup_max",
    "first_runup_max_time_s",
    "onset_time_s",
    "displacement_max",
    "displacement_max_time_s",
    "first_displacement_max",
    "first_force_peak",
    "first_runup_peak",
    "force_max",
    "force_max_time_s",
    "runup_max",
    "runup_max_time_s",
    "force_end",
    "runup_end",
    "displacement_end",
    "stops",
    "stop_impulse",
    "first_moment_max",
    "first_moment_max_time_s",
    "volume_error",
    "energy_error",
    "nodes",
    "status",
];

/// The table, written row by row.
pub struct Table(csv::Writer<File>);

impl Table {
    /// With its header.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn create(path: &Path) -> Result<Table> {
        let mut writer = csv::Writer::from_path(path)?;
        writer.write_record(COLUMNS)?;
        writer.flush()?;
        Ok(Table(writer))
    }

    /// A finished case's row.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn write(
        &mut self,
        case: &Case,
        readings: &Readings,
        nodes: usize,
        status: &str,
    ) -> Result<()> {
        let measures = &readings.measures;
        let moved = readings.movable;
        let mut row: Vec<String> = case.parameters().to_vec();
        row.push(number(readings.crest()));
        row.extend(maximum(measures.first_force));
        row.extend(maximum(measures.first_runup));
        row.push(optional(measures.onset));
        row.extend(maximum(measures.displacement));
        row.push(optional(measures.first_displacement.map(|m| m.value)));
        row.push(optional(measures.force_peak()));
        row.push(optional(measures.runup_peak()));
        row.extend(maximum(measures.force));
        row.extend(maximum(measures.runup));
        row.extend([number(measures.last[0]), number(measures.last[1])]);
        row.push(optional(moved.then_some(measures.last[2])));
        row.push(if moved { readings.stops.to_string() } else { String::new() });
        row.push(optional(moved.then_some(readings.stop_impulse)));
        row.extend(maximum(measures.first_moment));
        row.push(format!("{:.1e}", readings.volume_error));
        row.push(format!("{:.1e}", readings.energy_error));
        row.extend([nodes.to_string(), status.to_owned()]);
        self.0.write_record(row)?;
        self.0.flush()?;
        Ok(())
    }
}

/// Writes a case's history into a directory.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_history(directory: &Path, case: &Case, readings: &Readings) -> Result<()> {
    fs::create_dir_all(directory)?;
    let [height, stiffness, mass] = case.parameters();
    let name = match case.spring {
        None => format!("h{height}_fixed.csv"),
        Some(_) => format!("h{height}_k{stiffness}_m{mass}.csv"),
    };
    let mut writer = csv::Writer::from_path(directory.join(name))?;
    writer.write_record(["time_s", "force", "runup", "displacement", "moment"])?;
    for row in &readings.history {
        let [force, runup, displacement, moment] = row.values;
        writer.write_record([row.time, force, runup, displacement, moment].map(number))?;
    }
    writer.flush()?;
    Ok(())
}

/// Six digits after the point; displacements of stiff walls need more.
fn number(value: f64) -> String {
    if value != 0.0 && value.abs() < 0.01 { format!("{value:.5e}") } else { format!("{value:.6}") }
}

fn optional(value: Option<f64>) -> String {
    value.map_or(String::new(), number)
}

fn maximum(value: Option<Maximum>) -> [String; 2] {
    [optional(value.map(|m| m.value)), optional(value.map(|m| m.time_s))]
}
