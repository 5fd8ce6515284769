//! Puts runs of the 1995 flume beside its measurements: a table and a figure for each case.
//!
//!     cargo run --release --example experiments -- RUNS results/experiments
//!
//! RUNS holds a folder for each run, named by case and spacing: `b_0.0152`.

mod common;

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use common::parabola_top;
use plotters::prelude::*;

/// A crest counts from this share of the record's highest level on, and is over after this time, s.
const RISEN: f64 = 0.6;
const CREST_LASTS: f64 = 1.0;
const GAUGES: [u32; 7] = [4, 5, 6, 7, 8, 9, 10];

type Failed = Box<dyn Error>;
/// Times, s, and the surface over still water, m, by gauge.
type Record = BTreeMap<u32, Vec<(f64, f64)>>;

fn main() -> Result<(), Failed> {
    let arguments: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    let [runs, out] = &arguments[..] else { return Err("give RUNS and OUT".into()) };
    let mut page = String::from(HEAD);
    let mut folders: Vec<_> = fs::read_dir(runs)?.collect::<Result<_, _>>()?;
    folders.sort_by_key(fs::DirEntry::file_name);
    for folder in folders {
        let name = folder.file_name().into_string().unwrap_or_default();
        let Some(case) = name.get(..1).filter(|case| "abc".contains(case)) else { continue };
        let row = summary(&folder.path())?;
        let cell = |column: &str| row.get(column).cloned().unwrap_or_default();
        let runup = cell("runup_max").parse::<f64>().unwrap_or(f64::NAN);
        writeln!(
            page,
            "\n## Case {}, {} mm\n\n{}: {} particles, {} steps, {:.0} s. Energy gap {:.1} %. Highest runup {:.3} h, {:.3} m. {}",
            case.to_uppercase(),
            1e3 * cell("particle_spacing_m").parse::<f64>()?,
            cell("status"),
            cell("particles"),
            cell("steps"),
            cell("wall_time_s").parse().unwrap_or(f64::NAN),
            cell("energy_gap_percent").parse().unwrap_or(f64::NAN),
            runup,
            runup * 0.218,
            cell("reason"),
        )?;
        let computed = record(&probes(&folder.path())?)?;
        let theory = record(&out.join(format!("usace_1995/potential_{case}.csv")))?;
        let measured = match case {
            "c" => None,
            _ => Some(record(&out.join(format!("usace_1995/gauges_{case}.csv")))?),
        };
        compare(&mut page, &computed, &theory, measured.as_ref())?;
        let sheet = out.join(format!("usace_1995/case_{name}.svg"));
        draw([&computed, &theory], measured.as_ref(), &sheet)?;
        writeln!(page, "\n![surface over still water](usace_1995/case_{name}.svg)")?;
    }
    Ok(fs::write(out.join("experiments.md"), page)?)
}

const HEAD: &str = "# Held against experiments

Made by `scripts/experiments`. Nothing is shifted in time and no constant is set for it.

The flume of the US Army Corps of Engineers, 1995 (Briggs et al.; benchmark 3 of that year's workshop, benchmark 5 of
the NTHMP suite): 23.2 m, still water 0.218 m deep, slopes of 1:53, 1:150 and 1:13, a vertical wall. The paddle plays its
measured stroke. `usace_1995/` holds what was measured, public data of a public body. Measured runups are 0.0274 m
(0.13 h) in case A and 0.4572 m (2.10 h), a thin jet, in case B. Case C breaks on the slope; its measurements are not
here, so its rows are predictions.

Gauge 4 stands at 12.64, 14.06 and 14.40 m in the cases A, B and C. Gauge 10's record of case B is cut off at 0.0533 m.
A crest is the top of the parabola through the highest level within a second after the surface first passes 0.6 of the
record's maximum, and its neighbours. The water
loses nothing to the glass and the bed in these runs. By Keulegan's formula for a smooth, wide channel a solitary wave of
case B loses some 5 % of its height over the 15 m before the slopes.

Theory is fully nonlinear potential flow over the same bed from the same stroke (`examples/potential_flume`), up to where
its surface gets steeper than 1.5. It has no particles and no constants. So what a run and theory share, and the
measurements do not, is in the stroke or in the flume.
";

fn summary(folder: &Path) -> Result<BTreeMap<String, String>, Failed> {
    let mut reader = csv::Reader::from_path(folder.join("summary.csv"))?;
    Ok(reader.deserialize().next().ok_or("an empty summary")??)
}

/// The one table of probes in a run's folder.
fn probes(folder: &Path) -> Result<PathBuf, Failed> {
    let files = fs::read_dir(folder.join("probes"))?.filter_map(Result::ok).map(|file| file.path());
    let mut tables = files.filter(|path| !path.ends_with("columns.csv"));
    tables.next().ok_or_else(|| "no table of probes".into())
}

fn record(path: &Path) -> Result<Record, Failed> {
    let mut record = Record::new();
    for row in csv::Reader::from_path(path)?.deserialize() {
        let row: BTreeMap<String, f64> = row?;
        for gauge in GAUGES {
            let level = row[&format!("gauge_{gauge}_m")];
            record.entry(gauge).or_default().push((row["time_s"], level));
        }
    }
    Ok(record)
}

fn crest(series: &[(f64, f64)]) -> Option<(f64, f64)> {
    let highest = series.iter().map(|row| row.1).fold(0.0, f64::max);
    let from = series.iter().position(|row| row.1 > RISEN * highest)?;
    let lasts = series[from..].iter().take_while(|row| row.0 <= series[from].0 + CREST_LASTS);
    let top = from + lasts.enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1))?.0;
    // What was not seen to fall is no crest.
    let (before, here, after) =
        (series.get(top.wrapping_sub(1))?, series[top], series.get(top + 1)?);
    let (share, height) = parabola_top([before.1, here.1, after.1]);
    Some((here.0 + share * (after.0 - here.0), height))
}

fn compare(
    page: &mut String,
    computed: &Record,
    theory: &Record,
    measured: Option<&Record>,
) -> Result<(), Failed> {
    page.push_str("\n| gauge | crest, m | theory | off | measured | off | at, s | theory | measured | rms, mm |\n");
    page.push_str("|---|---|---|---|---|---|---|---|---|---|\n");
    for (gauge, series) in computed {
        let Some((time, level)) = crest(series) else { continue };
        let beside = |record: Option<&Record>| record.and_then(|all| crest(all.get(gauge)?));
        let cells = [beside(Some(theory)), beside(measured)].map(|found| match found {
            Some((at, high)) => (
                format!("{high:.4} | {:+.1} %", 100.0 * (level / high - 1.0)),
                format!("{at:.2} ({:+.2})", time - at),
            ),
            None => (String::from(" | "), String::new()),
        });
        let rms =
            measured.map_or(String::new(), |all| format!("{:.1}", 1e3 * rms(series, &all[gauge])));
        let [(theory, theory_at), (measured, measured_at)] = cells;
        writeln!(
            page,
            "| {gauge} | {level:.4} | {theory} | {measured} | {time:.2} | {theory_at} | {measured_at} | {rms} |"
        )?;
    }
    Ok(())
}

/// Root mean square of the difference at the measured times that were computed.
fn rms(computed: &[(f64, f64)], measured: &[(f64, f64)]) -> f64 {
    let squares: Vec<f64> = measured
        .iter()
        .filter_map(|&(time, level)| {
            let after = computed.partition_point(|row| row.0 < time);
            let ([before, next], part) = match (after.checked_sub(1), computed.get(after)) {
                (Some(before), Some(next)) => {
                    let before = computed[before];
                    ([before.1, next.1], (time - before.0) / (next.0 - before.0))
                }
                _ => return None,
            };
            Some((before + part * (next - before) - level).powi(2))
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

fn draw(
    [computed, theory]: [&Record; 2],
    measured: Option<&Record>,
    path: &Path,
) -> Result<(), Failed> {
    let sheet = SVGBackend::new(path, (900, 1120)).into_drawing_area();
    sheet.fill(&WHITE)?;
    for (panel, gauge) in sheet.split_evenly((7, 1)).into_iter().zip(GAUGES) {
        let ours = &computed[&gauge];
        let theirs = measured.map(|all| &all[&gauge]);
        let all = ours.iter().chain(theirs.into_iter().flatten());
        let [low, high] =
            all.fold([0.0_f64; 2], |[low, high], row| [low.min(row.1), high.max(row.1)]);
        let room = 0.08 * (high - low).max(1e-3);
        let mut chart = ChartBuilder::on(&panel)
            .margin(6)
            .x_label_area_size(28)
            .y_label_area_size(66)
            .build_cartesian_2d(265.0..284.0, low - room..high + room)?;
        chart
            .configure_mesh()
            .x_labels(10)
            .y_labels(5)
            .y_desc(format!("gauge {gauge}, m"))
            .x_desc(if gauge == 10 {
                "clock, s; black: measured, orange: theory, blue: computed"
            } else {
                ""
            })
            .label_style(("sans-serif", 14))
            .light_line_style(WHITE)
            .draw()?;
        let within = |row: &&(f64, f64)| row.0 >= 265.0 && row.0 <= 284.0;
        if let Some(theirs) = theirs {
            let points = theirs.iter().filter(within).copied();
            chart.draw_series(LineSeries::new(points, BLACK.stroke_width(2)))?;
        }
        if let Some(theirs) = theory.get(&gauge) {
            let points = theirs.iter().filter(within).copied();
            let orange = RGBColor(213, 94, 0);
            chart.draw_series(DashedLineSeries::new(points, 5, 4, orange.stroke_width(2)))?;
        }
        let points = ours.iter().filter(within).copied();
        chart.draw_series(LineSeries::new(points, RGBColor(0, 114, 178).stroke_width(2)))?;
    }
    Ok(sheet.present()?)
}
