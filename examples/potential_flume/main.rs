//! A tank with a bed by fully nonlinear potential theory, independent of all particles:
//!
//!     cargo run --release --example potential_flume -- sweeps/usace_1995/case_b.toml --out FILE.csv
//!
//! Inviscid, incompressible water over the scene's bed, driven by its paddle, before a wall that stands still. It writes
//! the surface over still water at the scene's elevation probes, until the surface gets too steep.

mod columns;
mod water;

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::Parser;
use seawall::scene::{CaseConfig, Scene};

use water::{Flume, Surface};

/// Readings are this far apart, seconds.
const INTERVAL: f64 = 0.05;
/// A surface that is steeper breaks.
const STEEPEST: f64 = 1.5;

/// Potential theory over a bed.
#[derive(Parser)]
struct Arguments {
    /// The scene
    scene: PathBuf,
    /// The table to write
    #[arg(long)]
    out: PathBuf,
    /// Distance of the columns, metres
    #[arg(long, default_value_t = 0.02)]
    column: f64,
    /// Layers of elements over the depth
    #[arg(long, default_value_t = 10)]
    layers: usize,
    /// Time step, seconds
    #[arg(long, default_value_t = 0.01)]
    step: f64,
    /// Sets a key of the scene, as `wave_height_ratio=0.3`
    #[arg(long)]
    set: Vec<String>,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let path = &arguments.scene;
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let mut file: toml::Table = text.parse()?;
    let Some(mut table) = file.remove("scene").and_then(|scene| scene.try_into().ok()) else {
        bail!("{}: no [scene]", path.display());
    };
    for setting in &arguments.set {
        let set: toml::Table = setting.parse()?;
        toml::Table::extend(&mut table, set);
    }
    let config = CaseConfig::from_tables(&table, &toml::Table::new())?;
    let Scene::Seawall(scene) = &config.scene else { bail!("{}: no tank", path.display()) };
    let Some(paddle) = scene.paddle() else { bail!("{}: its water is still", path.display()) };
    let gauges = gauges(&file);
    let mut flume = Flume {
        paddle: &*paddle,
        bed: scene.bed.as_ref(),
        depth: scene.still_water_depth_m,
        gravity: scene.gravity_m_per_s2,
        length: scene.tank_length_m,
        columns: (scene.tank_length_m / arguments.column).round() as usize,
        layers: arguments.layers,
        time: scene.start_s(),
        surface: Surface::default(),
    };
    flume.rest();
    let end = scene
        .end_time_s
        .unwrap_or(f64::INFINITY)
        .min(paddle.stroke_centre().map_or(f64::INFINITY, |t| t + scene.end_after_stroke_centre_s));
    let mut writer = csv::Writer::from_path(&arguments.out)?;
    writer.write_record(std::iter::once("time_s").chain(gauges.iter().map(|g| &*g.0)))?;
    let steps = (INTERVAL / arguments.step).round().max(1.0);
    while flume.time < end {
        for _ in 0..steps as usize {
            flume.step(INTERVAL / steps);
        }
        let steepest = flume.steepest();
        if steepest.is_nan() || steepest > STEEPEST {
            eprintln!("the surface breaks at {:.2} s", flume.time);
            break;
        }
        let levels = gauges.iter().map(|(_, x)| format!("{:.6}", flume.level(*x)));
        writer.write_record(std::iter::once(format!("{:.2}", flume.time)).chain(levels))?;
    }
    eprintln!("volume off by {:.1e} of the water", flume.volume_error());
    Ok(writer.flush()?)
}

/// Names and places of the scene's elevation probes.
fn gauges(file: &toml::Table) -> Vec<(String, f64)> {
    let probes = file.get("probe").and_then(toml::Value::as_array).into_iter().flatten();
    let read = |probe: &toml::Value| {
        let name = probe.get("name")?.as_str()?.to_owned();
        let elevation = probe.get("kind")?.as_str()? == "elevation";
        let x = probe.get("x_m")?;
        let x = x.as_float().or_else(|| x.as_integer().map(|x| x as f64))?;
        elevation.then_some((name, x))
    };
    probes.filter_map(read).collect()
}
