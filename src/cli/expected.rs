//! What is known of a study before it runs: its physics, its cost, and odd values.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::cost::{binary, estimated_time, time_of_all};
use super::known_limits::KnownLimits;
use super::output::duration;
use super::physics::{Line, physics};
use super::warnings::warnings;
use super::{max_error, refine};
use crate::math::words::counted;
use crate::simulation::{Cost, cost};
use crate::study::{Plan, Study};

/// The least and the largest value among the cases.
type Range = (u64, u64);

pub(super) struct Expected<'a> {
    study: &'a Study,
    physics: Vec<Line>,
    particles: Range,
    steps: Range,
    memory_bytes: Range,
    plan: Plan,
    /// The expected time on so many cores.
    seconds: f64,
    cores: usize,
    /// The error that the file aims at, percent, and the longest time for it, seconds.
    aim: Option<(f64, f64)>,
    warnings: Vec<String>,
    limits: KnownLimits,
}

impl Expected<'_> {
    /// For a study whose cases share trunks, or run from rest one by one.
    pub(super) fn of(study: &Study, branching: bool) -> anyhow::Result<Expected<'_>> {
        let [particles, steps, memory_bytes] = ranges(study);
        let plan = Plan::new(study, branching, cost, |_| true);
        let (seconds, cores) = estimated_time(study, &plan);
        let aim = study.max_error_percent.filter(|_| !study.keys.is_empty());
        let longest =
            |percent| max_error::longest(percent, study).map(|longest| (percent, longest));
        let aim = aim.map(longest).transpose()?;
        let time = if branching { (seconds, cores) } else { time_of_all(study) };
        Ok(Expected {
            study,
            physics: physics(study),
            particles,
            steps,
            memory_bytes,
            plan,
            seconds,
            cores,
            aim,
            warnings: warnings(study, time),
            limits: KnownLimits::of(study),
        })
    }

    /// The lines for people.
    pub(super) fn text(&self) -> String {
        let (study, plan) = (self.study, &self.plan);
        let line = |name: &str, value: String| format!("{name:<19} {value}\n");
        let mut text = "\n".to_owned();
        for on in &self.physics {
            text.push_str(&line(&on.label, on.text(&study.file_text)));
        }
        text.push_str(&line("cases", study.cases.len().to_string()));
        if let Some(asked) = &study.refine {
            text.push_str(&line("refine", refine::ahead(asked)));
        }
        if let Some((percent, _)) = self.aim {
            text.push_str(&line("max error", max_error::ahead(percent)));
        }
        if !study.companions.is_empty() {
            let companions = counted(study.companions.len(), "coarser companion");
            text.push_str(&line("error bars", companions));
        }
        text.push_str(&line("particles", between(self.particles)));
        text.push_str(&line("steps per case", between(self.steps)));
        text.push_str(&line("memory per case", binary(self.memory_bytes.1)));
        text.push_str(&line("shared trunks", plan.trunks.len().to_string()));
        let share = plan.total_cost() as f64 / plan.unbranched_cost().max(1) as f64;
        let saved = 100.0 * (1.0 - share);
        text.push_str(&line("saved by trunks", format!("{saved:.0} % of the steps")));
        text.push_str(&line("estimated time", self.time_told()));
        for warning in &self.warnings {
            text.push_str(&format!("\nwarning: {warning}\n"));
        }
        for limit in self.limits.lines() {
            text.push_str(&format!("\n{limit}\n"));
        }
        text
    }

    fn time_told(&self) -> String {
        let again = self.aim.map(|(_, longest)| longest).filter(|&longest| longest > self.seconds);
        let again =
            again.map(|longest| format!(", up to {} with what runs again", duration(longest)));
        let films = if self.study.keys.is_empty() { "" } else { ", without films" };
        let (time, cores) = (duration(self.seconds), counted(self.cores, "core"));
        format!("{time} on {cores}{}{films}", again.unwrap_or_default())
    }

    /// The same for programs.
    pub(super) fn json(&self) -> Listed<'_> {
        Listed { cases: Cases(self.study), expected: self.fields() }
    }

    fn fields(&self) -> Value {
        let (study, plan) = (self.study, &self.plan);
        let physics = self.physics.iter().map(|on| (on.name, &on.values));
        let warnings = self.warnings.iter().map(String::as_str);
        json!({
            "name": study.name,
            "physics": physics.collect::<BTreeMap<_, _>>(),
            "warnings": warnings.chain(self.limits.texts()).collect::<Vec<_>>(),
            "refine": study.refine,
            "max_error_percent": study.max_error_percent,
            "companions": study.companions.len(),
            "particles": self.particles,
            "steps": self.steps,
            "memory_bytes_per_case": self.memory_bytes.1,
            "trunks": plan.trunks.len(),
            "particle_steps": plan.total_cost(),
            "particle_steps_without_trunks": plan.unbranched_cost(),
            "cores": self.cores,
            "estimated_time_s": self.seconds,
            "longest_time_s": self.aim.map(|(_, longest)| longest),
        })
    }
}

/// What is expected, and every case.
#[derive(Serialize)]
pub(super) struct Listed<'a> {
    cases: Cases<'a>,
    #[serde(flatten)]
    expected: Value,
}

/// Each case is made as it is written: a million of them would take gigabytes.
struct Cases<'a>(&'a Study);

impl Serialize for Cases<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.cases.iter().map(|case| {
            let values: serde_json::Map<_, _> = self.0.values(case).into_iter().collect();
            json!({ "index": case.index, "id": case.id, "values": values })
        }))
    }
}

/// The least and the largest number of particles, steps and bytes of a case.
fn ranges(study: &Study) -> [Range; 3] {
    let costs = study.cases.par_iter().map(|case| {
        let Cost { particles, steps, memory_bytes, .. } = cost(&case.config);
        [particles, steps, memory_bytes].map(|count| (count, count))
    });
    let wider = |a: [Range; 3], b: [Range; 3]| {
        [0, 1, 2].map(|of| (a[of].0.min(b[of].0), a[of].1.max(b[of].1)))
    };
    costs.reduce_with(wider).unwrap_or_default()
}

fn between((low, high): Range) -> String {
    if low == high { low.to_string() } else { format!("{low} to {high}") }
}
