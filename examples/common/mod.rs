//! What the examples that compare share: rows of tables, which of them are the same case, and how far
//! readings are from theory.
#![allow(dead_code)] // Each example takes a part.

use std::collections::HashMap;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result};

/// What tells which case of a reference a row is.
pub const KEYS: [&str; 3] =
    ["wave_height_ratio", "spring_stiffness_n_per_m", "seawall_mass_kg_per_m"];

/// Cells by the names of their columns.
pub type Row = HashMap<String, String>;

/// A cell that holds a number.
pub fn number(row: &Row, column: &str) -> Option<f64> {
    row.get(column)?.parse().ok()
}

/// A cell, empty where there is none.
pub fn text<'a>(row: &'a Row, column: &str) -> &'a str {
    row.get(column).map_or("", String::as_str)
}

/// The row of a table that is of the same case.
pub fn beside<'a>(row: &Row, table: &'a [Row]) -> Option<&'a Row> {
    let same = |other: &&Row| KEYS.iter().all(|key| number(row, key) == number(other, key));
    table.iter().find(same)
}

/// The rows of a table whose comments start with `#`.
pub fn read(path: &Path) -> Result<Vec<Row>> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let rows = reader.deserialize().collect::<Result<Vec<Row>, _>>();
    rows.with_context(|| format!("cannot read {}", path.display()))
}

/// The rows of the summaries of finished sweeps.
pub fn summaries(directories: &[impl AsRef<Path>]) -> Result<Vec<Row>> {
    let read = |directory: &_| read(&AsRef::<Path>::as_ref(directory).join("summary.csv"));
    Ok(directories.iter().map(read).collect::<Result<Vec<_>>>()?.concat())
}

/// A reading that theory knows, too.
#[derive(Debug, Clone, Copy)]
pub struct Compared {
    /// Its column in our summaries.
    pub ours: &'static str,
    /// Its column in the tables of theory.
    pub theirs: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The unit of its error: `%` of the truth, or `h`.
    pub unit: &'static str,
}

const fn compared(
    ours: &'static str,
    theirs: &'static str,
    name: &'static str,
    unit: &'static str,
) -> Compared {
    Compared { ours, theirs, name, unit }
}

/// Crest, first force, first runup and displacement.
pub const COMPARED: [Compared; 4] = [
    compared("measured_wave_height_ratio", "crest_at_1.5_m_over_h", "crest", "%"),
    compared("first_force_max", "first_force_max", "first F*", "%"),
    compared("first_runup_max", "first_runup_max", "first R*", "h"),
    compared("displacement_max", "displacement_max", "largest X*", "%"),
];
/// The moment, which has no error bar.
pub const MOMENT: Compared = compared("first_moment_max", "first_moment_max", "first M*", "%");
/// Places among [`COMPARED`].
pub const CREST: usize = 0;
pub const FORCE: usize = 1;
pub const RUNUP: usize = 2;
pub const DISPLACEMENT: usize = 3;

impl Compared {
    /// A difference of values in the unit of errors.
    pub fn scaled(&self, difference: f64, truth: f64) -> f64 {
        if self.unit == "h" { difference } else { 100.0 * difference / truth }
    }

    /// Our value and theory's.
    pub fn values(&self, row: &Row, truth: &Row) -> Option<[f64; 2]> {
        Some([number(row, self.ours)?, number(truth, self.theirs)?])
    }

    /// How far our value is from theory's.
    pub fn error(&self, row: &Row, truth: &Row) -> Option<f64> {
        let [ours, theirs] = self.values(row, truth)?;
        Some(self.scaled(ours - theirs, theirs))
    }
}

/// The top of the parabola through three samples at equal distances: how far behind the middle one it
/// is, in these distances, and its value. Where they have no top it is the middle one.
pub fn parabola_top([before, here, after]: [f64; 3]) -> (f64, f64) {
    let (rise, bend) = (after - before, before - 2.0 * here + after);
    if bend >= 0.0 {
        return (0.0, here);
    }
    let share = -0.5 * rise / bend;
    (share, here + 0.25 * rise * share)
}

/// The exit code: 0 where all is well, 1 where it is not, 2 on bad input, which is told.
pub fn exit(example: &str, result: Result<bool>) -> ExitCode {
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("{example}: {error:#}");
            ExitCode::from(2)
        }
    }
}
