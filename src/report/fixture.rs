//! Made-up output directories for tests: smooth formulas of about the right shape and size.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use tempfile::TempDir;

use crate::quantities::Column;
use crate::quantities::summary::first_version;
use crate::report::load::Loaded;
use crate::report::row::Row;
use crate::report::study::{Key, StudyFile};

/// What every row holds: one cell per line, `column=text`.
const ENDED: &str = "steps=9000\nparticles=7800\nscheme=wcsph\nboundary=improved-shepard\n\
    kernel=wendland-c2\nparticle_spacing_m=0.008\n";

/// A wall of a made-up case: stiffness and mass, or neither.
type Wall = Option<(f64, f64)>;

/// A directory's data. The directory is deleted once it is dropped.
pub fn read(directory: TempDir) -> (TempDir, Loaded) {
    let data = Loaded::read(directory.path()).unwrap();
    (directory, data)
}

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
        let row = format!(
            "case_id={id}\nstatus=ok\nforce_max=1.832{index}\nrunup_max=0.71\n\
             force_gap_percent=3.1\nenergy_gap_percent=0.2\nparticles_lost=0\n{ENDED}"
        );
        rows.push((row, format!("{height:.1}")));
        write_history(root, &id, 0.3, None);
        let mut probes = "time_s,P1,front\n".to_owned();
        for sample in 0..400 {
            let time = f64::from(sample) * 0.005;
            let front = if sample == 7 { String::new() } else { format!("{time:.4}") };
            writeln!(probes, "{time:.4},{:.3},{front}", 3000.0 * time.min(1.0)).unwrap();
        }
        fs::write(root.join(format!("probes/{id}.csv")), probes).unwrap();
        let readings = "name,value,unit\nfront_at_wall,1.6123456789,sqrt(H/g)\n\
                        cavity_closure,,sqrt(H/g)\n";
        fs::write(root.join(format!("readings/{id}.csv")), readings).unwrap();
    }
    write_summary(root, "column_height_m", &rows);
    let columns = "name,unit,method\nP1,Pa,right wall\nfront,m,\"water's edge; right, or left\"\n";
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
    let mut energy = "case_id,paddle_work_j_per_m,kinetic_j_per_m,spring_j_per_m\n".to_owned();
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

/// Writes the summary of a directory of the first version, with one swept column.
fn write_summary(root: &Path, swept: &str, rows: &[(String, String)]) {
    let names = first_version().flat_map(|c| [Some(c.name.to_owned()), c.time_name()]).flatten();
    let mut table = csv::Writer::from_path(root.join("summary.csv")).unwrap();
    table.write_record(names.chain([swept.to_owned()])).unwrap();
    for (cells, key) in rows {
        let cell = |column: &Column| {
            let mut cells = cells.lines().filter_map(|line| line.split_once('='));
            cells.find(|(name, _)| *name == column.name).map_or("", |(_, cell)| cell)
        };
        let cells = first_version().flat_map(|c| [Some(cell(c)), c.time_name().map(|_| "")]);
        table.write_record(cells.flatten().chain([key.as_str()])).unwrap();
    }
    table.flush().unwrap();
}

/// Wave, stiffness, mass, k* and m*.
fn place(wave: f64, wall: Wall) -> String {
    let wave = format!("wave_height_ratio={wave}\nforce_coupling=1\n{ENDED}");
    let Some((k, m)) = wall else { return wave };
    let (log10_k_star, m_star) = ((k / 392.4_f64).log10(), m / 40.0);
    format!(
        "{wave}spring_stiffness_n_per_m={k}\nseawall_mass_kg_per_m={m}\n\
         log10_k_star={log10_k_star}\nm_star={m_star}\n"
    )
}

/// The force that the wall feels as a share of a fixed wall's, and its displacement.
fn give(wall: Wall) -> (f64, f64) {
    let Some((k, m)) = wall else { return (1.0, 0.0) };
    let stiff = 1.0 / (1.0 + (-2.2 * ((k / 392.4_f64).log10() - 0.9)).exp());
    let heavy = m / 40.0 / (m / 40.0 + 2.0);
    (stiff.max(0.45 + 0.5 * heavy * (1.0 - stiff)), (1.0 - stiff) * (1.4 - heavy))
}

fn finished_row(id: &str, wave: f64, wall: Wall) -> String {
    let (share, give) = give(wall);
    let force = 1.0 + (3.9 * wave + 0.1) * share;
    let runup = (2.0 * wave + wave * wave / 2.0 + 0.75 * wave.powi(3)) * share;
    let (measured, gap) = (0.985 * wave, 0.6 + 4.0 * wave * wave);
    let row = format!(
        "case_id={id}\nstatus=ok\n{}measured_wave_height_ratio={measured:.4}\nforce_max={force:.4}\n\
         runup_max={runup:.4}\nfirst_force_max={force:.4}\nfirst_runup_max={runup:.4}\n\
         force_gap_percent={gap:.3}\nenergy_gap_percent=0.4\nparticles_lost=0\n",
        place(wave, wall)
    );
    let displacement = 9.0 * wave * give;
    let (truncated, stops) = (displacement > 2.0, u8::from(displacement <= 2.0));
    let moved = format!(
        "displacement_max={displacement:.5}\ndisplacement_truncated={truncated}\nstops={stops}\n"
    );
    if wall.is_some() { row + &moved } else { row }
}

fn failed_row(id: &str, wave: f64, wall: Wall) -> String {
    let reason = "runaway-speed at t = 1.9 s: particle 12, 31 m/s <";
    format!("case_id={id}\nstatus=failed\nreason={reason}\n{}", place(wave, wall))
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

impl Loaded {
    /// Rows with these cells of swept keys.
    pub fn swept(keys: &[(&str, &[&str])]) -> Loaded {
        let keys: Vec<_> = keys.iter().map(|(name, cells)| Key::new(name, *cells)).collect();
        let rows = vec![Row::default(); keys.first().map_or(1, |key| key.cells.iter().len())];
        Loaded { rows, keys, ..Loaded::default() }
    }

    /// Changes a value in all rows.
    pub fn set_all(&mut self, column: &'static Column, value: impl ToString) -> &mut Loaded {
        for row in &mut self.rows {
            row.set(column, value.to_string());
        }
        self
    }

    /// The same rows as of this sweep file with these settings of the command line.
    pub fn made_from(self, file: &str, overrides: &[&str]) -> Loaded {
        let manifest =
            serde_json::json!({ "name": "a", "sweep_file": file, "overrides": overrides });
        let manifest = Some(manifest);
        let file = StudyFile::of(manifest.as_ref()).map(Arc::new);
        Loaded { manifest, file, ..self }
    }
}
