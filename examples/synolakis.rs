//! Puts runs of solitary waves on a beach beside the measurements of Synolakis 1987: a table over the spacing, and a figure.
//!
//!     cargo run --release --example synolakis -- RUNS results/experiments
//!
//! RUNS holds folders whose names begin with `synolakis_`, each with a `summary.csv`.

mod common;

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use common::{number, read};
use plotters::prelude::*;

type Failed = Box<dyn Error>;
/// H/h, R/h and the spacing over h.
type Runup = [f64; 3];

/// What was measured counts beside a run where H/h is within this share of its own.
const NEAR: f64 = 0.15;
const DEPTH: f64 = 0.3;

fn main() -> Result<(), Failed> {
    let arguments: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    let [runs, out] = &arguments[..] else { return Err("give RUNS and OUT".into()) };
    let measured: Vec<Runup> = {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_path(out.join("synolakis_1987/runup.csv"))?;
        reader.deserialize().collect::<Result<_, _>>()?
    };
    let mut computed = Vec::new();
    let mut folders: Vec<_> = fs::read_dir(runs)?.collect::<Result<_, _>>()?;
    folders.sort_by_key(fs::DirEntry::file_name);
    let mut rows = Vec::new();
    for folder in folders {
        if !folder.file_name().to_string_lossy().starts_with("synolakis_") {
            continue;
        }
        for row in read(&folder.path().join("summary.csv"))? {
            let (Some(height), Some(runup), Some(spacing)) = (
                number(&row, "wave_height_ratio"),
                number(&row, "runup_max"),
                number(&row, "particle_spacing_m").map(|spacing| spacing / DEPTH),
            ) else {
                continue;
            };
            computed.push([height, runup, spacing]);
            let seconds = number(&row, "wall_time_s").unwrap_or(f64::NAN);
            rows.push(([height, runup, spacing], seconds));
        }
    }
    rows.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(b[2].total_cmp(&a[2])));
    let mut page = String::from(HEAD);
    for ([height, runup, spacing], seconds) in rows {
        let near: Vec<f64> = measured
            .iter()
            .filter(|row| (row[0] / height - 1.0).abs() < NEAR)
            // To the same height, as R goes with H^0.58 where waves break and with H^1.25 where not.
            .map(|row| row[1] * (height / row[0]).powf(if height > 0.045 { 0.58 } else { 1.25 }))
            .collect();
        let mean = near.iter().sum::<f64>() / near.len() as f64;
        writeln!(
            page,
            "| {height} | {:.1} | {spacing:.4} | {runup:.3} | {mean:.3} ({}) | {:+.0} % | {seconds:.0} |",
            1e3 * spacing * DEPTH,
            near.len(),
            100.0 * (runup / mean - 1.0)
        )?;
    }
    page.push_str(FOOT);
    draw(&computed, &measured, &out.join("synolakis_1987/runup.svg"))?;
    Ok(fs::write(out.join("synolakis.md"), page)?)
}

const HEAD: &str = "# Solitary waves on a beach of 1:19.85

Made by `scripts/experiments` from `sweeps/synolakis_1987.toml`, still water 0.3 m deep. What was measured is Synolakis's
(1987), brought to the height of the run from heights within 15 % of it; in brackets from how many. Runups are told where
the tongue is 7.5 mm thick, 0.025 h (`runup_thickness_m`). The times are those of a machine that did other work, too.

| H/h | spacing, mm | spacing, h | runup, h | measured, h | off | run, s |
|---|---|---|---|---|---|---|
";

const FOOT: &str = "
![runup over height](synolakis_1987/runup.svg)

The wave that arrives is right: at 15 mm and 3 m from the paddle its crest is 0.0997 and 0.2976 h of 0.1 and 0.3 h, and
0.104 and 0.298 h at the beach's foot. What was measured is the tip of the tongue, which has friction. By the equations of
shallow water without friction water of 0.05, 0.025 and 0.0125 h thickness gets 0.10, 0.21 and 0.30 h up at H/h = 0.1, and
0.26, 0.44 and 0.61 h at 0.3. So a runup means something with a thickness alone. Where the tongue is one spacing thick it is
0.107, 0.200 and 0.412 h at 15 mm for the three waves, and 0.138, 0.278 and 0.560 h at 7.5 mm.
";

fn draw(computed: &[Runup], measured: &[Runup], path: &std::path::Path) -> Result<(), Failed> {
    let sheet = SVGBackend::new(path, (720, 520)).into_drawing_area();
    sheet.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&sheet)
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d((0.004..0.7).log_scale(), (0.01..1.2).log_scale())?;
    chart
        .configure_mesh()
        .x_desc("H/h; circles: measured, blue: computed, darker where finer")
        .y_desc("runup over h")
        .label_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .draw()?;
    let circle = |row: &Runup| Circle::new((row[0], row[1]), 4, BLACK.stroke_width(1));
    chart.draw_series(measured.iter().map(circle))?;
    let finest = computed.iter().map(|row| row[2]).fold(f64::INFINITY, f64::min);
    let dot = |row: &Runup| {
        let strength = finest / row[2];
        Circle::new((row[0], row[1]), 5, RGBColor(0, 114, 178).mix(strength).filled())
    };
    chart.draw_series(computed.iter().map(dot))?;
    Ok(sheet.present()?)
}
