//! What happens to a sweep on threads while it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;

use anyhow::{Context, Result};

use super::damage::flip;
use super::faults::{Outcome, Verdict, judged, resumed, shortened};
use super::study::{Study, children, code, signal, told, wait};

/// Its second case needs more memory than [`LITTLE`].
const GREEDY: &str = r#"
name = "greedy"
[scene]
kind = "hydrostatic"
end_time_s = 0.001
[grid]
particle_spacing_m = [0.02, 0.001, 0.025]
"#;
/// Kilobytes of address space, at least.
const LITTLE: u64 = 300_000;

pub fn signalled(study: &Study, name: &str, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let child = study.command(&out, &[]).spawn()?;
    sleep(study.time.mul_f64(at));
    signal(child.id(), name); // it may have ended already
    resumed(study, &out, &wait(child)?)
}

pub fn killed_often(study: &Study, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let mut last = None;
    for _ in 0..6 {
        let mut child = study.command(&out, &[]).spawn()?;
        sleep(study.time.mul_f64(0.5 * at));
        child.kill()?;
        last = Some(child.wait_with_output()?);
    }
    resumed(study, &out, &last.context("nothing was killed")?)
}

/// The first start dies of it; the second one must record it as failed and do all else.
pub fn out_of_memory(study: &Study, trial: u64, _: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let file = out.with_extension("toml");
    fs::write(&file, GREEDY)?;
    let start = |limit: &str, more: &[&str]| -> Result<Output> {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("ulimit -d {limit}; exec \"$0\" \"$@\"")]);
        command.arg(study.program()).arg("sweep").arg(&file).arg("--out").arg(&out);
        command.args(["--threads", "2", "--film", "none"]).args(more);
        Ok(command.output()?)
    };
    let limit = (LITTLE + 1000 * trial).to_string();
    let first = start(&limit, &[])?;
    let second = start(&limit, &[])?;
    let summary = fs::read_to_string(out.join("summary.csv")).unwrap_or_default();
    let lines = |word: &str| summary.lines().filter(|line| line.contains(word)).count();
    let third = start("unlimited", &["--retry-failed"])?;
    let verdict = match [second.status.code(), third.status.code()] {
        [Some(1), Some(0)] if [lines(",ok,"), lines("ended-the-process")] == [2, 1] => {
            Verdict::Whole
        }
        codes => Verdict::Lost(format!("{codes:?}: {}", told(&second))),
    };
    let seen = format!("{} / then: {}", told(&first), told(&second));
    Ok(Outcome { code: code(&first), seen: shortened(&seen, &out), verdict })
}

/// With a limit on memory every case has a process of its own, which is killed as by a fault of its own.
pub fn abort(study: &Study, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let child = study.command(&out, &["--set", "limits.memory_mib=2000"]).spawn()?;
    sleep(study.time.mul_f64(at));
    let fault = ["ABRT", "SEGV", "BUS", "KILL"][trial as usize % 4];
    let hit = children(child.id()).first().is_some_and(|&case| signal(case, fault));
    let first = wait(child)?;
    let mut outcome = judged(study, &out, &first, &["--retry-failed"])?;
    if !(matches!(first.status.code(), Some(0)) || hit && first.status.code() == Some(1)) {
        outcome.verdict = Verdict::Lost(format!("ended with {}: {}", code(&first), told(&first)));
    }
    Ok(outcome)
}

/// The checkpoint must be refused, and its case start over.
pub fn flipped_checkpoint(study: &Study, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let kept = || -> Option<PathBuf> {
        let entries = fs::read_dir(out.join("checkpoints")).ok()?;
        let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        paths.find(|path| path.extension().is_some_and(|ending| ending != "partial"))
    };
    let mut child = study.command(&out, &["--checkpoint-every-s", "0.001"]).spawn()?;
    while kept().is_none() && child.try_wait()?.is_none() {}
    sleep(study.time.mul_f64(0.2 * at));
    child.kill()?;
    let first = child.wait_with_output()?;
    // It may be of a case that has just ended.
    let hit = kept().is_some_and(|path| flip(&path, trial, at).is_ok());
    let mut outcome = resumed(study, &out, &first)?;
    if !hit {
        outcome.code += ", none was left";
    }
    Ok(outcome)
}

/// Something happens to the directory in the middle: the sweep must not end well.
pub fn disturbed(
    study: &Study,
    at: f64,
    disturb: impl Fn(&Path) -> std::io::Result<()>,
) -> Result<Outcome> {
    let out = study.room("out")?;
    let child = study.command(&out, &[]).spawn()?;
    while !out.join("journal.jsonl").exists() {
        sleep(study.time.mul_f64(0.001));
    }
    sleep(study.time.mul_f64(0.8 * at));
    let whole = || study.results(&out).is_ok_and(|files| files == study.undisturbed);
    let done = whole(); // and about to end
    disturb(&out)?;
    let output = wait(child)?;
    let verdict = match output.status.code() {
        Some(0) if done || whole() => Verdict::Whole,
        Some(0) => Verdict::Lost("it ended well, without its results".to_owned()),
        _ => Verdict::Refused,
    };
    Ok(Outcome { code: code(&output), seen: shortened(&told(&output), &out), verdict })
}

/// Those that do not start over must be refused.
pub fn at_once(study: &Study) -> Result<Outcome> {
    let out = study.finished("out")?;
    let children: Vec<_> =
        (0..4).map(|_| study.command(&out, &["--fresh"]).spawn()).collect::<Result<_, _>>()?;
    let outputs = children.into_iter().map(wait).collect::<Result<Vec<_>>>()?;
    let mut codes: Vec<_> = outputs.iter().map(code).collect();
    codes.sort();
    let fair = outputs.iter().all(|output| matches!(output.status.code(), Some(0 | 2)));
    let well = outputs.iter().any(|output| output.status.success());
    let verdict = match study.results(&out)? == study.undisturbed {
        true if fair && well => Verdict::Whole,
        true => Verdict::Lost("one ended with an internal error, or none well".to_owned()),
        false => Verdict::Lost("the results differ".to_owned()),
    };
    let refused = outputs.iter().find(|output| !output.status.success());
    let seen = refused.map(told).unwrap_or_default();
    Ok(Outcome { code: codes.join(" "), seen: shortened(&seen, &out), verdict })
}
