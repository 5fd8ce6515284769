//! Which sound cases are called doubtful, and which faulty ones are not.
//!
//! `cargo run --release --example flags -- OUT.csv SOUND_DIR [NAME=FAULTY_DIR]...`
//!
//! Prints a table and writes it to `OUT.csv`. A fault counts as missed in a case that nothing is said
//! of though one of its quoted maxima is farther from the sound one than the sound one's error bar.
//! Exit code 0 where at most [`MOST`] of the sound cases are doubtful and no fault is missed, 1 where
//! not, 2 on bad input.

mod common;

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result, ensure};
use common::{KEYS, Row, beside, number, read, text};

/// The largest share of sound cases that may be doubtful, percent.
const MOST: f64 = 2.0;
/// Quoted maxima and their bars.
const QUOTED: [(&str, &str); 5] = [
    ("force_max", "force_max_error"),
    ("first_force_max", "force_error"),
    ("runup_max", "runup_max_error"),
    ("first_runup_max", "runup_error"),
    ("displacement_max", "displacement_error"),
];

/// What came of one sweep.
#[derive(Debug, Clone, PartialEq)]
struct Told {
    name: String,
    spacing_m: String,
    cases: usize,
    failed: usize,
    doubtful: usize,
    missed: usize,
    /// How far a quoted maximum moved in a case that nothing is said of, over its bar, at most.
    farthest: f64,
    example: String,
}

impl Told {
    fn new(name: &str, rows: &[Row], sound: &[Row]) -> Result<Told> {
        let is = |row: &&Row, column: &str, value: &str| text(row, column) == value;
        let first = rows.first().context("no case")?;
        let quiet = rows
            .iter()
            .filter(|row| is(row, "status", "ok") && is(row, "doubtful", "false"))
            .map(|row| Ok((moved(row, beside(row, sound).context("no such sound case")?), row)))
            .collect::<Result<Vec<_>>>()?;
        let farthest = quiet.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let place = |row: &Row| KEYS.map(|key| text(row, key).to_owned()).join(" ");
        Ok(Told {
            name: name.to_owned(),
            spacing_m: text(first, "particle_spacing_m").to_owned(),
            cases: rows.len(),
            failed: rows.iter().filter(|row| !is(row, "status", "ok")).count(),
            doubtful: rows.iter().filter(|row| is(row, "doubtful", "true")).count(),
            missed: quiet.iter().filter(|(moved, _)| *moved > 1.0).count(),
            farthest: farthest.map_or(0.0, |(moved, _)| *moved),
            example: farthest.map(|(_, row)| place(row)).unwrap_or_default(),
        })
    }

    fn line(&self) -> String {
        let Told { name, spacing_m, cases, failed, doubtful, missed, farthest, example } = self;
        let share = 100.0 * *doubtful as f64 / *cases as f64;
        format!(
            "{name},{spacing_m},{cases},{failed},{doubtful},{share:.1},{missed},{farthest:.2},{example}\n"
        )
    }
}

/// The farthest that a quoted maximum of a case is from that of the sound one, over its bar.
fn moved(row: &Row, sound: &Row) -> f64 {
    let over = |(maximum, bar): &(&str, &str)| {
        let apart = number(row, maximum)? - number(sound, maximum)?;
        Some(apart.abs() / number(sound, bar)?)
    };
    QUOTED.iter().filter_map(over).fold(0.0, f64::max)
}

fn main() -> ExitCode {
    common::exit("flags", judge())
}

fn judge() -> Result<bool> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [out, sound, faulty @ ..] = &arguments[..] else {
        anyhow::bail!(
            "give OUT.csv, the directory of the sound study, and NAME=DIR of faulty ones"
        );
    };
    let rows = read(&Path::new(sound).join("summary.csv"))?;
    ensure!(
        rows.iter().all(|row| number(row, "force_error").is_some()),
        "{sound}: has no error bars"
    );
    let mut told = vec![Told::new("sound", &rows, &rows)?];
    for argument in faulty {
        let (name, directory) = argument.split_once('=').context("write NAME=DIR")?;
        let faulty = read(&Path::new(directory).join("summary.csv"))?;
        told.push(Told::new(name, &faulty, &rows).with_context(|| argument.clone())?);
    }
    let header = "run,particle_spacing_m,cases,failed,doubtful,doubtful_percent,missed,\
                  farthest_over_bar,farthest_case\n";
    let table: String =
        std::iter::once(header.to_owned()).chain(told.iter().map(Told::line)).collect();
    print!("{table}");
    std::fs::write(out, &table).with_context(|| format!("cannot write {out}"))?;
    let share = 100.0 * told[0].doubtful as f64 / told[0].cases as f64;
    Ok(share <= MOST && told.iter().all(|told| told.missed == 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(doubtful: &str, force: f64) -> Row {
        let mut row: Row = KEYS.iter().map(|key| ((*key).to_owned(), "1".to_owned())).collect();
        let cells = [("status", "ok"), ("doubtful", doubtful), ("force_max_error", "0.1")];
        row.extend(cells.map(|(name, cell)| (name.to_owned(), cell.to_owned())));
        row.insert("force_max".to_owned(), force.to_string());
        row
    }

    #[test]
    fn a_fault_is_missed_where_nothing_is_said_of_a_number_that_moved() {
        let sound = [row("false", 2.0)];
        let missed = |faulty: Row| Told::new("a", &[faulty], &sound).unwrap().missed;
        assert_eq!(missed(row("false", 2.05)), 0);
        assert_eq!(missed(row("false", 2.15)), 1);
        assert_eq!(missed(row("true", 2.15)), 0);
    }
}
