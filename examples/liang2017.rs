//! What the tables of `results/liang2017` say, beside theory and what Liang et al. 2017 print:
//!
//! `cargo run --release --example liang2017 -- RESULTS_DIR POTENTIAL_DIR`
//!
//! Reads the tables that `scripts/liang2017` writes, and writes `RESULTS_DIR/liang2017.md`. A table that is
//! not there is left out.

mod common;
#[allow(dead_code)]
#[path = "common/runs.rs"]
mod runs;

use std::fs;
use std::path::Path;

use anyhow::{Result, ensure};
use common::{KEYS, Row, number, read};
use runs::{Table, markdown};
use seawall::papers::{Printed, Span, printed};

/// What the paper prints, our columns, and how it is told; what stands at a time is printed of the end.
const PRINTED: [[&str; 3]; 6] = [
    ["first_force_max", "first_force_max", "F*"],
    ["first_runup_max", "first_runup_max", "R*"],
    ["displacement_max", "displacement_max", "X*"],
    ["force", "force_end", "F* at the end"],
    ["runup", "runup_end", "R* at the end"],
    ["displacement", "displacement_end", "X* at the end"],
];

fn rounded(value: Option<f64>, digits: usize) -> String {
    value.map(|value| format!("{value:.digits$}")).unwrap_or_default()
}

fn header(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|&cell| cell.to_owned()).collect()
}

/// The row of a table that is of the same case.
fn beside<'a>(row: &Row, table: &'a [Row]) -> Option<&'a Row> {
    table.iter().find(|other| KEYS.iter().all(|key| number(row, key) == number(other, key)))
}

fn percent(ours: Option<f64>, theirs: Option<f64>) -> Option<f64> {
    Some(100.0 * (ours? / theirs? - 1.0))
}

/// Force and runup at fixed walls beside potential theory.
fn fixed(rows: &[Row], truths: &[Row]) -> Table {
    let mut table = vec![header(&[
        "H/h",
        "F*",
        "theory",
        "difference, %",
        "R*",
        "theory",
        "difference, h",
        "energy gap, %",
    ])];
    table.extend(rows.iter().map(|row| {
        let truth = beside(row, truths);
        let theory = |column| truth.and_then(|truth| number(truth, column));
        let [force, runup] =
            ["first_force_max", "first_runup_max"].map(|name| [number(row, name), theory(name)]);
        vec![
            row[KEYS[0]].clone(),
            rounded(force[0], 4),
            rounded(force[1], 4),
            rounded(percent(force[0], force[1]), 2),
            rounded(runup[0], 4),
            rounded(runup[1], 4),
            rounded(runup[0].zip(runup[1]).map(|(a, b)| a - b), 4),
            rounded(number(row, "energy_gap_percent"), 2),
        ]
    }));
    table
}

/// The largest errors of both schemes against theory, by wave height.
fn schemes(rows: &[Row], truths: &[Row]) -> Table {
    let names =
        ["isph F*, %", "isph X*, %", "isph R*, h", "wcsph F*, %", "wcsph X*, %", "wcsph R*, h"];
    let mut table = vec![header(&[&["H/h", "walls"], &names[..]].concat())];
    for wave in rows.chunk_by(|a, b| a[KEYS[0]] == b[KEYS[0]]) {
        let mut cells = vec![wave[0][KEYS[0]].clone(), wave.len().to_string()];
        for scheme in ["isph", "wcsph"] {
            for column in ["first_force_max", "displacement_max", "first_runup_max"] {
                let error = |row: &Row| {
                    let ours = number(row, &format!("{scheme}_{column}"))?;
                    let theory = number(beside(row, truths)?, column)?;
                    let runup = column == "first_runup_max";
                    Some(if runup { ours - theory } else { 100.0 * (ours / theory - 1.0) })
                };
                let largest =
                    wave.iter().filter_map(error).max_by(|a, b| a.abs().total_cmp(&b.abs()));
                cells.push(rounded(largest, if column == "first_runup_max" { 4 } else { 2 }));
            }
        }
        table.push(cells);
    }
    table
}

/// Every printed number of a movable wall beside ours with both factors, and potential theory's.
fn movable(ours: &[Row], truths: &[Row]) -> Table {
    let mut table = vec![header(&[
        "source",
        "H/h, k, m",
        "quantity",
        "printed",
        "s = 1",
        "s = 0.4",
        "theory, s = 1",
    ])];
    let theirs = |number: &&Printed| number.paper == "liang2017" && number.scene == "movable";
    for row in printed().iter().filter(theirs) {
        let Some(case) = case(row) else { continue };
        let Some([_, column, words]) = PRINTED.into_iter().find(|of| of[0] == row.quantity) else {
            continue;
        };
        let of = |coupling: f64| {
            let coupled = |ours: &&Row| number(ours, "force_coupling") == Some(coupling);
            let ours: Vec<Row> = ours.iter().filter(coupled).cloned().collect();
            number(beside(&case, &ours)?, column)
        };
        if of(1.0).is_none() {
            continue; // one that was not run
        }
        let truth = beside(&case, truths);
        table.push(vec![
            format!("Fig. {}", row.figure),
            KEYS.map(|key| case[key].clone()).join(", "),
            words.to_owned(),
            row.value.to_string(),
            rounded(of(1.0), 3),
            rounded(of(0.4), 3),
            rounded(truth.and_then(|truth| number(truth, column)), 3),
        ]);
    }
    table
}

/// The case that a number is printed for; of a range the end that is told.
fn case(printed: &Printed) -> Option<Row> {
    let told = |span: Option<Span>| {
        let Span { low, high } = span?;
        Some(if low.is_finite() { low } else { high }.to_string())
    };
    let values = [
        told(printed.wave_height_ratio)?,
        told(printed.spring_stiffness_n_per_m)?,
        told(printed.seawall_mass_kg_per_m)?,
    ];
    Some(KEYS.iter().zip(values).map(|(key, value)| ((*key).to_owned(), value)).collect())
}

/// Force and level of still water at the end.
fn still(rows: &[Row]) -> Table {
    let columns = [
        "particle_spacing_m",
        "still_water_depth_m",
        "force_end",
        "runup_end",
        "energy_gap_percent",
    ];
    let given = columns.into_iter().filter(|name| rows.iter().any(|row| row.contains_key(*name)));
    let names: Vec<&str> = given.collect();
    let mut table = vec![header(&names)];
    table.extend(rows.iter().map(|row| names.iter().map(|name| row[*name].clone()).collect()));
    table
}

/// How many of the coarse runs end well, and between what their energy gaps lie.
fn coarse(rows: &[Row]) -> String {
    let well = rows.iter().filter(|row| row["status"] == "ok").count();
    let mut gaps: Vec<f64> =
        rows.iter().filter_map(|row| number(row, "energy_gap_percent")).collect();
    gaps.sort_by(f64::total_cmp);
    let [least, most] = [gaps.first(), gaps.last()].map(|gap| rounded(gap.copied(), 2));
    format!("{well} of {} end well; energy gaps from {least} to {most} %.\n", rows.len())
}

fn page(results: &Path, potential: &Path) -> Result<String> {
    let mut truths = read(&potential.join("fixed.csv"))?;
    truths.extend(read(&potential.join("tank.csv"))?);
    let tables = |names: &[&str]| {
        let paths = names.iter().map(|name| results.join(format!("{name}.csv")));
        let rows = paths.filter(|path| path.exists()).map(|path| read(&path));
        Ok::<_, anyhow::Error>(rows.collect::<Result<Vec<_>>>()?.concat())
    };
    let mut text = "# Liang et al. 2017 by incompressible SPH: what the tables say\n\nWritten by `scripts/liang2017`. \
        Theory is potential theory of the same tank (`results/potential`).\n"
        .to_owned();
    for [name, title] in [
        ["fixed_wall", "Fixed walls (Figs. 3 and 5), 8 mm"],
        ["fixed_wall_16mm", "Fixed walls, 16 mm"],
    ] {
        text += &format!("\n## {title}\n\n{}", markdown(&fixed(&tables(&[name])?, &truths)));
    }
    for [name, spacing] in [["agreement", "8 mm"], ["agreement_16mm", "16 mm"]] {
        text += &format!(
            "\n## Movable walls by both schemes, {spacing}: largest errors against theory\n\n{}",
            markdown(&schemes(&tables(&[name])?, &truths))
        );
    }
    let ours = tables(&["single_wall", "wave_height", "stiffness", "mass"])?;
    let printed = movable(&ours, &truths);
    text += &format!("\n## Movable walls beside what the paper prints\n\n{}", markdown(&printed));
    for [name, title] in [
        ["hydrostatic_10mm", "Still water after 0.6 s in a tank of 1 m (Fig. 4), 10 mm"],
        ["hydrostatic", "Still water after 1 s in a tank of 2.5 m, 8 mm"],
        ["rest", "Still water after 35 s in a tank of 0.5 m, 0.2 m deep"],
    ] {
        text += &format!("\n## {title}\n\n{}", markdown(&still(&tables(&[name])?)));
    }
    let walls = coarse(&tables(&["coarse_walls"])?);
    text += &format!("\n## Movable walls with eight rows (`coarse_walls.csv`)\n\n{walls}");
    Ok(text)
}

fn main() -> Result<()> {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    ensure!(arguments.len() == 2, "usage: liang2017 RESULTS_DIR POTENTIAL_DIR");
    let (results, potential) = (Path::new(&arguments[0]), Path::new(&arguments[1]));
    Ok(fs::write(results.join("liang2017.md"), page(results, potential)?)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: &[(&str, &str)]) -> Row {
        cells.iter().map(|&(name, value)| (name.to_owned(), value.to_owned())).collect()
    }

    #[test]
    fn a_printed_value_stands_beside_the_same_wall_and_moment() {
        let ours = |coupling, max, end| {
            let wall = [
                ("wave_height_ratio", "0.3"),
                ("spring_stiffness_n_per_m", "100"),
                ("seawall_mass_kg_per_m", "50"),
            ];
            let cells = [
                ("force_coupling", coupling),
                ("displacement_max", max),
                ("displacement_end", end),
            ];
            row(&[&wall[..], &cells[..]].concat())
        };
        let table = movable(&[ours("1", "2.2", "1.8"), ours("0.4", "1.6", "1.3")], &[]);
        assert_eq!(table[1][..2], ["Fig. 10", "0.3, 100, 50"]);
        assert_eq!(table[1][2..6], ["X*", "1.64", "2.200", "1.600"]);
        assert_eq!(table[2][2..6], ["X* at the end", "1.36", "1.800", "1.300"]);
        assert_eq!(table.len(), 1 + 2, "no other number is printed of this wall");
    }
}
