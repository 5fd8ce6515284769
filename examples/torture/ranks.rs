//! What happens to jobs of several MPI ranks.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Output};
use std::sync::mpsc::channel;
use std::thread::sleep;
use std::time::Duration;

use anyhow::{Context, Result};

use super::faults::{Outcome, Verdict, resumed, shortened};
use super::study::{Study, children, code, signal, told, wait};

/// Who gets a signal.
#[derive(Clone, Copy)]
pub enum Whom {
    Launcher,
    Script,
}

/// A job of three ranks, and these.
fn started(study: &Study, out: &Path, more: &[&str]) -> Result<(Child, Vec<u32>)> {
    let child = study.job(out, 3, more)?.spawn()?;
    loop {
        let ranks = children(child.id());
        if ranks.len() == 3 {
            return Ok((child, ranks));
        }
        sleep(study.time.mul_f64(0.001));
    }
}

/// Until the sweep is under way, or the job has ended.
fn await_journal(study: &Study, out: &Path, child: &mut Child) -> Result<()> {
    while !out.join("journal.jsonl").exists() && child.try_wait()?.is_none() {
        sleep(study.time.mul_f64(0.001));
    }
    Ok(())
}

/// A rank is killed; the launcher ends the others.
pub fn rank_killed(study: &Study, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let (child, ranks) = started(study, &out, &[])?;
    sleep(study.time.mul_f64(at));
    signal(ranks[trial as usize % 3], "KILL");
    resumed(study, &out, &wait(child)?)
}

/// A rank stops; it must be named, unless all is done without it. Then it is killed.
pub fn rank_stopped(study: &Study, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let number = trial as usize % 3;
    // Before its ranks have met, a job is the launcher's alone.
    let (mut child, ranks) = started(study, &out, &["--hung-after-s", "1"])?;
    let (sender, lines) = channel();
    let stderr = BufReader::new(child.stderr.take().context("no standard error")?);
    let reader = std::thread::spawn(move || {
        let _ = stderr.lines().map_while(Result::ok).try_for_each(|line| sender.send(line));
    });
    await_journal(study, &out, &mut child)?;
    sleep(study.time.mul_f64(0.5 * at));
    signal(ranks[number], "STOP");
    let warning = format!("warning: rank {number} ");
    let mut seen = Vec::new();
    // Both are told on standard error: that a rank hangs, and that there is nothing more to do.
    while let Ok(line) = lines.recv_timeout(Duration::from_secs(5)) {
        seen.push(line);
        if seen.last().is_some_and(|line| line.contains(&warning)) {
            break;
        }
    }
    let named = seen.iter().any(|line| line.contains(&warning));
    let done = study.results(&out).is_ok_and(|files| files == study.undisturbed);
    signal(ranks[number], "KILL");
    let output = wait(child)?;
    let _ = reader.join();
    let mut outcome = resumed(study, &out, &output)?;
    if !named && !done {
        outcome.verdict = Verdict::Lost("the rank was not named".to_owned());
    }
    let warnings = seen.iter().filter(|line| line.contains(&warning));
    outcome.seen = warnings.cloned().collect::<Vec<_>>().join(" / ");
    outcome.code += if named { ", named" } else { ", done before" };
    Ok(outcome)
}

/// A launcher, or the script around it, gets a signal once the sweep is under way.
pub fn job_signalled(study: &Study, whom: Whom, name: &str, at: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let mut command = match whom {
        Whom::Launcher => study.job(&out, 3, &[])?,
        Whom::Script => study.script(&out)?,
    };
    let mut child = command.spawn()?;
    await_journal(study, &out, &mut child)?;
    sleep(study.time.mul_f64(at));
    signal(child.id(), name);
    let output = wait(child)?;
    let outcome = resumed(study, &out, &output)?;
    let told = output.status.code();
    let wrong = match whom {
        // Launchers have codes of their own.
        Whom::Script if name == "INT" => !matches!(told, Some(0 | 3)),
        _ => false,
    };
    let wrong = wrong.then(|| Verdict::Lost(format!("ended with {}", code(&output))));
    Ok(Outcome { verdict: wrong.unwrap_or(outcome.verdict), ..outcome })
}

/// A copy of the program that says of itself to be of other sources.
fn disguised(study: &Study, out: &Path) -> Result<PathBuf> {
    let program = study.mpi()?;
    let sources = seawall::results::Program::this().sources;
    let mut bytes = fs::read(program)?;
    let word = sources.as_bytes();
    let found = bytes.windows(word.len()).position(|window| window == word);
    let at = found.context("the program with MPI is of other sources than this one")?;
    bytes[at] = if word[0] == b'0' { b'1' } else { b'0' };
    let copy = out.with_extension("program");
    fs::write(&copy, bytes)?;
    fs::set_permissions(&copy, fs::metadata(program)?.permissions())?;
    Ok(copy)
}

/// It must be refused before anything is written.
fn refused(study: &Study, out: &Path, output: &Output) -> Result<Outcome> {
    let verdict = match output.status.success() || out.exists() {
        true => Verdict::Lost("it was not refused, or something was written".to_owned()),
        false => Verdict::Refused,
    };
    let told = told(output);
    let errors: Vec<_> = told.split(" / ").filter(|line| line.starts_with("error: ")).collect();
    let seen = shortened(&errors.join(" / "), out);
    let outcome = resumed(study, out, output)?;
    let well = matches!(outcome.verdict, Verdict::Whole);
    Ok(Outcome { verdict: if well { verdict } else { outcome.verdict }, seen, ..outcome })
}

/// Two ranks, the second with another program or other words.
fn pair(study: &Study, out: &Path, second: &Path, more: &[&str]) -> Result<Output> {
    let mut command = study.job(out, 1, &[])?;
    command.args([":", "-n", "1"]).arg(second).arg("sweep").arg(study.file());
    command.args(["--threads", "1", "--film", "none", "--out"]).arg(out).args(more);
    wait(command.spawn()?)
}

pub fn other_build(study: &Study, _: u64, _: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let other = disguised(study, &out)?;
    let output = pair(study, &out, &other, &[])?;
    refused(study, &out, &output)
}

pub fn other_words(study: &Study, _: u64, _: f64) -> Result<Outcome> {
    let out = study.room("out")?;
    let output = pair(study, &out, study.mpi()?, &["--set", "numerics.particle_spacing_m=0.03"])?;
    refused(study, &out, &output)
}
