//! Requests to stop a sweep: SIGINT, SIGTERM, SIGUSR1, or SIGHUP if its terminal closes.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGXFSZ};
use signal_hook::iterator::Signals;
use signal_hook::{flag, low_level};

use crate::simulation::Monitor;

/// Set once work must stop, by the user or by the program itself.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

/// Exit code of an interrupted sweep, also after a second signal.
const INTERRUPTED: i32 = 3;

/// Signals within this time count as one request. A terminal sends Ctrl-C to a program and also to
/// its parent, which passes it on. So does `timeout`.
const AT_ONCE: Duration = Duration::from_millis(300);

impl Interrupt {
    /// Listens to the signals. The first one sets the flag; a later one ends the process at once
    /// (the journal is complete even then).
    pub fn listen() -> std::io::Result<Interrupt> {
        let interrupt = Interrupt::default();
        // Programs started by `nohup` outlive their terminal.
        let hang_up = Some(SIGHUP).filter(|&signal| !is_ignored(signal));
        let heeded: Vec<_> = [SIGINT, SIGTERM, SIGUSR1].into_iter().chain(hang_up).collect();
        for signal in &heeded {
            flag::register(*signal, interrupt.0.clone())?;
        }
        let mut signals = Signals::new(heeded)?;
        let end_when_told_again = move || {
            let mut first = None;
            for _ in signals.forever() {
                if first.get_or_insert_with(Instant::now).elapsed() > AT_ONCE {
                    low_level::exit(INTERRUPTED);
                }
            }
        };
        thread::Builder::new().name("signals".to_owned()).spawn(end_when_told_again)?;
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

/// Makes a write beyond `ulimit -f` fail like one to a full disk. Otherwise the system would end
/// the process without a message.
pub fn outlive_long_files() -> std::io::Result<()> {
    flag::register(SIGXFSZ, Arc::default()).map(drop)
}

/// Whether this process was started to ignore a signal, if the system provides it.
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
