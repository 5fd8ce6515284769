//! `seawall check`: validates a file and says what it would take.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use super::SUCCESS;
use super::input::{Expect, Setting, study};
use super::output::{Output, duration};
use super::table::Table;
use crate::scene::{CaseConfig, WallChoice, limits};
use crate::simulation::cost;
use crate::sweep::{Plan, Study};

/// Validate a sweep or scene file, list its cases and what they cost; run nothing.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall check sweeps/nightly.toml
  seawall check sweeps/liang2017.toml -v
  seawall check sweeps/nightly.toml --set numerics.particle_spacing_m=0.016 --format json")]
pub(super) struct CheckArgs {
    /// The sweep or scene file.
    file: PathBuf,
    /// Set a value by its path; repeatable.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

/// Particle-steps per second and core: what an AVX-512 core was measured to do, and a guess for
/// any other.
const PARTICLE_STEPS_PER_SECOND: f64 = 6e6;
/// Cases listed without `-v`.
const ROWS: usize = 10;

pub(super) fn main(args: &CheckArgs, output: &Output) -> anyhow::Result<u8> {
    let study = study(&args.file, &args.settings, Expect::Either)?;
    show(&study, true, output)
}

pub(super) fn show(study: &Study, branching: bool, output: &Output) -> anyhow::Result<u8> {
    let costs: Vec<_> = study.cases.iter().map(|case| cost(&case.config)).collect();
    let plan = Plan::new(study, branching, cost, |_| true);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let range = |value: fn(&crate::simulation::Cost) -> u64| {
        let values = costs.iter().map(value);
        (values.clone().min().unwrap_or(0), values.max().unwrap_or(0))
    };
    let particles = range(|cost| cost.particles);
    let steps = range(|cost| cost.steps);
    let memory = range(|cost| cost.memory_bytes).1;
    let at_once = cores.min(study.run_count());
    let seconds = plan.total_cost() as f64 / PARTICLE_STEPS_PER_SECOND / at_once.max(1) as f64;
    let (computed, from_rest) = (plan.total_cost(), plan.unbranched_cost());
    let saved = 100.0 * (1.0 - computed as f64 / from_rest.max(1) as f64);
    let physics = physics(study);

    let rows = if output.verbose { usize::MAX } else { ROWS };
    let mut table =
        Table::new(["case", "id"].into_iter().chain(study.keys.iter().map(String::as_str)));
    for case in study.cases.iter().take(rows) {
        let value = |value: &Option<toml::Value>| match value {
            Some(value) => value.to_string(),
            None => "-".to_owned(),
        };
        let place = [case.index.to_string(), case.id.to_string()];
        table.row(place.into_iter().chain(case.assignments.iter().map(value)));
    }
    let mut text = table.render();
    if study.cases.len() > rows {
        text.push_str(&format!("... and {} more (-v lists all)\n", study.cases.len() - rows));
    }
    let line = |name: &str, value: String| format!("{name:<20}{value}\n");
    text.push('\n');
    for (name, values) in &physics {
        text.push_str(&line(name, values.join(", ")));
    }
    text.push_str(&line("cases", study.cases.len().to_string()));
    if !study.companions.is_empty() {
        let value = format!("{} coarser companions", study.companions.len());
        text.push_str(&line("error bars", value));
    }
    text.push_str(&line("particles", between(particles)));
    text.push_str(&line("steps per case", between(steps)));
    let mebibytes = |bytes: u64| format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20));
    text.push_str(&line("memory per case", mebibytes(memory)));
    text.push_str(&line("shared trunks", plan.trunks.len().to_string()));
    text.push_str(&line("saved by trunks", format!("{saved:.0} % of the steps")));
    text.push_str(&line("estimated time", format!("{} on {cores} cores", duration(seconds))));
    let warnings = warnings(study);
    for (warning, cases) in &warnings {
        text.push_str(&format!("\nknown limit, {cases} cases: {warning}\n"));
    }
    let cases: Vec<_> = study
        .cases
        .iter()
        .map(|case| {
            let values: serde_json::Map<_, _> = study.values(case).into_iter().collect();
            json!({ "index": case.index, "id": case.id, "values": values })
        })
        .collect();
    let value = json!({
        "name": study.name,
        "physics": physics.iter().cloned().collect::<std::collections::BTreeMap<_, _>>(),
        "warnings": warnings.keys().collect::<Vec<_>>(),
        "cases": cases,
        "companions": study.companions.len(),
        "particles": particles,
        "steps": steps,
        "memory_bytes_per_case": memory,
        "trunks": plan.trunks.len(),
        "particle_steps": computed,
        "particle_steps_without_trunks": from_rest,
        "cores": cores,
        "estimated_time_s": seconds,
    });
    output.result(&text, &value)?;
    Ok(SUCCESS)
}

/// The known limits that the study runs into, with the number of cases.
fn warnings(study: &Study) -> std::collections::BTreeMap<&'static str, usize> {
    let mut found = std::collections::BTreeMap::new();
    for limit in study.cases.iter().flat_map(|case| limits(&case.config)) {
        *found.entry(limit).or_default() += 1;
    }
    found
}

fn between((low, high): (u64, u64)) -> String {
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}

/// Which physics is on: each choice with the values that occur among the cases.
fn physics(study: &Study) -> Vec<(&'static str, Vec<String>)> {
    type Choice = (&'static str, fn(&CaseConfig) -> String);
    fn name(choice: impl serde::Serialize) -> String {
        serde_json::to_value(choice)
            .ok()
            .and_then(|value| value.as_str().map(str::to_owned))
            .unwrap_or_default()
    }
    const CHOICES: &[Choice] = &[
        ("scene", |config| config.scene.kind().to_owned()),
        ("wall", |config| {
            let Some(scene) = config.scene.seawall() else { return "fixed".to_owned() };
            match scene.wall {
                WallChoice::Fixed => format!("fixed, {}°", scene.wall_angle_deg),
                WallChoice::Movable => format!(
                    "movable (threshold {}, coupling {})",
                    scene.threshold_ratio, scene.force_coupling
                ),
            }
        }),
        ("scheme", |config| name(config.numerics.scheme)),
        ("kernel", |config| name(config.numerics.kernel)),
        ("boundary", |config| name(config.numerics.boundary)),
        ("ghost gravity", |config| name(config.numerics.ghost_gravity)),
        ("density diffusion", |config| name(config.numerics.density_diffusion)),
        ("shifting", |config| name(config.numerics.shifting)),
        ("gradients", |config| {
            let corrected = config.numerics.corrected_gradients;
            if corrected { "corrected" } else { "as they are" }.to_owned()
        }),
        ("viscosity", |config| config.numerics.artificial_viscosity.to_string()),
        ("steps per full step", |config| config.numerics.acoustic_substeps.to_string()),
        ("bulk damping", |config| config.numerics.bulk_damping.to_string()),
        ("state equation", |config| name(config.numerics.state_equation)),
        ("sound speed ratio", |config| config.numerics.sound_speed_ratio.to_string()),
        ("particle spacing, m", |config| config.numerics.particle_spacing_m.to_string()),
    ];
    let values = |value: fn(&CaseConfig) -> String| {
        let mut seen = Vec::new();
        for case in &study.cases {
            let value = value(&case.config);
            if !seen.contains(&value) {
                seen.push(value);
            }
        }
        seen
    };
    CHOICES.iter().map(|&(name, value)| (name, values(value))).collect()
}
