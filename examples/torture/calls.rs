//! System calls that fail: strace puts an error in the place of one call in its turn.

use std::process::{Command, Stdio};

use anyhow::{Result, ensure};

use super::faults::{Outcome, resumed};
use super::study::{Study, wait};

/// Whether this machine has strace and lets it trace.
pub fn is_there() -> bool {
    let mut trial = Command::new("strace");
    trial
        .args(["-f", "-qq", "-o", "/dev/null", "true"])
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    trial.status().is_ok_and(|status| status.success())
}

/// The sweep, in which the call of this number fails.
fn under_strace(study: &Study, out: &std::path::Path, expression: &[String]) -> Command {
    let command = study.command(out, &[]);
    let mut traced = Command::new("strace");
    traced.args(["-f", "-qq", "-o"]).arg(out.with_extension("calls")).args(expression);
    traced.arg(command.get_program()).args(command.get_args());
    traced.stdout(Stdio::null()).stderr(Stdio::piped());
    traced
}

/// How often the sweep does a call.
fn count(study: &Study, call: &str) -> Result<usize> {
    let out = study.room("out")?;
    let trace = ["-e".to_owned(), format!("trace={call}")];
    let output = wait(under_strace(study, &out, &trace).spawn()?)?;
    ensure!(output.status.success(), "a traced sweep failed");
    let text = std::fs::read_to_string(out.with_extension("calls"))?;
    let names: Vec<_> = call.split(',').map(|name| format!("{name}(")).collect();
    let is_one = |line: &&str| names.iter().any(|name| line.contains(name));
    Ok(text.lines().filter(is_one).count())
}

/// The call in question fails once, further on in the sweep with every trial.
pub fn failing(study: &Study, call: &str, error: &str, at: f64) -> Result<Outcome> {
    let calls = count(study, call)?;
    let when = 1 + (calls as f64 * at) as usize;
    let out = study.room("out")?;
    let trace = ["-e".to_owned(), format!("trace={call}"), "-e".to_owned()];
    let inject = [format!("inject={call}:error={error}:when={when}")];
    let output = wait(under_strace(study, &out, &[&trace[..], &inject].concat()).spawn()?)?;
    resumed(study, &out, &output)
}
