//! Puts solitary waves at walls behind slopes beside potential theory: what two kinds of ghosts make of runup and
//! force, over the spacing.
//!
//!     cargo run --release --example foreshores -- RUNS OUT.md
//!
//! RUNS holds the studies of `sweeps/foreshores`, each in a folder, and beside it theory's level at the wall, in a file
//! named by the folder and H/h. `scripts/foreshores` makes both.

mod common;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use common::{Row, number, parabola_top, read, text};

const GHOSTS: [&str; 2] = ["in-sum", "falling"];
/// The still water's depth in all of these scenes, metres.
const DEPTH: f64 = 0.2;

const HEAD: &str = "# Walls behind slopes\n
Made by `scripts/foreshores` from `sweeps/foreshores`: solitary waves in 0.2 m of water at an upright wall behind a slope.
Theory is fully nonlinear potential flow over the same bed, from the same stroke (`examples/potential_flume`). It has no
particles and no constants. `in-sum` ghosts take all water to be at rest. `falling` ones, the default here, know how heavy
the water is along the wall. The first table tells how far the first R\\* is from theory, in h.\n";

const FORCE: &str = "The first F\\*, for which this theory has no number. Where it no longer moves with the spacing it is right.";

fn main() -> Result<()> {
    let arguments: Vec<PathBuf> = std::env::args().skip(1).map(PathBuf::from).collect();
    let [runs, out] = &arguments[..] else { bail!("give RUNS and OUT.md") };
    let entries = fs::read_dir(runs).with_context(|| runs.display().to_string())?;
    let mut folders: Vec<_> =
        entries.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    folders.retain(|path| path.is_dir());
    folders.sort();
    let (mut runups, mut forces, mut spacings) = (String::new(), String::new(), Vec::new());
    for folder in &folders {
        let rows = read(&folder.join("summary.csv"))?;
        let bed = folder.file_name().and_then(|name| name.to_str()).context("a folder's name")?;
        spacings = distinct(&rows, "particle_spacing_m");
        spacings.sort_by(|a, b| b.total_cmp(a));
        for height in distinct(&rows, "wave_height_ratio") {
            let theory = highest(&runs.join(format!("{bed}_{height}.csv")))? / DEPTH;
            for ghosts in GHOSTS {
                let is_of = |row: &&Row| {
                    number(row, "wave_height_ratio") == Some(height)
                        && text(row, "ghost_gravity") == ghosts
                };
                let of: Vec<_> = rows.iter().filter(is_of).collect();
                let apart = |runup: f64| format!("{:+.3}", runup - theory);
                let apart = cells(&of, &spacings, "first_runup_max", apart);
                writeln!(runups, "| {bed} | {height} | {theory:.3} | {ghosts} | {apart} |")?;
                let force = cells(&of, &spacings, "first_force_max", |force| format!("{force:.3}"));
                writeln!(forces, "| {bed} | {height} | {ghosts} | {force} |")?;
            }
        }
    }
    let told = |spacing: &f64| format!("{:.1} mm", 1e3 * spacing);
    let heads = spacings.iter().map(told).collect::<Vec<_>>().join(" | ");
    let rule = "---|".repeat(spacings.len());
    let page = format!(
        "{HEAD}\n## Runup\n\n| bed | H/h | R\\* by theory, h | ghosts | {heads} |\n|---|---|---|---|{rule}\n{runups}\n\
         ## Force\n\n{FORCE}\n\n| bed | H/h | ghosts | {heads} |\n|---|---|---|{rule}\n{forces}"
    );
    fs::write(out, page).with_context(|| out.display().to_string())
}

/// Cells of a table: a column of the rows with these spacings.
fn cells(rows: &[&Row], spacings: &[f64], column: &str, tell: impl Fn(f64) -> String) -> String {
    let of = |spacing| {
        rows.iter().find(|row| number(row, "particle_spacing_m") == Some(spacing)).copied()
    };
    let cell = |&spacing: &f64| of(spacing).and_then(|row| number(row, column)).map(&tell);
    spacings.iter().map(|spacing| cell(spacing).unwrap_or_default()).collect::<Vec<_>>().join(" | ")
}

/// The values of a column, in their order.
fn distinct(rows: &[Row], column: &str) -> Vec<f64> {
    let mut values = Vec::new();
    for value in rows.iter().filter_map(|row| number(row, column)) {
        if !values.contains(&value) {
            values.push(value);
        }
    }
    values
}

/// The highest level of a record, metres: the top of the parabola through the highest sample and its neighbours.
fn highest(path: &Path) -> Result<f64> {
    let rows = read(path)?;
    let levels: Vec<f64> = rows.iter().filter_map(|row| number(row, "wall_m")).collect();
    let top = (0..levels.len()).max_by(|&a, &b| levels[a].total_cmp(&levels[b]));
    let top = top.with_context(|| format!("{}: no level", path.display()))?;
    let Some([before, here, after]) = top.checked_sub(1).and_then(|k| levels[k..].first_chunk())
    else {
        bail!("{}: highest at its end", path.display());
    };
    Ok(parabola_top([*before, *here, *after]).1)
}

#[cfg(test)]
mod tests {
    use super::parabola_top;

    #[test]
    fn the_top_lies_between_samples() {
        let curve = |t: f64| 0.3 - 2.0 * (t - 0.02).powi(2);
        let (share, top) = parabola_top([-0.05, 0.0, 0.05].map(curve));
        assert!((share - 0.4).abs() < 1e-12 && (top - 0.3).abs() < 1e-12);
        assert_eq!(parabola_top([0.1; 3]), (0.0, 0.1));
    }
}
