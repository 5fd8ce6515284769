//! Asking a sweep to stop: SIGINT, SIGTERM or SIGUSR1.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM, SIGUSR1};
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
        for signal in [SIGINT, SIGTERM, SIGUSR1] {
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

impl Monitor for Interrupt {
    fn cancelled(&self) -> bool {
        self.is_raised()
    }
}
