//! Made-up output directories for tests: smooth formulas of about the right shape and size.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::quantities::Column;
use crate::quantities::summary::*;

/// The cells of a row that are not empty.
type Cells = Vec<(&'static Column, String)>;

/// A wall of a made-up case: stiffness and mass, or neither.
type Wall = Option<(f64, f64)>;

/// A small movable sweep with one failed case, an unknown column, energies and a manifest.
pub fn sweep() -> TempDir {
    movable(&[0.3, 0.5], &[10.0, 500.0, 1e5], &[50.0, 250.0])
}

/// A movable sweep over the given waves, stiffnesses and masses; its last case failed.
pub fn movable(waves: &[f64], stiffnesses: &[f64], masses: &[f64]) -> TempDir {
    let mut cases = Vec::new();
    for &wave in waves {
        for &stiffness in stiffnesses {
            cases.extend(masses.iter().map(|&mass| (wave, Some((stiffness, mass)))));
        }
    }
    write(&cases)
}

/// Fixed walls only.
pub fn fixed() -> TempDir {
    write(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6].map(|wave| (wave, None)))
}

/// Dam breaks of rising columns: no wave, no spring, but gauges and readings.
pub fn dam_breaks(cases: usize) -> TempDir {
    let directory = write(&[]);
    let root = directory.path();
    for folder in ["probes", "readings"] {
        fs::create_dir(root.join(folder)).unwrap();
    }
    let mut rows = Vec::new();
    for index in 0..cases {
        let (id, height) = (format!("case-{index:04}"), 0.6 + 0.1 * index as f64);
        let mut row = ended(&id, "ok");
        row.extend([
            (&FORCE_MAX, format!("1.832{index}")),
            (&RUNUP_MAX, "0.71".to_owned()),
            (&FORCE_GAP, "3.1".to_owned()),
            (&ENERGY_GAP, "0.2".to_owned()),
            (&PARTICLES_LOST, "0".to_owned()),
        ]);
        rows.push((row, format!("{height:.1}")));
        write_history(root, &id, 0.3, None);
        let mut probes = "time_s,P1,front\n".to_owned();
        for sample in 0..400 {
            let time = f64::from(sample) * 0.005;
            let front = if sample == 7 { String::new() } else { format!("{time:.4}") };
            writeln!(probes, "{time:.4},{:.3},{front}", 3000.0 * time.min(1.0)).unwrap();
        }
        fs::write(root.join(format!("probes/{id}.csv")), probes).unwrap();
        let readings = "name,value,unit\nfront_at_wall,1.6123456789,sqrt(H/g), from rest\n\
                        cavity_closure,,sqrt(H/g)\n";
        fs::write(root.join(format!("readings/{id}.csv")), readings).unwrap();
    }
    write_summary(root, "column_height_m", &rows);
    let columns = "name,unit,method\nP1,Pa,right wall\nfront,m,water's edge; right, or left\n";
    fs::write(root.join("probes/columns.csv"), columns).unwrap();
    let manifest = r#"{"name": "fixture", "keys": ["column_height_m"], "sweep_file": ""}"#;
    fs::write(root.join("manifest.json"), manifest).unwrap();
    directory
}

fn write(cases: &[(f64, Wall)]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let root = directory.path();
    fs::create_dir(root.join("histories")).unwrap();
    let mut rows = Vec::new();
    let mut energy = "case_id,paddle_work_j,kinetic_j,spring_j\n".to_owned();
    for (index, &(wave, wall)) in cases.iter().enumerate() {
        let id = format!("case-{index:04}");
        if index + 1 == cases.len() && index > 5 && wall.is_some() {
            rows.push((failed_row(&id, wave, wall), "blue".to_owned()));
            continue;
        }
        rows.push((finished_row(&id, wave, wall), "blue".to_owned()));
        writeln!(energy, "{id},{:.3},{:.3},{:.3}", 160.0 * wave, 40.0 * wave, 3.0 * wave).unwrap();
        write_history(root, &id, wave, wall);
    }
    write_summary(root, "colour", &rows);
    fs::write(root.join("energy.csv"), energy).unwrap();
    let manifest = r#"{"name": "fixture", "version": "0.1.0", "host": "a <b> & c", "ranks": 2}"#;
    fs::write(root.join("manifest.json"), manifest).unwrap();
    directory
}

/// The summary of a directory of the first version, with one column that was swept.
fn write_summary(root: &Path, swept: &str, rows: &[(Cells, String)]) {
    let names = first_version().flat_map(|c| [Some(c.name.to_owned()), c.time_name()]).flatten();
    let mut table = csv::Writer::from_path(root.join("summary.csv")).unwrap();
    table.write_record(names.chain([swept.to_owned()])).unwrap();
    for (cells, key) in rows {
        let cell = |column: &Column| {
            let own = cells.iter().find(|(other, _)| *other == column);
            own.map(|(_, cell)| cell.clone()).unwrap_or_default()
        };
        let cells =
            first_version().flat_map(|c| [Some(cell(c)), c.time_name().map(|_| String::new())]);
        table.write_record(cells.flatten().chain([key.clone()])).unwrap();
    }
    table.flush().unwrap();
}

/// What every row holds.
fn ended(id: &str, status: &str) -> Cells {
    let text = [(&CASE_ID, id), (&STATUS, status), (&STEPS, "9000"), (&PARTICLES, "7800")];
    let choices = [
        (&SCHEME, "wcsph"),
        (&BOUNDARY, "improved-shepard"),
        (&KERNEL, "wendland-c2"),
        (&PARTICLE_SPACING, "0.008"),
    ];
    text.into_iter().chain(choices).map(|(column, cell)| (column, cell.to_owned())).collect()
}

/// Wave, stiffness, mass, k* and m*.
fn place(wave: f64, wall: Wall) -> Cells {
    let mut cells: Cells = vec![(&WAVE_HEIGHT_RATIO, wave.to_string())];
    cells.push((&FORCE_COUPLING, "1".to_owned()));
    if let Some((k, m)) = wall {
        cells.extend([(&SPRING_STIFFNESS, k.to_string()), (&SEAWALL_MASS, m.to_string())]);
        let stars = [(k / 392.4_f64).log10().to_string(), (m / 40.0).to_string()];
        cells.extend([&LOG10_K_STAR, &M_STAR].into_iter().zip(stars));
    }
    cells
}

/// The share of a fixed wall's load that the wall feels, and how far it gives way.
fn give(wall: Wall) -> (f64, f64) {
    let Some((k, m)) = wall else { return (1.0, 0.0) };
    let stiff = 1.0 / (1.0 + (-2.2 * ((k / 392.4_f64).log10() - 0.9)).exp());
    let heavy = m / 40.0 / (m / 40.0 + 2.0);
    (stiff.max(0.45 + 0.5 * heavy * (1.0 - stiff)), (1.0 - stiff) * (1.4 - heavy))
}

fn finished_row(id: &str, wave: f64, wall: Wall) -> Cells {
    let (share, give) = give(wall);
    let force = format!("{:.4}", 1.0 + (3.9 * wave + 0.1) * share);
    let runup = (2.0 * wave + wave * wave / 2.0 + 0.75 * wave.powi(3)) * share;
    let runup = format!("{runup:.4}");
    let mut cells = [ended(id, "ok"), place(wave, wall)].concat();
    cells.extend([
        (&MEASURED_WAVE_HEIGHT_RATIO, format!("{:.4}", 0.985 * wave)),
        (&FORCE_MAX, force.clone()),
        (&RUNUP_MAX, runup.clone()),
        (&FIRST_FORCE_MAX, force),
        (&FIRST_RUNUP_MAX, runup),
        (&FORCE_GAP, format!("{:.3}", 0.6 + 4.0 * wave * wave)),
        (&ENERGY_GAP, "0.4".to_owned()),
        (&PARTICLES_LOST, "0".to_owned()),
    ]);
    if wall.is_some() {
        let displacement = 9.0 * wave * give;
        let truncated = displacement > 2.0;
        cells.push((&DISPLACEMENT_MAX, format!("{displacement:.5}")));
        cells.push((&DISPLACEMENT_TRUNCATED, truncated.to_string()));
        cells.push((&STOPS, u8::from(!truncated).to_string()));
    }
    cells
}

fn failed_row(id: &str, wave: f64, wall: Wall) -> Cells {
    let reason = "runaway-speed at t = 1.9 s: particle 12, 31 m/s <";
    let reason: Cells = vec![(&REASON, reason.to_owned())];
    [ended(id, "failed"), place(wave, wall), reason].concat()
}

fn write_history(root: &Path, id: &str, wave: f64, wall: Wall) {
    let (share, give) = give(wall);
    let mut text = "time_s,force,runup,displacement,wall_velocity_m_per_s\n".to_owned();
    let arrival = 2.9 - 1.5 * wave;
    for sample in 0..800 {
        let time = f64::from(sample) * 0.005;
        let pulse = (4.5 * (time - arrival)).cosh().powi(-2);
        let ripple = 0.01 * (90.0 * time).sin();
        let force = 1.0 + (3.9 * wave + 0.1) * share * pulse + ripple;
        let runup = 2.2 * wave * share * pulse;
        let moved = 4.5 * wave * give * (1.0 + (3.0 * (time - arrival - 0.2)).tanh());
        let displacement = if wall.is_some() { format!("{moved:.5}") } else { String::new() };
        writeln!(text, "{time:.4},{force:.5},{runup:.5},{displacement},0").unwrap();
    }
    fs::write(root.join(format!("histories/{id}.csv")), text).unwrap();
}
