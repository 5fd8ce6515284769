//! The threads of a team: they stand by between two shares of the work, and take pieces of it as they come.
//!
//! A pass over a few thousand particles takes some tenths of a millisecond, less than to wake a thread. So the threads
//! look for work for a while before they take naps.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::Ordering::{AcqRel, Acquire, Relaxed, Release};
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicU64, AtomicUsize};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Looks for work in a row before a thread gives way to other programs.
const LOOKS: u32 = 32;
/// Ways given before a thread that stands by takes a nap: some milliseconds.
const WAYS: u32 = 4000;
/// How long that is.
const NAP: Duration = Duration::from_micros(50);

/// Work in pieces, by their numbers.
type Job<'a> = &'a (dyn Fn(usize) + Sync);

/// What has been thrown by a piece.
type Thrown = Box<dyn Any + Send>;

/// The threads that stand by, and what they look at.
#[derive(Debug)]
pub(super) struct Crew {
    threads: usize,
    /// The number of the job (32 bits), how many pieces it has (16), and the first that nobody has taken (16).
    turn: AtomicU64,
    /// Where the job is: with whoever has posted it, who stays until nothing is left of it.
    job: AtomicPtr<Job<'static>>,
    /// Pieces of it that are not done.
    left: AtomicUsize,
    /// Whether there is a job: another one beside it, or within it, is done by whoever has it.
    busy: AtomicBool,
    /// Whether somebody leads, and threads stand by.
    led: AtomicBool,
    /// Whether the work is over.
    over: AtomicBool,
    thrown: Mutex<Option<Thrown>>,
}

/// More pieces than this are not told apart.
pub(super) const MOST: usize = 64;

impl Crew {
    /// So many threads, the leader being one of them. They start when they are led.
    pub(super) fn new(threads: usize) -> Crew {
        Crew {
            threads,
            turn: AtomicU64::new(0),
            job: AtomicPtr::new(std::ptr::null_mut()),
            left: AtomicUsize::new(0),
            busy: AtomicBool::new(false),
            led: AtomicBool::new(false),
            over: AtomicBool::new(false),
            thrown: Mutex::new(None),
        }
    }

    pub(super) fn threads(&self) -> usize {
        self.threads
    }

    /// Does a piece of work while the other threads stand by. What it returns, and what `after` says at the end of
    /// each of them; none where they are led already.
    pub(super) fn lead<T, S: Send>(
        &self,
        work: impl FnOnce() -> T,
        after: impl Fn() -> S + Sync,
    ) -> (T, Vec<S>) {
        if self.led.swap(true, Acquire) {
            return (work(), Vec::new());
        }
        self.over.store(false, Relaxed);
        let (done, told) = std::thread::scope(|scope| {
            let help = || {
                self.stand_by();
                after()
            };
            let start = |number: usize| {
                let named = std::thread::Builder::new().name(format!("team-{number}"));
                // Where the system starts no more threads, there are fewer.
                named.stack_size(8 << 20).spawn_scoped(scope, help).ok()
            };
            let helpers: Vec<_> = (1..self.threads).filter_map(start).collect();
            let done = catch_unwind(AssertUnwindSafe(work));
            self.over.store(true, Release);
            let told = helpers.into_iter().filter_map(|helper| helper.join().ok());
            (done, told.collect())
        });
        self.led.store(false, Release);
        (done.unwrap_or_else(|thrown| resume_unwind(thrown)), told)
    }

    /// Does all pieces of a job, with all threads that stand by.
    pub(super) fn share(&self, pieces: usize, job: Job<'_>) {
        assert!(pieces <= MOST, "so many pieces are not told apart");
        if !self.led.load(Relaxed) || self.busy.swap(true, Acquire) {
            return (0..pieces).for_each(job);
        }
        let place: *const Job<'_> = &job;
        self.left.store(pieces, Relaxed);
        self.job.store(place.cast_mut().cast(), Relaxed);
        let number = (self.turn.load(Relaxed) >> 32).wrapping_add(1);
        self.turn.store((number << 32) | ((pieces as u64) << 16), Release);
        while self.take() {}
        let mut looks = 0;
        while self.left.load(Acquire) != 0 {
            wait(&mut looks);
        }
        let thrown = self.thrown.lock().unwrap_or_else(PoisonError::into_inner).take();
        self.busy.store(false, Release);
        if let Some(thrown) = thrown {
            resume_unwind(thrown);
        }
    }

    /// Takes a piece of the job and does it; false where none is left to take.
    fn take(&self) -> bool {
        let turn = self.turn.load(Acquire);
        let (pieces, piece) = ((turn >> 16) & 0xffff, turn & 0xffff);
        if piece >= pieces {
            return false;
        }
        let job = self.job.load(Acquire);
        if self.turn.compare_exchange(turn, turn + 1, AcqRel, Relaxed).is_err() {
            return true; // Another was faster: there may be more.
        }
        // SAFETY: the piece is this thread's, and whoever has posted the job stays in `share`, where the place of
        // the job is, until all pieces are done. That it is the place of this very job is told by the turn, which
        // no other job has had: it was the same before the place was read and after.
        let job: Job<'_> = unsafe { *job };
        if let Err(thrown) = catch_unwind(AssertUnwindSafe(|| job(piece as usize))) {
            *self.thrown.lock().unwrap_or_else(PoisonError::into_inner) = Some(thrown);
        }
        self.left.fetch_sub(1, Release);
        true
    }

    /// Looks for pieces until the work is over.
    fn stand_by(&self) {
        let mut looks = 0;
        while !self.over.load(Acquire) {
            if self.take() {
                looks = 0;
            } else if looks < LOOKS * WAYS {
                wait(&mut looks);
            } else {
                std::thread::sleep(NAP);
            }
        }
    }
}

/// A short wait; now and then other programs may have the processor.
fn wait(looks: &mut u32) {
    *looks += 1;
    if looks.is_multiple_of(LOOKS) {
        std::thread::yield_now();
    } else {
        std::hint::spin_loop();
    }
}
