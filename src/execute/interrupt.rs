//! Asking a sweep to stop: SIGINT, SIGTERM, SIGUSR1, or SIGHUP where its terminal goes away.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1};
use signal_hook::flag;

use crate::simulation::Monitor;

/// Set once the user wants to stop.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

/// Exit code of an interrupted sweep, also of one that is told twice.
const INTERRUPTED: i32 = 3;

impl Interrupt {
    /// Listens to the signals: the first one sets the flag, a second one ends the process at
    /// once (the journal is whole even then).
    pub fn listen() -> std::io::Result<Interrupt> {
        let interrupt = Interrupt::default();
        // What `nohup` has started outlives its terminal.
        let hang_up = Some(SIGHUP).filter(|&signal| !is_ignored(signal));
        for signal in [SIGINT, SIGTERM, SIGUSR1].into_iter().chain(hang_up) {
            flag::register_conditional_shutdown(signal, INTERRUPTED, interrupt.0.clone())?;
            flag::register(signal, interrupt.0.clone())?;
        }
        Ok(interrupt)
    }

    /// Whether to stop.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Asks to stop, as a signal would.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Whether this process was started to ignore a signal, as far as the system tells.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

impl Monitor for Interrupt {
    fn cancelled(&self) -> bool {
        self.is_raised()
    }
}
