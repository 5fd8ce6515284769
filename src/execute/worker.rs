//! Runs the orders of one process: cases on a pool of threads, with the checkpoints in memory.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use rayon::Scope;

use super::gauge::Gauges;
use super::interrupt::Interrupt;
use super::message::{Order, Posted, Reached, Report};
use super::runner::{Runner, guarded};
use crate::math::team::thread_processor_time;
use crate::results::{Delivery, Filing, SweepError};
use crate::scene::CaseConfig;
use crate::schedule::{Held, Work};
use crate::simulation::{Failure, FailureKind, Limits, Stopped, TrunkResult, cost};
use crate::study::CaseId;

/// A trunk or a case to run.
struct Task {
    work: Work,
    config: Posted,
    /// Whether to run in a process of its own.
    apart: bool,
    limits: Limits,
    files: Option<CaseId>,
}

/// A report from a worker's thread to the main thread, and the checkpoint that the work has left.
type Ended = (Report, Option<Vec<u8>>);

pub(super) struct Worker<'run, 'scope> {
    scope: &'run Scope<'scope>,
    runner: &'scope dyn Runner,
    /// Where cases leave their files. Without it whole results are reported.
    filing: Option<&'scope Filing>,
    cancel: &'scope Interrupt,
    gauges: &'scope Gauges,
    rank: usize,
    checkpoints: HashMap<usize, Arc<[u8]>>,
    parked: HashMap<usize, Vec<Task>>,
    sender: Sender<Ended>,
    receiver: Receiver<Ended>,
}

/// Runs `body` with a worker of this many threads. Every case has ended when it returns.
pub(super) fn with_worker<T>(
    rank: usize,
    threads: usize,
    runner: &dyn Runner,
    filing: Option<&Filing>,
    body: impl FnOnce(&mut Worker<'_, '_>) -> T,
) -> Result<T, SweepError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.max(1))
        .thread_name(|number| format!("case-{number}"))
        .stack_size(8 << 20)
        .build()
        .map_err(|error| SweepError::Executor(format!("cannot start threads: {error}")))?;
    let (cancel, gauges) = (Interrupt::default(), Gauges::default());
    Ok(pool.in_place_scope(|scope| {
        let (sender, receiver) = channel();
        let mut worker = Worker {
            scope,
            runner,
            filing,
            cancel: &cancel,
            gauges: &gauges,
            rank,
            checkpoints: HashMap::new(),
            parked: HashMap::new(),
            sender,
            receiver,
        };
        body(&mut worker)
    }))
}

impl Drop for Worker<'_, '_> {
    /// The present work is of no use any more, also if the leader fails or panics.
    fn drop(&mut self) {
        self.cancel.raise();
    }
}

impl Worker<'_, '_> {
    /// Takes an order. A returned checkpoint must be fetched from another rank and given to
    /// [`Worker::arrive`].
    pub(super) fn take(&mut self, order: Order) -> Option<Held> {
        match order {
            Order::Run { work, config, from, apart, limits, files } => {
                let task = Task { work, config, apart, limits, files };
                match from {
                    Some(from) => return self.start_branch(task, from),
                    None => self.start(task, None),
                }
            }
            Order::Drop { trunk } => {
                self.checkpoints.remove(&trunk);
            }
            Order::Cancel => self.cancel.raise(),
        }
        None
    }

    /// The checkpoint of a trunk, for another rank.
    pub(super) fn checkpoint(&self, trunk: usize) -> Option<Arc<[u8]>> {
        self.checkpoints.get(&trunk).cloned()
    }

    /// A checkpoint has come from another rank. If the other rank had none, the waiting cases run
    /// from rest, with the same result.
    pub(super) fn arrive(&mut self, trunk: usize, bytes: Option<Vec<u8>>) {
        let bytes: Option<Arc<[u8]>> = bytes.map(Arc::from);
        if let Some(bytes) = &bytes {
            self.checkpoints.insert(trunk, bytes.clone());
        }
        for parked in self.parked.remove(&trunk).unwrap_or_default() {
            self.start(parked, bytes.clone());
        }
    }

    /// The next report, `None` after the given time without one.
    pub(super) fn poll(&mut self, patience: Duration) -> Option<Report> {
        let ended = match patience {
            Duration::ZERO => self.receiver.try_recv().ok(),
            _ => self.receiver.recv_timeout(patience).ok(),
        };
        let (report, checkpoint) = ended?;
        if let (Report::TrunkDone { trunk, .. }, Some(checkpoint)) = (&report, checkpoint) {
            self.checkpoints.insert(*trunk, Arc::from(checkpoint));
        }
        Some(report)
    }

    /// The present work of this process, with its progress on the way from rest to the end of its
    /// case.
    pub(super) fn under_way(&self) -> Vec<(Work, f64)> {
        self.gauges.read()
    }

    fn start_branch(&mut self, task: Task, from: Held) -> Option<Held> {
        if let Some(bytes) = self.checkpoint(from.trunk) {
            self.start(task, Some(bytes));
            return None;
        }
        // A checkpoint on its way to this rank counts as here.
        if from.holder == self.rank && !self.parked.contains_key(&from.trunk) {
            self.start(task, None);
            return None;
        }
        let waiting = self.parked.entry(from.trunk).or_default();
        waiting.push(task);
        (waiting.len() == 1).then_some(from)
    }

    fn start(&self, task: Task, checkpoint: Option<Arc<[u8]>>) {
        let (runner, cancel, sender) = (self.runner, self.cancel, self.sender.clone());
        let (gauges, filing) = (self.gauges, self.filing);
        self.scope.spawn(move |_| {
            let Task { work, config, apart, limits, files } = task;
            // The memory of a piece of work is only known in a process of its own.
            let child = runner.apart().filter(|_| apart || limits.memory_mib.is_some());
            let runner = child.as_deref().unwrap_or(runner);
            let (start, cpu_start) = (Instant::now(), thread_processor_time());
            let watch = |config: &CaseConfig| gauges.watch(cancel, work, config, limits);
            let ended = match work {
                Work::Trunk(trunk) => {
                    let run = |config: &CaseConfig| runner.trunk(config, &watch(config));
                    let (result, checkpoint) = match attempt(cancel, config, limits, run) {
                        Ok(TrunkResult { steps, checkpoint, time_s }) => {
                            (Ok(Reached { steps, time_s }), Some(checkpoint))
                        }
                        Err(stopped) => (Err(stopped), None),
                    };
                    let wall_time_s = start.elapsed().as_secs_f64();
                    (Report::TrunkDone { trunk, result, wall_time_s }, checkpoint)
                }
                Work::Case(case) => {
                    let from = checkpoint.as_deref();
                    let result = attempt(cancel, config, limits, |config| {
                        from_checkpoint(from, |from| runner.case(config, from, &watch(config)))
                    });
                    let cpu_time_s =
                        thread_processor_time().zip(cpu_start).map(|(end, start)| end - start);
                    let wall_time_s = start.elapsed().as_secs_f64();
                    let result = result.map(|result| match filing {
                        Some(filing) => filing.deliver(files, result),
                        None => Delivery::Whole(Box::new(result)),
                    });
                    (Report::CaseDone { case, result, wall_time_s, cpu_time_s }, None)
                }
            };
            // The receiver is gone only if nobody waits for results any more.
            let _ = sender.send(ended);
        });
    }
}

/// Runs a case from a checkpoint, or from rest if that cannot be read.
fn from_checkpoint<T>(
    checkpoint: Option<&[u8]>,
    run: impl Fn(Option<&[u8]>) -> Result<T, Stopped>,
) -> Result<T, Stopped> {
    match run(checkpoint) {
        Err(Stopped::Failed(failure))
            if checkpoint.is_some() && failure.kind == FailureKind::CheckpointUnreadable =>
        {
            run(None)
        }
        result => result,
    }
}

/// Runs some work guarded against panics, unless it is already too late.
fn attempt<T>(
    cancel: &Interrupt,
    config: Posted,
    limits: Limits,
    run: impl Fn(&CaseConfig) -> Result<T, Stopped>,
) -> Result<T, Stopped> {
    if cancel.is_raised() {
        return Err(Stopped::Interrupted);
    }
    let failed = |kind, detail: String| Stopped::Failed(Failure { kind, time_s: 0.0, detail });
    let internal = |detail: String| failed(FailureKind::Internal, detail);
    let config = config
        .read()
        .map_err(|error| internal(format!("the configuration cannot be read: {error}")))?;
    let memory_bytes = || cost(&config).memory_bytes;
    let over = limits.memory_mib.and_then(|_| limits.on_memory(memory_bytes(), "needs some"));
    if let Some(detail) = over {
        return Err(failed(FailureKind::OverLimit, detail));
    }
    match guarded(|| run(&config)) {
        Err(Stopped::Interrupted) if !cancel.is_raised() => {
            Err(internal("stopped though nobody asked".to_owned()))
        }
        result => result,
    }
}

#[cfg(test)]
mod tests;
