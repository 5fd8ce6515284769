//! Work in a process of its own, because an earlier process may have died of it.
//!
//! The child is this program, with the hidden subcommand `apart`. It reads a task from standard
//! input and writes a [`Result`] to standard output. If it dies, its work has failed and nothing else.

use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::gauge::Limited;
use super::keeping::Keeping;
use super::memory::kilobytes;
use super::message::Posted;
use super::runner::{Runner, guarded};
use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, Failure, FailureKind, Limits, Monitor, Resources, Stopped, TrunkResult,
};

/// The hidden subcommand.
pub const SUBCOMMAND: &str = "apart";
/// Time between two checks of a child.
const PAUSE: Duration = Duration::from_millis(5);
/// Time for a child to report that its time limit is reached, and the simulated time.
const GRACE: Duration = Duration::from_secs(2);
/// Time between two checks of a child on its parent.
const WATCH: Duration = Duration::from_millis(100);

/// The task of a child.
#[derive(Debug, Serialize, Deserialize)]
struct Task {
    trunk: bool,
    config: Posted,
    checkpoint: Option<Vec<u8>>,
    resources: Resources,
    keep: Option<Keeping>,
    limits: Limits,
}

/// Runs each piece of work in a child.
#[derive(Debug, Clone)]
pub struct Apart {
    /// What the child may use.
    pub resources: Resources,
    /// Whether and where it keeps checkpoints.
    pub keep: Option<Keeping>,
}

impl Runner for Apart {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        self.ask(true, config, None, monitor)
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        self.ask(false, config, checkpoint, monitor)
    }
}

impl Apart {
    fn ask<T: DeserializeOwned + Send>(
        &self,
        trunk: bool,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<T, Stopped> {
        let config = Posted::from(config);
        let checkpoint = checkpoint.map(<[u8]>::to_vec);
        let (resources, keep) = (self.resources, self.keep.clone());
        let limits = monitor.limits();
        let task = Task { trunk, config, checkpoint, resources, keep, limits };
        let task = postcard::to_stdvec(&task).expect("a task is plain data");
        let failed = |kind: FailureKind, detail: String| {
            Stopped::Failed(Failure { kind, time_s: 0.0, detail })
        };
        let broken = |error: std::io::Error| {
            failed(FailureKind::Internal, format!("a process of its own: {error}"))
        };
        let mut child = start().map_err(broken)?;
        let heard = talk(&mut child, &task, monitor).map_err(broken)?;
        let Heard { answer, complaint, status } = match heard {
            Ended::Itself(heard) => heard,
            Ended::Told => return Err(Stopped::Interrupted),
            Ended::TooLarge(detail) => return Err(failed(FailureKind::OverLimit, detail)),
        };
        match postcard::from_bytes::<Result<T, Stopped>>(&answer) {
            Ok(result) if status.success() => result,
            _ => {
                let first = complaint.lines().find(|line| !line.trim().is_empty());
                let first = first.map(|line| format!(": {}", line.trim())).unwrap_or_default();
                Err(failed(FailureKind::EndedTheProcess, format!("{status}{first}")))
            }
        }
    }
}

/// A child that is no part of an MPI job.
fn start() -> std::io::Result<Child> {
    let mut command = Command::new(std::env::current_exe()?);
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        if ["OMPI_", "PMI", "MPI", "SLURM_"].iter().any(|start| text.starts_with(start)) {
            command.env_remove(&name);
        }
    }
    // A signal from the terminal is for the parent, which decides what happens to the child.
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    let pipes = command.arg(SUBCOMMAND).stdin(Stdio::piped()).stdout(Stdio::piped());
    pipes.stderr(Stdio::piped()).spawn()
}

/// The output and the status of a child.
struct Heard {
    answer: Vec<u8>,
    complaint: String,
    status: std::process::ExitStatus,
}

/// How a child ended.
enum Ended {
    Itself(Heard),
    /// It was asked to stop.
    Told,
    /// It took more memory than it may.
    TooLarge(String),
}

/// Hands a child its task and waits for it.
fn talk(child: &mut Child, task: &[u8], monitor: &dyn Monitor) -> std::io::Result<Ended> {
    let limits = monitor.limits();
    let (input, output, errors) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    std::thread::scope(|scope| {
        let answer = scope.spawn(move || read_all(output));
        let complaint = scope.spawn(move || read_all(errors));
        // A child that dies before it has read everything breaks the pipe. Its status then says
        // why.
        let _ = input.map(|mut input| input.write_all(task));
        let mut too_late: Option<Instant> = None;
        let status = loop {
            if let Some(status) = child.try_wait()? {
                break Ok(status);
            }
            // The child counts its steps itself.
            let taken = peak_bytes(child.id()).filter(|_| limits.memory_mib.is_some());
            let over = taken.and_then(|bytes| limits.on_memory(bytes, "takes"));
            let late = monitor
                .over_limit(0)
                .filter(|_| too_late.get_or_insert_with(Instant::now).elapsed() > GRACE);
            let over = over.or(late);
            if over.is_some() || monitor.cancelled() {
                child.kill()?;
                child.wait()?;
                break Err(over.map_or(Ended::Told, Ended::TooLarge));
            }
            std::thread::sleep(PAUSE);
        };
        let [answer, complaint] =
            [answer, complaint].map(|reader| reader.join().unwrap_or_default());
        let complaint = String::from_utf8_lossy(&complaint).into_owned();
        let heard = |status| Ended::Itself(Heard { answer, complaint, status });
        Ok(status.map_or_else(|ended| ended, heard))
    })
}

/// The most memory that a process has taken so far, if the system provides it.
fn peak_bytes(process: u32) -> Option<u64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    kilobytes(&text, "VmHWM:")
}

fn read_all(pipe: Option<impl Read>) -> Vec<u8> {
    let mut bytes = Vec::new();
    // After an error there is no more output.
    let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
    bytes
}

/// Ends this process soon after its parent ends. Nobody waits for its answer then, and the next
/// process with this work writes the same checkpoint.
fn end_with_parent() {
    let parent = std::os::unix::process::parent_id();
    std::thread::spawn(move || {
        while std::os::unix::process::parent_id() == parent {
            std::thread::sleep(WATCH);
        }
        std::process::exit(1);
    });
}

/// The child's side: reads a task from `input`, runs it on the runner from `make_runner`, and
/// writes the answer to `output`.
///
/// # Errors
/// A task that cannot be read, or an output that is closed.
pub fn serve<R: Runner>(
    mut input: impl Read,
    mut output: impl Write,
    make_runner: impl FnOnce(Resources, Option<Keeping>) -> R,
) -> anyhow::Result<()> {
    let mut bytes = Vec::new();
    input.read_to_end(&mut bytes)?;
    let task: Task = postcard::from_bytes(&bytes)?;
    let config = task.config.read().map_err(anyhow::Error::msg)?;
    end_with_parent();
    let runner = make_runner(task.resources, task.keep);
    let checkpoint = task.checkpoint.as_deref();
    let monitor = Limited { limits: task.limits, since: Instant::now() };
    let answer = if task.trunk {
        postcard::to_stdvec(&guarded(|| runner.trunk(&config, &monitor)))?
    } else {
        postcard::to_stdvec(&guarded(|| runner.case(&config, checkpoint, &monitor)))?
    };
    output.write_all(&answer)?;
    Ok(output.flush()?)
}

#[cfg(test)]
mod tests;
