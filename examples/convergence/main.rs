//! How the readings of eight walls converge on potential theory with spacing and sound speed:
//!
//! `cargo run --release --example convergence -- POTENTIAL_DIR OUT_DIR RUN_DIR...`
//!
//! Writes `convergence.csv`, `convergence.md` and `convergence.svg` to `OUT_DIR`. Exit code 0 where
//! every bound holds, 1 where one is broken or a case failed, 2 on bad input.

#[path = "../common/mod.rs"]
mod common;
mod figure;

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result, ensure};
use common::{
    COMPARED, CREST, Compared, DISPLACEMENT, FORCE, KEYS, RUNUP, Row, beside, number, read,
    summaries, text,
};
use seawall::math::words::counted;

/// The least errors that an order is read off, in the order of [`COMPARED`].
const LEAST: [f64; 4] = [0.3, 0.3, 0.01, 0.3];

/// Bounds hold from this spacing down, m: coarser runs show the way there.
const FINE: f64 = 0.008;
/// Waves from here on are near the highest there is; their bounds are wider.
const STEEP: f64 = 0.6;
/// Crest at [`FINE`], %: what the spacing still takes off it.
const CREST_BOUND: f64 = 0.3;
/// First F*, %, with any speed of sound: single blows scatter.
const FORCE_BOUND: f64 = 0.3;
/// Likewise when steep.
const STEEP_FORCE_BOUND: f64 = 0.6;
/// First R* at [`FINE`] when steep, h: the tip is thinner than a particle.
const STEEP_RUNUP_BOUND: f64 = 0.04;
/// X*, %: a spring answers to the mean of the force, which scatters less than its maximum.
const DISPLACEMENT_BOUND: f64 = 0.25;
/// F* between neighbouring spacings from [`FINE`] down, %: a scheme that converges does not jump.
const CHANGE_BOUND: f64 = 0.3;

/// A run beside its truth.
#[derive(Debug, Clone)]
struct Case {
    /// H/h, k and m; fixed walls have the first alone.
    keys: [Option<f64>; 3],
    spacing: f64,
    /// c0/√(g h) where the file says it; else it follows the spacing.
    sound: Option<f64>,
    force: f64,
    /// In the order of [`COMPARED`].
    errors: [Option<f64>; 4],
    seconds: f64,
}

impl Case {
    fn new(row: &Row, truths: &[Row]) -> Result<Case> {
        let cell = |column| number(row, column).with_context(|| format!("{column} is missing"));
        let truth = beside(row, truths).context("no truth")?;
        Ok(Case {
            keys: KEYS.map(|key| number(row, key)),
            spacing: cell("particle_spacing_m")?,
            sound: number(row, "sound_speed_ratio"),
            force: cell("first_force_max")?,
            errors: COMPARED.map(|of| of.error(row, truth)),
            seconds: cell("wall_time_s")?,
        })
    }

    fn wave(&self) -> f64 {
        self.keys[0].unwrap_or(f64::NAN)
    }

    fn wall(&self) -> String {
        match self.keys {
            [_, Some(k), Some(m)] => format!("H/h {}, k {k}, m {m}", self.wave()),
            _ => format!("H/h {}, fixed", self.wave()),
        }
    }

    fn name(&self) -> String {
        let sound = self.sound.map(|sound| format!(", c0 ratio {sound}")).unwrap_or_default();
        format!("{}, {} mm{sound}", self.wall(), millimetres(self.spacing))
    }

    fn steep(&self) -> bool {
        self.wave() > STEEP - 1e-9
    }

    fn fine(&self) -> bool {
        self.spacing < FINE + 1e-9
    }

    /// The largest error allowed, where there is a bound.
    fn bound(&self, reading: usize) -> Option<f64> {
        let at = self.fine() && self.spacing > FINE - 1e-9;
        match reading {
            CREST if at => Some(CREST_BOUND),
            FORCE if self.fine() && !self.steep() => Some(FORCE_BOUND),
            FORCE if self.fine() => Some(STEEP_FORCE_BOUND),
            RUNUP if at && self.steep() => Some(STEEP_RUNUP_BOUND),
            DISPLACEMENT if self.fine() && self.keys[1].is_some() => Some(DISPLACEMENT_BOUND),
            _ => None,
        }
    }
}

fn millimetres(spacing: f64) -> f64 {
    (1e5 * spacing).round() / 100.0
}

/// The change of F* from the first to the second of two runs, percent.
fn change(pair: &[Case]) -> f64 {
    100.0 * (pair[1].force / pair[0].force - 1.0)
}

/// What breaks its bound: case, reading, value and bound.
fn broken(curves: &[&[Case]]) -> Vec<String> {
    let mut lines = Vec::new();
    for case in curves.iter().copied().flatten() {
        for (place, Compared { name, unit, .. }) in COMPARED.iter().enumerate() {
            let Some(bound) = case.bound(place) else { continue };
            // What is missing or not a number is not within the bound either.
            let error = case.errors[place].unwrap_or(f64::NAN);
            if error.is_nan() || error.abs() > bound {
                let case = case.name();
                lines.push(format!("{case}: {name} {error:+.4} {unit}, bound {bound} {unit}"));
            }
        }
    }
    for pair in curves.iter().flat_map(|curve| curve.windows(2)).filter(|pair| pair[0].fine()) {
        if change(pair).abs() > CHANGE_BOUND {
            let (case, from) = (pair[1].name(), millimetres(pair[0].spacing));
            let change = change(pair);
            lines.push(format!(
                "{case}: F* {change:+.4} % from that of {from} mm, bound {CHANGE_BOUND} %"
            ));
        }
    }
    lines
}

/// The slope of log |error| over log spacing by least squares. It takes the errors that are large
/// enough and have the first one's sign: the others are where two errors cancel.
fn order(curve: &[Case], place: usize) -> Option<f64> {
    let sign = curve[0].errors[place]?.signum();
    let log = |case: &Case| {
        let error = sign * case.errors[place]?;
        (error > LEAST[place]).then(|| [case.spacing.ln(), error.ln()])
    };
    let logs: Vec<_> = curve.iter().filter_map(log).collect();
    let mean = |i: usize| logs.iter().map(|log| log[i]).sum::<f64>() / logs.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let xy: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
    let xx: f64 = logs.iter().map(|log| (log[0] - x).powi(2)).sum();
    (logs.len() > 1).then(|| xy / xx)
}

fn csv(curves: &[&[Case]]) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header: Vec<_> = KEYS.into();
    header.extend(["particle_spacing_m", "sound_speed_ratio", "crest_error_percent"]);
    header.extend(["first_force_error_percent", "first_runup_error_h"]);
    header.extend(["displacement_error_percent", "seconds"]);
    writer.write_record(header)?;
    for case in curves.iter().copied().flatten() {
        let text = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
        let mut cells: Vec<_> = case.keys.map(text).into();
        cells.extend([case.spacing.to_string(), text(case.sound)]);
        cells.extend(case.errors.map(|error| told(error, 4)));
        cells.push(format!("{:.1}", case.seconds));
        writer.write_record(cells)?;
    }
    Ok(writer.into_inner()?)
}

fn told(value: Option<f64>, digits: usize) -> String {
    value.map(|value| format!("{value:+.digits$}")).unwrap_or_default()
}

/// A Markdown table under its heading.
fn table(heading: &str, header: &[String], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text =
        format!("\n{heading}\n\n| {} |\n|{}\n", header.join(" | "), "---|".repeat(header.len()));
    rows.into_iter().for_each(|row| text += &format!("| {} |\n", row.join(" | ")));
    text
}

/// The tables of one reading: its error, and the order of that, over the spacing.
fn reading(curves: &[&[Case]], place: usize) -> String {
    let (Compared { name, unit, .. }, least) = (COMPARED[place], LEAST[place]);
    let curves = || {
        let usual = |curve: &&&[Case]| curve[0].sound.is_none() && curve[0].errors[place].is_some();
        curves.iter().filter(usual)
    };
    let mut spacings: Vec<_> = curves().copied().flatten().map(|case| case.spacing).collect();
    spacings.sort_by(|a, b| b.total_cmp(a));
    spacings.dedup();
    let header = |middle: &[&str], cells: Vec<String>| {
        middle.iter().map(|&cell| cell.to_owned()).chain(cells).collect::<Vec<_>>()
    };
    let mm = |spacing: f64| millimetres(spacing).to_string();
    let single = spacings.iter().map(|&spacing| mm(spacing)).collect();
    let errors = curves().map(|curve| {
        let at = |&spacing: &f64| curve.iter().find(|case| case.spacing == spacing);
        let digits = if place == RUNUP { 4 } else { 2 };
        let error = |spacing| told(at(spacing).and_then(|case| case.errors[place]), digits);
        header(&[&curve[0].wall()], spacings.iter().map(error).collect())
    });
    let heading = format!("## {name}\n\nError, {unit}, over the spacing, mm:");
    let text = table(&heading, &header(&["wall"], single), errors);
    let orders = curves().map(|curve| {
        let pair = |ends: &[f64]| {
            let pair = curve.windows(2).find(|pair| pair[0].spacing == ends[0])?;
            order(pair, place).filter(|_| pair[1].spacing == ends[1])
        };
        let pairs = spacings.windows(2).map(|ends| told(pair(ends), 1)).collect();
        header(&[&curve[0].wall(), &told(order(curve, place), 1)], pairs)
    });
    let double = spacings.windows(2).map(|s| format!("{} to {}", mm(s[0]), mm(s[1]))).collect();
    let heading = format!("Order, where errors are above {least} {unit} and of one sign:");
    text + &table(&heading, &header(&["wall", "all"], double), orders)
}

/// Errors at several sound speeds.
fn over_sound(curves: &[&[Case]]) -> String {
    let cases: Vec<_> = curves.iter().copied().flatten().collect();
    let mut sounds: Vec<_> = cases.iter().filter_map(|case| case.sound).collect();
    sounds.sort_by(f64::total_cmp);
    sounds.dedup();
    let shown = [(CREST, 2), (FORCE, 2), (RUNUP, 4)];
    let mut header = vec!["wall".to_owned(), "mm".to_owned()];
    for (place, _) in shown {
        let Compared { name, unit, .. } = COMPARED[place];
        header.extend(sounds.iter().map(|sound| format!("{name}, {unit}, {sound}")));
    }
    let loud =
        cases.iter().filter(|case| case.sound.is_some() && case.sound == sounds.first().copied());
    let rows = loud.filter_map(|case| {
        let at = |sound| {
            let same =
                |c: &&&Case| (c.keys, c.spacing, c.sound) == (case.keys, case.spacing, Some(sound));
            cases.iter().find(same).copied()
        };
        let found: Vec<_> = sounds.iter().map(|&sound| at(sound)).collect();
        found.iter().skip(1).any(Option::is_some).then(|| {
            let mut cells = vec![case.wall(), millimetres(case.spacing).to_string()];
            for (place, digits) in shown {
                let error = |case: &Option<&Case>| told(case.and_then(|c| c.errors[place]), digits);
                cells.extend(found.iter().map(error));
            }
            cells
        })
    });
    table("## Error over the sound speed ratio", &header, rows)
}

fn page(curves: &[&[Case]], broken: &[String]) -> String {
    let mut text = "# Convergence\n\nWritten by `scripts/convergence`. Errors are against potential \
        theory of the same tank\n(`results/potential`), in percent or, for runup, in h. The sound speed ratio is \
        8 at 16 mm and goes as\n1/√Δx, but where one is named.\n\nA negative order is that of an error which \
        grows. Points on the lower edge of a panel are there or below.\n\n\
        ![Errors over the spacing](convergence.svg)\n"
        .to_owned();
    (0..COMPARED.len()).for_each(|place| text += &reading(curves, place));
    text += &over_sound(curves);
    let rows = curves.iter().map(|curve| {
        let largest = |fine: bool| {
            let pairs = curve.windows(2).filter(|pair| !fine || pair[0].fine());
            told(pairs.map(change).max_by(|a, b| a.abs().total_cmp(&b.abs())), 2)
        };
        let sound = curve[0].sound.map_or_else(|| "8 √(16 mm/Δx)".to_owned(), |s| s.to_string());
        vec![curve[0].wall(), sound, largest(false), largest(true)]
    });
    let header = ["wall", "sound speed ratio", "all, %", "from 8 mm down, %"].map(str::to_owned);
    text += &table("## Largest change of F* between neighbouring spacings", &header, rows);
    text += "\n## Bounds\n\n";
    text += if broken.is_empty() { "All hold.\n" } else { "Broken:\n\n" };
    broken.iter().for_each(|line| text += &format!("- {line}\n"));
    text
}

fn run() -> Result<bool> {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    ensure!(arguments.len() >= 3, "needed: POTENTIAL_DIR OUT_DIR RUN_DIR...");
    let (potential, out) = (Path::new(&arguments[0]), Path::new(&arguments[1]));
    let mut truths = read(&potential.join("fixed.csv"))?;
    truths.extend(read(&potential.join("tank.csv"))?);
    let (mut cases, mut faults) = (Vec::new(), Vec::new());
    for row in summaries(&arguments[2..])? {
        let text = |column| text(&row, column);
        if text("status") == "ok" {
            cases.push(Case::new(&row, &truths).with_context(|| text("case_id").to_owned())?);
        } else {
            let (values, spacing) = (KEYS.map(text).join(", "), text("particle_spacing_m"));
            faults.push(format!("{values}, {spacing} m: {}", text("reason")));
        }
    }
    ensure!(!cases.is_empty(), "no case has finished");
    let place = |case: &Case| {
        let [wave, k, m] = case.keys.map(|key| key.unwrap_or(-1.0));
        [f64::from(u8::from(k >= 0.0)), wave, k, m, case.sound.unwrap_or(0.0), -case.spacing]
    };
    cases.sort_by(|a, b| place(a).partial_cmp(&place(b)).expect("keys are numbers"));
    let curves: Vec<_> = cases.chunk_by(|a, b| (a.keys, a.sound) == (b.keys, b.sound)).collect();
    faults.extend(broken(&curves));
    std::fs::create_dir_all(out)?;
    std::fs::write(out.join("convergence.csv"), csv(&curves)?)?;
    std::fs::write(out.join("convergence.md"), page(&curves, &faults))?;
    let drawn = figure::draw(&curves, &out.join("convergence.svg"));
    drawn.map_err(|fault| anyhow::anyhow!("cannot draw the figure: {fault}"))?;
    for fault in &faults {
        eprintln!("convergence: {fault}");
    }
    let [cases, bounds] = [counted(cases.len(), "case"), counted(faults.len(), "bound")];
    println!("{cases}, {bounds} broken");
    Ok(faults.is_empty())
}

fn main() -> ExitCode {
    common::exit("convergence", run())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fixed wall whose errors are of second order, `share` of F* and R* at 16 mm.
    fn curve(wave: f64, share: f64) -> Vec<Case> {
        let case = |spacing: f64| {
            let error = share * (spacing / 0.016).powi(2);
            let errors = [Some(0.0), Some(100.0 * error), Some(error), None];
            let keys = [Some(wave), None, None];
            Case { keys, spacing, sound: None, force: 3.0 * (1.0 + error), errors, seconds: 1.0 }
        };
        [0.016, 0.008, 0.004].map(case).into()
    }

    #[test]
    fn the_order_is_read_off_errors_that_are_large_enough() {
        let curve = curve(0.5, 0.016); // 1.6 %, 0.4 % and 0.1 %
        assert!((order(&curve, FORCE).unwrap() - 2.0).abs() < 1e-9);
        assert_eq!((order(&curve[1..], FORCE), order(&curve, RUNUP)), (None, None));
    }

    #[test]
    fn a_planted_error_breaks_its_bound_by_name() {
        assert!(broken(&[&curve(0.5, 0.011)]).is_empty());
        let lines = broken(&[&curve(0.5, 0.04)]); // 1 % at 8 mm, 0.25 % at 4 mm
        let expected = [
            "H/h 0.5, fixed, 8 mm: first F* +1.0000 %, bound 0.3 %",
            "H/h 0.5, fixed, 4 mm: F* -0.7426 % from that of 8 mm, bound 0.3 %",
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn what_is_missing_breaks_its_bound() {
        let mut curve = curve(0.6, 0.016);
        curve[1].errors[RUNUP] = None;
        assert_eq!(broken(&[&curve]), ["H/h 0.6, fixed, 8 mm: first R* NaN h, bound 0.04 h"]);
    }
}
