//! Threads that stand by: they look for work for a while before they go to sleep, as waking up takes
//! longer than a pass over a few thousand particles.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use rayon::{Yield, yield_now};

/// Looks for work before a thread goes to sleep that waits for another's part: some tenths of a
/// millisecond.
const SHORT_WAIT: u32 = 1000;
/// Looks of a thread that stands by, before it takes a nap: some milliseconds.
const LONG_WAIT: u32 = 10_000;
/// How long that is.
const NAP: Duration = Duration::from_micros(50);

/// Does work while the other threads of the team stand by: between two shares of it, a thread that had
/// gone to sleep would wake too late.
pub(super) fn attended<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    /// Lets the others go, should the work end by a panic, too.
    struct Over<'a>(&'a AtomicBool);
    impl Drop for Over<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Release);
        }
    }
    let over = AtomicBool::new(false);
    let leader = rayon::current_thread_index();
    rayon::in_place_scope(|scope| {
        let _end = Over(&over);
        scope.spawn_broadcast(|_, of| {
            while Some(of.index()) != leader && !over.load(Ordering::Acquire) {
                help_until(&over, LONG_WAIT);
                std::thread::sleep(NAP);
            }
        });
        work()
    })
}

/// Does two pieces of work, at once where another thread takes up the second.
pub(super) fn join(first: impl FnOnce() + Send, second: impl FnOnce() + Send) {
    let done = AtomicBool::new(false);
    let first = || {
        first();
        help_until(&done, SHORT_WAIT);
    };
    let second = || {
        second();
        done.store(true, Ordering::Release);
    };
    rayon::join(first, second);
}

/// Takes up what the others leave to do, until something is done, or there was nothing to do in so many
/// looks.
fn help_until(done: &AtomicBool, most: u32) {
    let mut looks = 0;
    while looks < most && !done.load(Ordering::Acquire) {
        if yield_now() == Some(Yield::Executed) {
            looks = 0;
        } else {
            looks += 1;
            // Other programs may want the processor.
            std::thread::yield_now();
        }
    }
}
