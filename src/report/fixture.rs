//! Made-up output directories for tests: smooth formulas of about the right shape and size.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use tempfile::TempDir;

const HEADER: &str = "case_id,status,reason,wave_height_ratio,spring_stiffness_n_per_m,\
seawall_mass_kg_per_m,log10_k_star,m_star,measured_wave_height_ratio,force_max,force_max_time_s,\
runup_max,runup_max_time_s,displacement_max,displacement_max_time_s,first_force_max,\
first_force_max_time_s,first_runup_max,first_runup_max_time_s,first_displacement_max,\
first_displacement_max_time_s,first_force_peak,first_runup_peak,force_max_raw,force_end,runup_end,\
displacement_end,onset_time_s,stroke_centre_s,displacement_truncated,stops,force_gap_percent,\
energy_gap_percent,particles_lost,force_error,runup_error,displacement_error,steps,particles,\
pair_evaluations,wall_time_s,scheme,boundary,kernel,particle_spacing_m,force_coupling,colour\n";

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
    let mut summary = HEADER.replace(",colour\n", ",column_height_m\n");
    for index in 0..cases {
        let (id, height) = (format!("case-{index:04}"), 0.6 + 0.1 * index as f64);
        let (head, tail) = (",".repeat(7), ",".repeat(11));
        writeln!(
            summary,
            "{id},ok,{head}1.832{index},1.6,0.71,1.5{tail}1.84,0.9,0.1,,,,,,3.1,0.2,0,,,,\
             9000,7800,312000000,5.1,wcsph,improved-shepard,wendland-c2,0.02,,{height:.1}"
        )
        .unwrap();
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
    fs::write(root.join("summary.csv"), summary).unwrap();
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
    let mut summary = HEADER.to_owned();
    let mut energy = "case_id,paddle_work_j,kinetic_j,spring_j\n".to_owned();
    for (index, &(wave, wall)) in cases.iter().enumerate() {
        let id = format!("case-{index:04}");
        if index + 1 == cases.len() && index > 5 && wall.is_some() {
            summary.push_str(&failed_row(&id, wave, wall));
            continue;
        }
        summary.push_str(&finished_row(&id, wave, wall));
        writeln!(energy, "{id},{:.3},{:.3},{:.3}", 160.0 * wave, 40.0 * wave, 3.0 * wave).unwrap();
        write_history(root, &id, wave, wall);
    }
    fs::write(root.join("summary.csv"), summary).unwrap();
    fs::write(root.join("energy.csv"), energy).unwrap();
    let manifest = r#"{"name": "fixture", "version": "0.1.0", "host": "a <b> & c", "ranks": 2}"#;
    fs::write(root.join("manifest.json"), manifest).unwrap();
    directory
}

/// k*, m* and the share of a fixed wall's load that the wall feels.
fn wall_numbers(wall: Wall) -> (String, String, f64, f64) {
    let Some((k, m)) = wall else { return (",".into(), ",".into(), 1.0, 0.0) };
    let (log10_k_star, m_star) = ((k / 392.4_f64).log10(), m / 40.0);
    let stiff = 1.0 / (1.0 + (-2.2 * (log10_k_star - 0.9)).exp());
    let heavy = m_star / (m_star + 2.0);
    let share = stiff.max(0.45 + 0.5 * heavy * (1.0 - stiff));
    (format!("{k},{m}"), format!("{log10_k_star},{m_star}"), share, (1.0 - stiff) * (1.4 - heavy))
}

fn finished_row(id: &str, wave: f64, wall: Wall) -> String {
    let (swept, stars, share, give) = wall_numbers(wall);
    let force = 1.0 + (3.9 * wave + 0.1) * share;
    let runup = (2.0 * wave + wave * wave / 2.0 + 0.75 * wave.powi(3)) * share;
    let displacement = 9.0 * wave * give;
    let truncated = displacement > 2.0;
    let centre = 1.35 - 1.5 * (wave - 0.2);
    let (moved, moved_time, end, truncated, stops) = match wall {
        Some(_) => {
            let moved = format!("{displacement:.5}");
            let stops = u8::from(!truncated).to_string();
            (moved.clone(), "3.6".to_owned(), moved, truncated.to_string(), stops)
        }
        None => Default::default(),
    };
    let gap = 0.6 + 4.0 * wave * wave;
    let measured = 0.985 * wave;
    format!(
        "{id},ok,,{wave},{swept},{stars},{measured:.4},{force:.4},2.2,{runup:.4},2.3,\
         {moved},{moved_time},{force:.4},2.2,{runup:.4},2.3,{moved},{moved_time},{force:.4},\
         {runup:.4},{force:.4},0.9,0.01,{end},1.7,{centre:.4},{truncated},{stops},{gap:.3},0.4,0,,,,\
         9000,7800,312000000,5.1,wcsph,improved-shepard,wendland-c2,0.008,1,blue\n"
    )
}

fn failed_row(id: &str, wave: f64, wall: Wall) -> String {
    let (swept, stars, ..) = wall_numbers(wall);
    let empty = ",".repeat(29);
    format!(
        "{id},failed,\"runaway-speed at t = 1.9 s: particle 12, 31 m/s <\",{wave},{swept},{stars},\
         {empty}4000,7800,100000,2.2,wcsph,improved-shepard,wendland-c2,0.008,1,blue\n"
    )
}

fn write_history(root: &Path, id: &str, wave: f64, wall: Wall) {
    let (_, _, share, give) = wall_numbers(wall);
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
