//! Tables: the summary in brief, the response curves, readings, energies, and the health of every
//! case.

mod energy;
mod page;
mod readings;

use super::curves::{Response, panels, variants};
use super::error::ReportError;
use super::load::Loaded;
use super::number::{rounded, significant};
use super::plots::{file_name, fixed_walls};
use super::row::Row;
pub use readings::across;

/// A table, ready for a file or a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// File name without its ending.
    pub name: String,
    /// Heading in the report.
    pub title: String,
    /// Column names.
    pub header: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    fn new(name: &str, title: &str, header: &[&str], rows: Vec<Vec<String>>) -> Table {
        let header = header.iter().map(|column| (*column).to_owned()).collect();
        Table { name: name.to_owned(), title: title.to_owned(), header, rows }
    }

    /// The table as comma-separated text.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let records = std::iter::once(&self.header).chain(&self.rows);
        for record in records {
            writer.write_record(record).expect("rows are as wide as their header");
        }
        let bytes = writer.into_inner().expect("memory does not run dry");
        String::from_utf8(bytes).expect("cells are text")
    }
}

/// Every table that the sweep's files can fill.
///
/// # Errors
/// Readings that cannot be read.
pub fn all(data: &Loaded) -> Result<Vec<Table>, ReportError> {
    let mut tables = vec![summary(data), health(data)];
    tables.extend(responses(data));
    tables.extend(fixed(data));
    tables.extend(readings::readings(data)?);
    tables.extend(energy::energy(data));
    Ok(tables)
}

/// The summary in brief: one row per case, failed ones included.
pub fn summary(data: &Loaded) -> Table {
    let variants = data.rows.iter().any(|row| !row.variant.is_empty());
    // Maxima of the whole run, where the first impact does not stand for them.
    let whole = data.finished().any(|row| row.first_force_max.is_none());
    let bar = |error: Option<f64>| plain(error.map(|error| significant(error, 3)));
    let mut header = vec![
        "case_id",
        "status",
        "wave_height_ratio",
        "measured_wave_height_ratio",
        "spring_stiffness_n_per_m",
        "seawall_mass_kg_per_m",
        "log10_k_star",
        "m_star",
        "first_force_max",
        "first_runup_max",
        "displacement_max",
        "displacement_truncated",
        "stops",
        "force_coupling",
        "force_error",
        "runup_error",
        "displacement_error",
    ];
    header.extend(whole.then_some(["force_max", "runup_max"]).into_iter().flatten());
    header.extend(variants.then_some("variant"));
    let row = |row: &Row| {
        let mut cells = vec![row.case_id.clone(), row.status.clone()];
        cells.push(plain(row.wave_height_ratio));
        cells.push(rounded(row.measured_wave_height_ratio, 4));
        cells.push(plain(row.spring_stiffness_n_per_m));
        cells.push(plain(row.seawall_mass_kg_per_m));
        cells.push(rounded(row.log10_k_star, 2));
        cells.push(plain(row.m_star));
        cells.push(rounded(row.first_force_max, 4));
        cells.push(rounded(row.first_runup_max, 4));
        cells.push(rounded(row.displacement_max, 4));
        cells.push(plain(row.displacement_truncated));
        cells.push(plain(row.stops));
        cells.push(plain(row.force_coupling));
        cells.extend([row.force_error, row.runup_error, row.displacement_error].map(bar));
        if whole {
            cells.extend([row.force_max, row.runup_max].map(|value| rounded(value, 4)));
        }
        cells.extend(variants.then(|| row.variant.clone()));
        cells
    };
    Table::new("summary", "Cases", &header, data.rows.iter().map(row).collect())
}

/// What tells a sound case from a doubtful one.
pub fn health(data: &Loaded) -> Table {
    let header = [
        "case_id",
        "wave_height_ratio",
        "spring_stiffness_n_per_m",
        "seawall_mass_kg_per_m",
        "force_coupling",
        "force_gap_percent",
        "energy_gap_percent",
        "particles_lost",
        "particles",
        "steps",
        "stop_impulse",
        "doubtful_reason",
    ];
    let row = |row: &Row| {
        vec![
            row.case_id.clone(),
            plain(row.wave_height_ratio),
            plain(row.spring_stiffness_n_per_m),
            plain(row.seawall_mass_kg_per_m),
            plain(row.force_coupling),
            rounded(row.force_gap_percent, 3),
            rounded(row.energy_gap_percent, 3),
            plain(row.particles_lost),
            plain(row.particles),
            plain(row.steps),
            rounded(row.stop_impulse, 4),
            row.doubtful_reason.clone(),
        ]
    };
    Table::new("health", "Health", &header, data.finished().map(row).collect())
}

/// The numbers of each response figure.
fn responses(data: &Loaded) -> Vec<Table> {
    let header = |response: Response| {
        [
            "m_star",
            "wave_height_ratio",
            "log10_k_star",
            response.column(),
            "error",
            "truncated",
            "force_coupling",
            "case_id",
        ]
    };
    let mut tables = Vec::new();
    for variant in variants(&data.rows) {
        for response in Response::ALL {
            let mut rows = Vec::new();
            for panel in panels(&data.rows, &variant, response) {
                for curve in panel.curves {
                    rows.extend(curve.points.into_iter().map(|point| {
                        vec![
                            panel.m_star.to_string(),
                            curve.wave_height_ratio.to_string(),
                            point.log10_k_star.to_string(),
                            point.value.to_string(),
                            plain(point.error),
                            point.truncated.to_string(),
                            plain(point.force_coupling),
                            point.case_id,
                        ]
                    }));
                }
            }
            if !rows.is_empty() {
                let name = file_name(&format!("response-{}", response.name()), &variant);
                tables.push(Table::new(&name, "Response curve", &header(response), rows));
            }
        }
    }
    tables
}

/// The numbers of each fixed-wall figure.
fn fixed(data: &Loaded) -> Vec<Table> {
    let header = [
        "wave_height_ratio",
        "measured_wave_height_ratio",
        "first_runup_max",
        "first_force_max",
        "case_id",
    ];
    let row = |row: &Row| {
        vec![
            plain(row.wave_height_ratio),
            plain(row.measured_wave_height_ratio),
            plain(row.first_runup_max),
            plain(row.first_force_max),
            row.case_id.clone(),
        ]
    };
    let table = |variant: String| {
        let rows: Vec<_> = fixed_walls(data, &variant).map(row).collect();
        let name = file_name("fixed-wall", &variant);
        (!rows.is_empty()).then(|| Table::new(&name, "Fixed wall", &header, rows))
    };
    variants(&data.rows).into_iter().filter_map(table).collect()
}

fn plain<T: ToString>(value: Option<T>) -> String {
    value.map(|value| value.to_string()).unwrap_or_default()
}

/// Reads a directory and makes its tables: what a command line prints needs no figures.
///
/// # Errors
/// See [`Loaded::read`].
pub fn read(directory: &std::path::Path) -> Result<Vec<Table>, ReportError> {
    all(&Loaded::read(directory)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture;

    fn named(tables: &[Table], name: &str) -> Table {
        tables.iter().find(|table| table.name == name).unwrap().clone()
    }

    #[test]
    fn tables_of_a_movable_sweep() {
        let tables = read(fixture::sweep().path()).unwrap();
        let names: Vec<_> = tables.iter().map(|table| table.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "summary",
                "health",
                "response-displacement",
                "response-force",
                "response-runup",
                "energy"
            ]
        );
        assert_eq!(named(&tables, "summary").rows.len(), 12);
        assert_eq!(named(&tables, "health").rows.len(), 11, "failed cases have no health");
        let force = named(&tables, "response-force");
        assert_eq!(force.rows.len(), 11);
        assert_eq!(force.rows[0][..2], ["1.25", "0.3"]);
        let energy = named(&tables, "energy");
        assert_eq!(energy.header[..2], ["case_id", "wave_height_ratio"]);
        assert_eq!(energy.header[4..6], ["force_coupling", "paddle_work_j"]);
        assert!(energy.csv().contains("\ncase-0001,0.3,10,250,1,48.000,"), "{}", energy.csv());
    }

    #[test]
    fn fixed_walls_have_a_table_of_their_own() {
        let tables = read(fixture::fixed().path()).unwrap();
        assert_eq!(named(&tables, "fixed-wall").rows.len(), 6);
        assert!(!tables.iter().any(|table| table.name.starts_with("response")));
    }

    #[test]
    fn every_row_is_as_wide_as_its_header() {
        for table in read(fixture::sweep().path()).unwrap() {
            assert!(table.rows.iter().all(|row| row.len() == table.header.len()), "{}", table.name);
        }
    }
}
