//! Compares two `summary.csv` of the same sweep, column by column:
//!
//! `cargo run --release --example compare_summary -- REFERENCE.csv NEW.csv`
//!
//! Exit code 0 where they agree within [`rule`]'s tolerances, 1 where they do not, 2 on bad input.

mod common;

use std::collections::BTreeMap;
use std::process::ExitCode;

use anyhow::{Context, Result, bail, ensure};
use seawall::math::words::counted;

/// How a column is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Rule {
    /// The same text.
    Exact,
    /// Numbers within a share of the reference's size or an absolute difference.
    Within { share: f64, absolute: f64 },
    /// Not at all: it says where, how fast or in what words, not what.
    Ignored,
}

/// The tolerances, by column.
fn rule(column: &str) -> Rule {
    let within = |share, absolute| Rule::Within { share, absolute };
    match column {
        "wall_time_s" | "reason" | "doubtful_reason" | "host" | "rank" => Rule::Ignored,
        // Readings of the run's own quality: a percentage point.
        "force_gap_percent" | "energy_gap_percent" | "force_max_gap_percent" => within(0.0, 1.0),
        // Touches are as good as none.
        "stop_impulse" => within(0.05, 0.01),
        "stop_impulse_time_s" => Rule::Ignored,
        // Values of the scene, or computed from them alone.
        "log10_k_star" | "m_star" | "stroke_centre_s" => within(1e-9, 1e-9),
        "measured_wave_height_ratio" => within(0.01, 0.0),
        // Single steps carry sound waves.
        "force_max_raw" => within(0.03, 0.0),
        _ if column.ends_with("_error") => within(0.2, 0.005),
        // When a flat maximum is reached is known less well than its height.
        _ if column.ends_with("_time_s") => within(0.0, 0.05),
        "first_impulse" => within(0.01, 0.0),
        "spring_force_max" => within(0.01, 0.005),
        _ if column.contains("moment_max") => within(0.01, 0.0),
        _ if column.contains("force_max") || column.contains("force_peak") => within(0.01, 0.0),
        "force_end" => within(0.01, 0.01),
        _ if column.contains("runup") => within(0.0, 0.01),
        _ if column.contains("displacement") && column != "displacement_truncated" => {
            within(0.01, 0.005)
        }
        _ => Rule::Exact,
    }
}

/// Whether two cells agree, an empty one only with an empty one.
fn agrees(rule: Rule, reference: &str, new: &str) -> bool {
    match rule {
        Rule::Ignored => true,
        Rule::Exact => reference == new,
        Rule::Within { share, absolute } => match (reference.parse::<f64>(), new.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= absolute.max(share * a.abs()),
            _ => reference == new,
        },
    }
}

/// A summary: its columns, and its rows by case.
struct Summary {
    header: Vec<String>,
    rows: BTreeMap<String, Vec<String>>,
}

impl Summary {
    fn read(path: &str) -> Result<Summary> {
        let mut reader =
            csv::Reader::from_path(path).with_context(|| format!("cannot read {path}"))?;
        let header: Vec<_> = reader.headers()?.iter().map(str::to_owned).collect();
        let Some(id) = header.iter().position(|name| name == "case_id") else {
            bail!("{path}: no column \"case_id\"");
        };
        let mut rows = BTreeMap::new();
        for record in reader.records() {
            let record = record.with_context(|| format!("cannot read {path}"))?;
            rows.insert(record[id].to_owned(), record.iter().map(str::to_owned).collect());
        }
        Ok(Summary { header, rows })
    }

    fn cell<'a>(&self, row: &'a [String], column: &str) -> Option<&'a str> {
        let at = self.header.iter().position(|name| name == column)?;
        Some(&row[at])
    }
}

/// Every disagreement, one line each. New columns are welcome, lost ones are not.
fn differences(reference: &Summary, new: &Summary) -> Vec<String> {
    let mut found = Vec::new();
    for id in new.rows.keys().filter(|id| !reference.rows.contains_key(*id)) {
        found.push(format!("{id}: not in the reference"));
    }
    for (id, row) in &reference.rows {
        let Some(new_row) = new.rows.get(id) else {
            found.push(format!("{id}: missing"));
            continue;
        };
        for (column, value) in reference.header.iter().zip(row) {
            match new.cell(new_row, column) {
                Some(other) if agrees(rule(column), value, other) => {}
                Some(other) => found.push(format!("{id}, {column}: {value} became {other}")),
                None => found.push(format!("{id}, {column}: column is missing")),
            }
        }
    }
    found
}

/// What is told at the end.
fn outcome(cases: usize, reference: &str, differences: usize) -> String {
    let [cases, differences] = [counted(cases, "case"), counted(differences, "difference")];
    format!("{cases} compared with {reference}: {differences}")
}

fn run() -> Result<bool> {
    let paths: Vec<_> = std::env::args().skip(1).collect();
    ensure!(paths.len() == 2, "two files are needed: the reference and the new summary");
    let (reference, new) = (Summary::read(&paths[0])?, Summary::read(&paths[1])?);
    let found = differences(&reference, &new);
    for line in &found {
        println!("{line}");
    }
    println!("{}", outcome(reference.rows.len(), &paths[0], found.len()));
    Ok(found.is_empty())
}

fn main() -> ExitCode {
    common::exit("compare_summary", run())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances() {
        assert!(agrees(rule("first_force_max"), "2.000", "2.019"));
        assert!(!agrees(rule("first_force_max"), "2.000", "2.021"));
        assert!(agrees(rule("runup_max"), "0.500", "0.509"));
        assert!(!agrees(rule("first_runup_peak"), "0.500", "0.511"));
        assert!(agrees(rule("displacement_max"), "0.001", "0.005"));
        assert!(!agrees(rule("displacement_max"), "2.0", "2.03"));
        assert!(!agrees(rule("displacement_truncated"), "true", "false"));
        assert!(!agrees(rule("steps"), "9000", "9001"));
        assert!(agrees(rule("wall_time_s"), "5.1", "99"));
        assert!(agrees(rule("force_max_time_s"), "2.20", "2.24"));
    }

    #[test]
    fn a_value_that_comes_or_goes_is_a_difference() {
        assert!(!agrees(rule("displacement_max"), "", "0.1"));
        assert!(!agrees(rule("displacement_max"), "0.1", ""));
        assert!(agrees(rule("displacement_max"), "", ""));
    }

    /// The story: it told of "1 differences".
    #[test]
    fn one_difference_is_none_of_many() {
        assert_eq!(outcome(12, "a.csv", 1), "12 cases compared with a.csv: 1 difference");
        assert_eq!(outcome(1, "a.csv", 0), "1 case compared with a.csv: 0 differences");
    }

    #[test]
    fn rows_and_columns_that_vanish_are_told() {
        let summary = |header: &[&str], rows: &[[&str; 2]]| Summary {
            header: header.iter().map(|name| (*name).to_owned()).collect(),
            rows: rows.iter().map(|r| (r[0].to_owned(), r.map(str::to_owned).to_vec())).collect(),
        };
        let reference = summary(&["case_id", "steps"], &[["a", "1"], ["b", "2"]]);
        let new = summary(&["case_id", "stops"], &[["a", "1"], ["c", "2"]]);
        assert_eq!(
            differences(&reference, &new),
            ["c: not in the reference", "a, steps: column is missing", "b: missing"]
        );
    }
}
