//! Threads that stand by. They look for work for a while before they sleep, because waking up takes
//! longer than a pass over a few thousand particles.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use rayon::{Yield, yield_now};

/// A thread that waits for another's part looks for work this many times before it sleeps: some
/// tenths of a millisecond.
const SHORT_WAIT: u32 = 1000;
/// A thread on standby looks this many times before it naps: some milliseconds.
const LONG_WAIT: u32 = 10_000;
/// Length of a nap.
const NAP: Duration = Duration::from_micros(50);

/// Does work while the other threads of the team stand by. A thread that sleeps between two shares
/// of the work would wake too late.
pub(super) fn attended<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    /// Releases the others, also if the work panics.
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

/// Does two pieces of work, at the same time if another thread takes the second.
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

/// Does other threads' open work until `done`, or until there was none in `most` looks.
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
