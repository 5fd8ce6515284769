//! How honest the error bars are: how often the truth lies inside.
//!
//! `cargo run --release --example coverage -- TANK_REFERENCE.csv OUT.md RUN_DIR...`
//!
//! The truth of a row is that of the reference, where it has the case, and otherwise the same case
//! at half the particle spacing, where the run has it. Writes a table to `OUT.md` and prints it.
//! Exit code 0, or 2 on bad input.

mod common;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result, ensure};
use common::{KEYS, Row, number, read, same_case};

/// Our column, the bar's, the heading.
const READINGS: [[&str; 3]; 3] = [
    ["first_force_max", "force_error", "first F*"],
    ["first_runup_max", "runup_error", "first R*"],
    ["displacement_max", "displacement_error", "largest X*"],
];

/// One bar: its size over the value, the error over the bar, and the case.
struct Bar {
    percent: f64,
    used: f64,
    case: String,
}

/// Bars by what they were checked against, spacing and reading.
type Groups = BTreeMap<(String, String, usize), Vec<Bar>>;

fn collect(rows: &[Row], reference: &[Row], groups: &mut Groups) {
    for row in rows {
        let Some(spacing) = number(row, "particle_spacing_m") else { continue };
        let half = |other: &&Row| {
            let finer = number(other, "particle_spacing_m").unwrap_or(f64::NAN);
            same_case(row, other) && (finer / spacing - 0.5).abs() < 1e-6
        };
        let exact = reference.iter().find(|other| same_case(row, other));
        let finer = rows.iter().find(half);
        for (truth, name) in [(exact, "potential theory"), (finer, "half the spacing")] {
            let Some(truth) = truth else { continue };
            for (place, [column, bar, _]) in READINGS.iter().enumerate() {
                let value = number(row, column);
                let Some(((value, bar), truth)) =
                    value.zip(number(row, bar)).zip(number(truth, column))
                else {
                    continue;
                };
                let case: Vec<_> = KEYS.iter().filter_map(|key| row.get(*key).cloned()).collect();
                groups.entry((name.to_owned(), format!("{spacing}"), place)).or_default().push(
                    Bar {
                        percent: 100.0 * bar / value.abs(),
                        used: (value - truth).abs() / bar,
                        case: case
                            .into_iter()
                            .filter(|word| !word.is_empty())
                            .collect::<Vec<_>>()
                            .join(", "),
                    },
                );
            }
        }
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

fn table(groups: &Groups) -> Result<String> {
    let mut text = "# Coverage of the error bars\n\nWritten by `scripts/coverage`: how often the truth lies \
        inside the bar of a case (`error_bars = \"pair\"`). The truth\nis fully nonlinear potential \
        theory of the same tank where it is known, and otherwise the same case at half the spacing,\n\
        which has an error of its own. The aim is 90 % inside and a median bar below 3 %.\n\n\
        | truth | spacing, m | reading | cases | inside | median bar, % | median error/bar | outside (H/h, k, m: error/bar) |\n\
        |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let (mut all, mut inside) = (0, 0);
    for ((truth, spacing, place), bars) in groups {
        let good = bars.iter().filter(|bar| bar.used <= 1.0).count();
        (all, inside) = (all + bars.len(), inside + good);
        let outside: Vec<_> = bars
            .iter()
            .filter(|bar| bar.used > 1.0)
            .map(|bar| format!("{}: {:.2}", bar.case, bar.used))
            .collect();
        writeln!(
            text,
            "| {truth} | {spacing} | {} | {} | {:.0} % | {:.2} | {:.2} | {} |",
            READINGS[*place][2],
            bars.len(),
            100.0 * good as f64 / bars.len() as f64,
            median(bars.iter().map(|bar| bar.percent).collect()),
            median(bars.iter().map(|bar| bar.used).collect()),
            outside.join("; ")
        )?;
    }
    ensure!(all > 0, "no row has both a bar and a truth");
    writeln!(
        text,
        "\nOf all {all} bars {:.0} % hold the truth.",
        100.0 * f64::from(inside as u32) / f64::from(all as u32)
    )?;
    Ok(text)
}

fn run() -> Result<()> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    ensure!(arguments.len() >= 3, "usage: coverage TANK_REFERENCE.csv OUT.md RUN_DIR...");
    let reference = read(Path::new(&arguments[0]))?;
    let mut groups = Groups::new();
    for directory in &arguments[2..] {
        collect(&read(&Path::new(directory).join("summary.csv"))?, &reference, &mut groups);
    }
    let text = table(&groups)?;
    print!("{text}");
    std::fs::write(&arguments[1], text).with_context(|| format!("cannot write {}", arguments[1]))
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("coverage: {error:#}");
            ExitCode::from(2)
        }
    }
}
