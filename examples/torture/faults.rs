//! The faults, what a user does next, and what must come of it.

use std::path::Path;
use std::process::Output;

use anyhow::Result;

use super::calls::failing;
use super::damage::{Harm, cut, flipped, newer};
use super::processes::out_of_memory;
use super::processes::{abort, at_once, disturbed, flipped_checkpoint, killed_often, signalled};
use super::ranks::{Whom, job_signalled, other_build, other_words, rank_killed, rank_stopped};
use super::study::{Study, code, told};

/// A fault and how it is caused, given a trial's number and its share of all trials.
pub struct Fault {
    pub name: &'static str,
    pub what: &'static str,
    pub needs: Needs,
    pub cause: fn(&Study, u64, f64) -> Result<Outcome>,
}

/// What a fault cannot be caused without.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    Nothing,
    Strace,
    Mpi,
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

macro_rules! faults {
    ($($needs:ident { $($name:literal, $what:literal => $cause:expr;)* })*) => {
        pub const FAULTS: &[Fault] = &[$($(
            Fault { name: $name, what: $what, needs: Needs::$needs, cause: $cause },
        )*)*];
    };
}

faults! {
    Nothing {
        "kill", "kill -9 at any moment" => |s, _, at| signalled(s, "KILL", at);
        "term", "TERM at any moment" => |s, _, at| signalled(s, "TERM", at);
        "int", "Ctrl-C at any moment" => |s, _, at| signalled(s, "INT", at);
        "kills", "kill -9 six times in a row" => |s, _, at| killed_often(s, at);
        "memory", "a case that needs more memory than there is, each time" => out_of_memory;
        "abort", "a case that aborts its own process" => abort;
        "checkpoint-bit", "kill -9, and a bit of a case's checkpoint flipped" => flipped_checkpoint;
        "renamed", "output directory renamed while it runs" => |s, _, at| {
            disturbed(s, at, |out| std::fs::rename(out, out.with_extension("elsewhere")))
        };
        "deleted", "output directory deleted while it runs" => |s, _, at| {
            disturbed(s, at, |out| {
                while std::fs::remove_dir_all(out).is_err() {} // files come meanwhile
                Ok(())
            })
        };
        "no-journal", "journal deleted while it runs" => |s, _, at| {
            disturbed(s, at, |out| std::fs::remove_file(out.join("journal.jsonl")))
        };
        "journal-bit", "a bit of the journal flipped" => |s, trial, at| {
            flipped(s, "journal.jsonl", trial, at)
        };
        "history-bit", "a bit of a history flipped" => |s, trial, at| {
            flipped(s, "histories", trial, at)
        };
        "envelope-bit", "a bit of a table of pressures flipped" => |s, trial, at| {
            flipped(s, "envelopes", trial, at)
        };
        "summary-bit", "a bit of `summary.csv` flipped" => |s, trial, at| {
            flipped(s, "summary.csv", trial, at)
        };
        "manifest-cut", "`manifest.json` cut off" => |s, _, at| {
            cut(s, "manifest.json", Harm::Anywhere, at)
        };
        "journal-cut", "the journal cut off" => |s, _, at| {
            cut(s, "journal.jsonl", Harm::Anywhere, at)
        };
        "journal-empty", "the journal emptied, or cut off in its first line" => |s, trial, at| {
            cut(s, "journal.jsonl", Harm::FirstLine, if trial == 0 { 0.0 } else { at })
        };
        "journal-newer", "a record of a newer program at the journal's end" => newer;
        "fresh", "four `--fresh` at once" => |s, _, _| at_once(s);
    }
    Strace {
        "write", "a `write` that fails, the disk being full" => |s, _, at| {
            failing(s, "write", "ENOSPC", at)
        };
        "sync", "an `fsync`, `fdatasync` or `syncfs` that fails" => |s, _, at| {
            failing(s, "fsync,fdatasync,syncfs", "EIO", at)
        };
        "rename", "a `rename` that fails" => |s, _, at| failing(s, "rename", "EIO", at);
        "linkat", "a `linkat` that fails, the disk being full" => |s, _, at| {
            failing(s, "linkat", "ENOSPC", at)
        };
        "open", "an `openat` that fails, too many files being open" => |s, _, at| {
            failing(s, "openat", "EMFILE", at)
        };
        "mkdir", "a `mkdir` that fails, the disk being full" => |s, _, at| {
            failing(s, "mkdir", "ENOSPC", at)
        };
        "unlink", "an `unlink` that fails" => |s, _, at| failing(s, "unlink", "EIO", at);
    }
    Mpi {
        "rank", "kill -9 of one of three MPI ranks" => rank_killed;
        "stopped-rank", "one of three MPI ranks stopped (SIGSTOP), then killed" => rank_stopped;
        "mpirun-int", "Ctrl-C to `mpirun`" => |s, _, at| job_signalled(s, Whom::Launcher, "INT", at);
        "mpirun-term", "TERM to `mpirun`" => |s, _, at| job_signalled(s, Whom::Launcher, "TERM", at);
        "mpirun-kill", "kill -9 of `mpirun`" => |s, _, at| {
            job_signalled(s, Whom::Launcher, "KILL", at)
        };
        "script-int", "Ctrl-C to `scripts/sweep`" => |s, _, at| {
            job_signalled(s, Whom::Script, "INT", at)
        };
        "script-kill", "kill -9 of `scripts/sweep`" => |s, _, at| {
            job_signalled(s, Whom::Script, "KILL", at)
        };
        "builds", "another build on one of two MPI ranks" => other_build;
        "arguments", "other arguments on one of two MPI ranks" => other_words;
    }
}

/// The outcome once a user has given the same command again after `first`.
pub fn resumed(study: &Study, out: &Path, first: &Output) -> Result<Outcome> {
    judged(study, out, first, &[])
}

/// The same with more words on the command.
pub fn judged(study: &Study, out: &Path, first: &Output, more: &[&str]) -> Result<Outcome> {
    let again = study.sweep(out, more)?;
    let verdict = match again.status.code() {
        Some(0) if study.results(out)? == study.undisturbed => Verdict::Whole,
        Some(0) => Verdict::Lost("the results differ".to_owned()),
        Some(2) => Verdict::Refused,
        _ => Verdict::Lost(format!("resuming ended with {}: {}", code(&again), told(&again))),
    };
    let seen = if told(first).is_empty() { told(&again) } else { told(first) };
    Ok(Outcome { code: code(first), seen: shortened(&seen, out), verdict })
}

/// Told text for a cell of the table.
pub fn shortened(text: &str, out: &Path) -> String {
    let folder = out.parent().map_or_else(String::new, |folder| format!("{}/", folder.display()));
    text.replace(&folder, "").replace('|', "/").chars().take(300).collect()
}
