//! Damaged files of a finished sweep.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use sha2::{Digest, Sha256};

use super::faults::{Outcome, Verdict, resumed, shortened};
use super::study::{Study, told};

/// Where a file is cut off.
#[derive(Clone, Copy)]
pub enum Harm {
    Anywhere,
    FirstLine,
}

/// A file, or the first in a folder.
fn file(out: &Path, name: &str) -> Result<PathBuf> {
    let path = out.join(name);
    if !path.is_dir() {
        return Ok(path);
    }
    Ok(fs::read_dir(&path)?.next().context("an empty folder")??.path())
}

/// `verify` must see it.
pub fn flipped(study: &Study, name: &str, trial: u64, at: f64) -> Result<Outcome> {
    let out = study.finished("out")?;
    flip(&file(&out, name)?, trial, at)?;
    let verify = study.ask("verify", &out)?;
    let outcome = resumed(study, &out, &verify)?;
    let seen = String::from_utf8_lossy(&verify.stdout).lines().collect::<Vec<_>>().join(" / ");
    let unseen = verify.status.success().then(|| Verdict::Lost("it was not seen".to_owned()));
    let seen = if seen.is_empty() { outcome.seen } else { shortened(&seen, &out) };
    Ok(Outcome { verdict: unseen.unwrap_or(outcome.verdict), seen, ..outcome })
}

/// Flips one bit.
pub fn flip(path: &Path, trial: u64, at: f64) -> Result<()> {
    let mut bytes = fs::read(path)?;
    let place = (bytes.len() as f64 * at) as usize;
    bytes[place] ^= 1 << (trial % 8);
    Ok(fs::write(path, bytes)?)
}

/// `report` must make it again, or refuse.
pub fn cut(study: &Study, name: &str, harm: Harm, at: f64) -> Result<Outcome> {
    let out = study.finished("out")?;
    let path = file(&out, name)?;
    let bytes = fs::read(&path)?;
    let most = match harm {
        Harm::Anywhere => bytes.len(),
        Harm::FirstLine => bytes.iter().position(|&byte| byte == b'\n').unwrap_or_default(),
    };
    fs::write(&path, &bytes[..(most as f64 * at) as usize])?;
    let before = study.results(&out)?;
    let report = study.ask("report", &out)?;
    let mut outcome = resumed(study, &out, &report)?;
    if !matches!(report.status.code(), Some(0 | 2)) {
        outcome.verdict = Verdict::Lost(format!("report: {}", told(&report)));
    } else if matches!(outcome.verdict, Verdict::Refused) && study.results(&out)? != before {
        outcome.verdict = Verdict::Lost("refused, but touched".to_owned());
    }
    Ok(outcome)
}

/// It must be refused whole: what this program does not know it must not cut off.
pub fn newer(study: &Study, trial: u64, _: f64) -> Result<Outcome> {
    let out = study.finished("out")?;
    let path = out.join("journal.jsonl");
    let entry = format!("{{\"tide\":{{\"level_m\":{}}}}}", trial as f64 / 100.0);
    let digest = Sha256::digest(&entry);
    let sum: String = digest[..8].iter().map(|byte| format!("{byte:02x}")).collect();
    let mut journal = fs::OpenOptions::new().append(true).open(&path)?;
    writeln!(journal, "{{\"sum\":\"{sum}\",\"entry\":{entry}}}")?;
    let before = fs::read(&path)?;
    let first = study.sweep(&out, &[])?;
    let mut outcome = resumed(study, &out, &first)?;
    if fs::read(&path)? != before || study.results(&out)? != study.undisturbed {
        outcome.verdict = Verdict::Lost("refused, but touched".to_owned());
    }
    Ok(outcome)
}
