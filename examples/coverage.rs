//! How honest the error bars are: how often they hold the truth, which is potential theory.
//!
//! `cargo run --release --example coverage -- POTENTIAL_DIR OUT.md RUN_DIR...`
//!
//! Writes a table to `OUT.md` and prints it. Exit code 0 where the share of bars that hold is within
//! [`LEAST`] and [`MOST`], 1 where it is not or a case failed, 2 on bad input.

mod common;

use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result, ensure};
use common::{
    COMPARED, Compared, DISPLACEMENT, FORCE, KEYS, MOMENT, RUNUP, Row, beside, number, read,
    summaries, text,
};

/// What is judged, and the columns of the bars.
const READINGS: [(&Compared, &str); 4] = [
    (&COMPARED[FORCE], "force_error"),
    (&COMPARED[RUNUP], "runup_error"),
    (&COMPARED[DISPLACEMENT], "displacement_error"),
    (&MOMENT, "moment_error"),
];

/// The least share of bars that hold the truth, percent: below it they promise too much.
const LEAST: f64 = 90.0;
/// The largest, percent: above it they are too wide to say anything.
const MOST: f64 = 99.0;
/// As many bars it takes to tell a share: those of a wave alone are too few.
const MANY: usize = 100;

/// One bar and the error that it should hold, in the reading's unit.
#[derive(Debug, Clone)]
struct Bar {
    wave: f64,
    size: f64,
    error: f64,
    case: String,
}

impl Bar {
    fn new(row: &Row, truths: &[Row], reading: &Compared, bar: &str) -> Option<Bar> {
        let truth = beside(row, truths)?;
        let [_, exact] = reading.values(row, truth)?;
        let case: Vec<_> =
            KEYS.iter().filter_map(|key| row.get(*key)).map(String::as_str).collect();
        Some(Bar {
            wave: number(row, KEYS[0])?,
            // A bar that is missing holds nothing.
            size: reading.scaled(number(row, bar).unwrap_or(f64::NAN), exact.abs()),
            error: reading.error(row, truth)?,
            case: case.join(", ").trim_end_matches([',', ' ']).to_owned(),
        })
    }

    fn holds(&self) -> bool {
        self.error.abs() <= self.size
    }
}

/// The share of bars that hold, percent.
fn share(bars: &[Bar]) -> f64 {
    100.0 * bars.iter().filter(|bar| bar.holds()).count() as f64 / bars.len() as f64
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

fn median(values: &[f64]) -> f64 {
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

/// What nine in ten are no larger than.
fn nine_in_ten(values: &[f64]) -> f64 {
    values[(9 * values.len()).div_ceil(10).saturating_sub(1)]
}

/// A row of the table.
fn line(reading: &Compared, wave: &str, bars: &[Bar]) -> String {
    let Compared { name, unit, .. } = reading;
    let worst = bars.iter().max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()));
    let worst = worst.map(|bar| format!("{:+.3} at {}", bar.error, bar.case)).unwrap_or_default();
    let errors = sorted(bars.iter().map(|bar| bar.error.abs()));
    format!(
        "| {name}, {unit} | {wave} | {} | {:.1} % | {:.4} | {:.4} | {:.4} | {worst} |\n",
        bars.len(),
        share(bars),
        median(&sorted(bars.iter().map(|bar| bar.size))),
        median(&errors),
        nine_in_ten(&errors),
    )
}

/// The rows of every wave, and of all of them.
fn lines(reading: &Compared, bars: &mut [Bar]) -> String {
    bars.sort_by(|a, b| a.wave.total_cmp(&b.wave));
    let waves = bars.chunk_by(|a, b| a.wave == b.wave);
    let waves = waves.map(|wave| line(reading, &wave[0].wave.to_string(), wave));
    let all = (!bars.is_empty()).then(|| line(reading, "all", bars));
    waves.chain(all).collect()
}

/// What is wrong with the bars of one reading: the share of all, and of every wave.
fn broken(heading: &str, bars: &[Bar]) -> Vec<String> {
    let mut lines = Vec::new();
    let mut check = |of: &str, bars: &[Bar]| {
        let (count, share) = (bars.len(), share(bars));
        if share < LEAST && count >= MANY {
            lines.push(format!(
                "{heading}, {of}: {share:.1} % of {count} bars hold, least {LEAST} %"
            ));
        }
        if share > MOST && count >= MANY {
            lines
                .push(format!("{heading}, {of}: {share:.1} % of {count} bars hold, most {MOST} %"));
        }
    };
    check("all", bars);
    for wave in bars.chunk_by(|a, b| a.wave == b.wave) {
        check(&format!("H/h {}", wave[0].wave), wave);
    }
    lines
}

/// The table, and what breaks the bounds on the shares.
fn judge(rows: &[Row], truths: &[Row]) -> Result<(String, Vec<String>)> {
    let mut page = "# Coverage of the error bars\n\nWritten by `scripts/coverage`: how often the truth lies \
        inside the bar of a case (`error_bars = \"pair\"`).\nThe truth is potential theory of the same \
        tank (`results/potential`).\n\n\
        | reading | H/h | cases | bars that hold | median bar | median error | nine in ten below | worst error (H/h, k, m) |\n\
        |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let (mut faults, mut missed) = (Vec::new(), String::new());
    for row in rows.iter().filter(|row| row.get("status").is_none_or(|status| status != "ok")) {
        let cell = |column| text(row, column);
        faults.push(format!("{}: failed: {}", KEYS.map(cell).join(", "), cell("reason")));
    }
    let mut any = false;
    for (reading, bar) in READINGS {
        let mut bars: Vec<_> =
            rows.iter().filter_map(|row| Bar::new(row, truths, reading, bar)).collect();
        if bars.is_empty() {
            continue; // fixed walls have no displacement
        }
        any = true;
        page += &lines(reading, &mut bars);
        for bar in bars.iter().filter(|bar| !bar.holds()) {
            let (Compared { name, unit, .. }, Bar { size, error, case, .. }) = (reading, bar);
            writeln!(missed, "| {name}, {unit} | {case} | {error:+.4} | {size:.4} |")?;
        }
        faults.extend(broken(reading.name, &bars));
    }
    ensure!(any, "no row has a truth");
    page +=
        "\nBars that do not hold:\n\n| reading | H/h, k, m | error | bar |\n|---|---|---|---|\n";
    page += &missed;
    for fault in &faults {
        writeln!(page, "\nOut of bounds: {fault}")?;
    }
    Ok((page, faults))
}

fn run() -> Result<bool> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    ensure!(arguments.len() >= 3, "needed: POTENTIAL_DIR OUT.md RUN_DIR...");
    let potential = Path::new(&arguments[0]);
    let mut truths = read(&potential.join("tank.csv"))?;
    for more in ["fixed.csv", "between.csv"] {
        truths.extend(read(&potential.join(more))?);
    }
    let rows = summaries(&arguments[2..])?;
    let (text, faults) = judge(&rows, &truths)?;
    print!("{text}");
    let written = std::fs::write(&arguments[1], text);
    written.with_context(|| format!("cannot write {}", arguments[1]))?;
    for fault in &faults {
        eprintln!("coverage: {fault}");
    }
    Ok(faults.is_empty())
}

fn main() -> ExitCode {
    common::exit("coverage", run())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bars(good: usize, bad: usize) -> Vec<Bar> {
        let bar = |error| Bar { wave: 0.3, size: 1.0, error, case: String::new() };
        [vec![bar(-0.5); good], vec![bar(1.5); bad]].concat()
    }

    #[test]
    fn nine_in_ten_are_no_larger() {
        let errors: Vec<_> = (1..=20).map(f64::from).collect();
        assert_eq!(
            (median(&errors), nine_in_ten(&errors), nine_in_ten(&errors[..1])),
            (10.5, 18.0, 1.0)
        );
    }

    #[test]
    fn shares_outside_the_bounds_are_told() {
        assert!(broken("first F*", &bars(95, 5)).is_empty());
        assert!(broken("first F*", &bars(60, 0)).is_empty(), "too few to call them too wide");
        let low = broken("first F*", &bars(100, 20));
        assert_eq!(low[1], "first F*, H/h 0.3: 83.3 % of 120 bars hold, least 90 %");
        assert!(broken("first F*", &bars(300, 0))[0].ends_with("most 99 %"));
        assert!(!Bar { size: f64::NAN, ..bars(1, 0)[0].clone() }.holds());
    }
}
