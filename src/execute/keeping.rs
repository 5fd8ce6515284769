//! Long work stores its state in the output directory, and goes on from it.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::keys::{named, shown};
use crate::results::Checkpoint;
use crate::simulation::{Keeper, Monitor};

/// Less work than this is not worth a checkpoint when a run must stop.
const LEAST: Duration = Duration::from_secs(1);

/// Where checkpoints are stored, and how often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Keeping {
    /// The output directory.
    pub directory: PathBuf,
    /// Time between checkpoints.
    pub every: Duration,
}

impl Keeping {
    /// In an output directory, at this interval, seconds; none if it is 0.
    pub fn new(directory: &Path, every_s: f64) -> Option<Keeping> {
        let every = Duration::try_from_secs_f64(every_s).unwrap_or(Duration::MAX);
        (!every.is_zero()).then(|| Keeping { directory: directory.to_owned(), every })
    }

    /// Does a piece of work under its monitor, and stores its state.
    pub(super) fn during<T>(
        &self,
        checkpoint: Checkpoint,
        inner: &dyn Monitor,
        work: impl FnOnce(&dyn Monitor) -> T,
    ) -> T {
        let since = Mutex::new(Instant::now());
        let told = AtomicBool::new(false);
        work(&Kept { inner, keeper: FileKeeper { checkpoint, every: self.every, since, told } })
    }
}

/// A monitor that also stores states.
struct Kept<'a> {
    inner: &'a dyn Monitor,
    keeper: FileKeeper,
}

impl Monitor for Kept<'_> {
    fn inner(&self) -> Option<&dyn Monitor> {
        Some(self.inner)
    }

    fn keeper(&self) -> Option<&dyn Keeper> {
        Some(&self.keeper)
    }
}

/// Stores a state in a file.
struct FileKeeper {
    checkpoint: Checkpoint,
    every: Duration,
    /// Time of the last checkpoint, or of the start.
    since: Mutex<Instant>,
    /// Whether it was already reported that checkpoints cannot be stored here.
    told: AtomicBool,
}

impl FileKeeper {
    fn tell(&self, what: &str) {
        if !self.told.swap(true, Ordering::Relaxed) {
            // If the message cannot be written, the case must still go on.
            let path = named(self.checkpoint.path());
            let _ = writeln!(std::io::stderr(), "note: {path}: {}", shown(what));
        }
    }
}

impl Keeper for FileKeeper {
    fn last(&self) -> Option<Vec<u8>> {
        // Damage was reported when the directory was opened.
        self.checkpoint.read().ok().flatten()
    }

    fn is_due(&self, stopping: bool) -> bool {
        let since = *self.since.lock().unwrap_or_else(PoisonError::into_inner);
        since.elapsed() >= if stopping { self.every.min(LEAST) } else { self.every }
    }

    fn keep(&self, state: Vec<u8>) {
        if let Err(error) = self.checkpoint.write(&state) {
            self.tell(&format!("no checkpoint could be written: {error}"));
        }
        *self.since.lock().unwrap_or_else(PoisonError::into_inner) = Instant::now();
    }

    fn refuse(&self, why: &str) {
        self.tell(&format!("{why}; it starts over"));
    }
}
