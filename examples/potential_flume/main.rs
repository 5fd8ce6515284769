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
use seawall::keys::Override;
use seawall::scene::{ProbeKind, Scene};
use seawall::study::{Study, SweepFile};

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
    /// Changes a key of the scene, as `--set` of the program does
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<Override>,
    /// Distance of the columns, metres
    #[arg(long, default_value_t = 0.02)]
    column: f64,
    /// Layers of elements over the depth
    #[arg(long, default_value_t = 10)]
    layers: usize,
    /// Time step, seconds
    #[arg(long, default_value_t = 0.01)]
    step: f64,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    let path = &arguments.scene;
    let text = fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let study = Study::new(&SweepFile::read(&text, &arguments.set)?)?;
    let config = &study.cases[0].config;
    let Scene::Seawall(scene) = &config.scene else { bail!("{}: no tank", path.display()) };
    let Some(paddle) = scene.paddle() else { bail!("{}: its water is still", path.display()) };
    let probes = config.probes.iter().filter(|probe| probe.kind == ProbeKind::Elevation);
    let gauges: Vec<_> = probes.filter_map(|probe| Some((&*probe.name, probe.x_m?))).collect();
    let frame = config.scene.frame();
    let mut flume = Flume {
        paddle: &*paddle,
        bed: scene.bed.as_ref(),
        depth: frame.depth,
        gravity: frame.gravity,
        length: frame.length,
        columns: (frame.length / arguments.column).round() as usize,
        layers: arguments.layers,
        time: scene.start_s(),
        surface: Surface::default(),
    };
    flume.rest();
    let mut writer = csv::Writer::from_path(&arguments.out)?;
    writer.write_record(std::iter::once("time_s").chain(gauges.iter().map(|gauge| gauge.0)))?;
    let steps = (INTERVAL / arguments.step).round().max(1.0);
    while flume.time < frame.end_time {
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
