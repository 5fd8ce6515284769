//! The faults, each with what a user would do next and what must come of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::thread::sleep;

use anyhow::{Context, Result};

use super::calls;
use super::study::{Study, code, told, wait};

/// A fault and how it is caused, given a trial's number and its share of all trials.
pub struct Fault {
    pub name: &'static str,
    pub what: &'static str,
    pub cause: fn(&Study, u64, f64) -> Result<Outcome>,
}

/// How a trial ended.
pub enum Verdict {
    Whole,
    Refused,
    Lost(String),
}

/// What came of a trial.
pub struct Outcome {
    pub code: String,
    pub seen: String,
    pub verdict: Verdict,
}

pub const FAULTS: [Fault; 16] = [
    Fault {
        name: "kill",
        what: "kill -9 at any moment",
        cause: |s, _, at| signalled(s, "KILL", at),
    },
    Fault { name: "term", what: "TERM at any moment", cause: |s, _, at| signalled(s, "TERM", at) },
    Fault { name: "int", what: "Ctrl-C at any moment", cause: |s, _, at| signalled(s, "INT", at) },
    Fault {
        name: "kills",
        what: "kill -9 six times in a row",
        cause: |s, _, at| killed_often(s, at),
    },
    Fault { name: "renamed", what: "output directory renamed while it runs", cause: renamed },
    Fault { name: "no-journal", what: "journal deleted while it runs", cause: without_journal },
    Fault {
        name: "journal-bit",
        what: "a bit of the journal flipped",
        cause: |s, trial, at| flipped(s, "journal.jsonl", trial, at),
    },
    Fault {
        name: "history-bit",
        what: "a bit of a history flipped",
        cause: |s, trial, at| flipped(s, "histories", trial, at),
    },
    Fault {
        name: "summary-bit",
        what: "a bit of `summary.csv` flipped",
        cause: |s, trial, at| flipped(s, "summary.csv", trial, at),
    },
    Fault {
        name: "manifest-cut",
        what: "`manifest.json` cut off",
        cause: |s, _, at| cut(s, "manifest.json", at),
    },
    Fault {
        name: "journal-cut",
        what: "the journal cut off",
        cause: |s, _, at| cut(s, "journal.jsonl", at),
    },
    Fault {
        name: "write",
        what: "a `write` that fails, the disk being full",
        cause: |s, _, at| calls::failing(s, "write", "ENOSPC", at),
    },
    Fault {
        name: "fsync",
        what: "an `fsync` that fails",
        cause: |s, _, at| calls::failing(s, "fsync", "EIO", at),
    },
    Fault {
        name: "rename",
        what: "a `rename` that fails",
        cause: |s, _, at| calls::failing(s, "rename", "EIO", at),
    },
    Fault { name: "rank", what: "kill -9 of one of three MPI ranks", cause: rank_killed },
    Fault { name: "fresh", what: "four `--fresh` at once", cause: |s, _, _| at_once(s) },
];

/// The outcome once a user has given the same command again after `first`.
pub fn resumed(study: &Study, out: &Path, first: &Output) -> Result<Outcome> {
    let again = study.sweep(out, &[])?;
    let verdict = match again.status.code() {
        Some(0) if study.results(out)? == study.undisturbed => Verdict::Whole,
        Some(0) => Verdict::Lost("the results differ".to_owned()),
        Some(2) => Verdict::Refused,
        _ => Verdict::Lost(format!("resuming ended with {}: {}", code(&again), told(&again))),
    };
    let seen = if told(first).is_empty() { told(&again) } else { told(first) };
    Ok(Outcome { code: code(first), seen: shortened(&seen, out), verdict })
}

fn shortened(text: &str, out: &Path) -> String {
    let folder = out.parent().map_or_else(String::new, |folder| format!("{}/", folder.display()));
    text.replace(&folder, "").replace('|', "/").chars().take(300).collect()
}

fn signalled(study: &Study, signal: &str, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let child = study.command(&out, &[]).spawn()?;
    sleep(study.time.mul_f64(at));
    // It may have ended already.
    let _ = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).output()?;
    resumed(study, &out, &wait(child)?)
}

fn killed_often(study: &Study, at: f64) -> Result<Outcome> {
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

/// A rank is killed; the launcher ends the others.
fn rank_killed(study: &Study, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let child = study.job(&out, 3).context("no program with MPI was given")?.spawn()?;
    let ranks = || -> Vec<String> {
        let told = Command::new("pgrep").args(["-P", &child.id().to_string()]).output();
        let told = told.map(|output| output.stdout).unwrap_or_default();
        String::from_utf8_lossy(&told).lines().map(str::to_owned).collect()
    };
    while ranks().len() < 3 {
        sleep(study.time.mul_f64(0.001));
    }
    sleep(study.time.mul_f64(at));
    if let Some(rank) = ranks().get(trial as usize % 3) {
        let _ = Command::new("kill").args(["-KILL", rank]).output()?;
    }
    resumed(study, &out, &wait(child)?)
}

/// Something happens to the directory in the middle: the sweep must not end well.
fn disturbed(
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
    disturb(&out)?;
    let output = wait(child)?;
    let verdict = match output.status.code() {
        // It was done before.
        Some(0) if study.results(&out).is_ok_and(|files| files == study.undisturbed) => {
            Verdict::Whole
        }
        Some(0) => Verdict::Lost("it ended well, without its results".to_owned()),
        _ => Verdict::Refused,
    };
    Ok(Outcome { code: code(&output), seen: shortened(&told(&output), &out), verdict })
}

fn renamed(study: &Study, _: u64, at: f64) -> Result<Outcome> {
    disturbed(study, at, |out| fs::rename(out, out.with_extension("elsewhere")))
}

fn without_journal(study: &Study, _: u64, at: f64) -> Result<Outcome> {
    disturbed(study, at, |out| fs::remove_file(out.join("journal.jsonl")))
}

/// A file, or the first in a folder.
fn file(out: &Path, name: &str) -> Result<PathBuf> {
    let path = out.join(name);
    if !path.is_dir() {
        return Ok(path);
    }
    Ok(fs::read_dir(&path)?.next().context("an empty folder")??.path())
}

fn flipped(study: &Study, name: &str, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.finished("out")?;
    let path = file(&out, name)?;
    let mut bytes = fs::read(&path)?;
    let place = (bytes.len() as f64 * at) as usize;
    bytes[place] ^= 1 << (trial % 8);
    fs::write(&path, bytes)?;
    let verify = study.ask("verify", &out)?;
    let outcome = resumed(study, &out, &verify)?;
    let seen = String::from_utf8_lossy(&verify.stdout).lines().collect::<Vec<_>>().join(" / ");
    let unseen = verify.status.success().then(|| Verdict::Lost("it was not seen".to_owned()));
    let seen = if seen.is_empty() { outcome.seen } else { shortened(&seen, &out) };
    Ok(Outcome { verdict: unseen.unwrap_or(outcome.verdict), seen, ..outcome })
}

fn cut(study: &Study, name: &str, at: f64) -> Result<Outcome> {
    let out = study.finished("out")?;
    let path = file(&out, name)?;
    let bytes = fs::read(&path)?;
    fs::write(&path, &bytes[..(bytes.len() as f64 * at) as usize])?;
    let report = study.ask("report", &out)?;
    let outcome = resumed(study, &out, &report)?;
    let refused = report.status.code().is_some_and(|code| code == 0 || code == 2);
    let wrong = (!refused).then(|| Verdict::Lost(format!("report: {}", told(&report))));
    Ok(Outcome { verdict: wrong.unwrap_or(outcome.verdict), ..outcome })
}

/// Those that do not start over must be refused.
fn at_once(study: &Study) -> Result<Outcome> {
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
