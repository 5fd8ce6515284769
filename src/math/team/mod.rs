//! Threads that work on one case together.
//!
//! What they share is cut into parts that are written by one thread each and read by all; sums over
//! parts are taken afterwards in a fixed order, so that the answer does not depend on how many
//! threads there are, nor on which of them is the first.

mod growing;
mod rows;
mod standby;

use std::cell::Cell;
use std::ops::Range;
use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};

pub use growing::Growing;
pub use rows::{First, Rows};

/// Parts for each thread: one that is late leaves the rest of its parts to the others.
const PARTS_PER_THREAD: usize = 4;

/// A case's own threads; none by default, then all is done by whoever asks.
#[derive(Debug, Clone, Default)]
pub struct Team(Option<Arc<ThreadPool>>);

impl Team {
    /// So many threads; none for a single one, nor where the system starts no more of them.
    pub fn of(threads: usize) -> Team {
        if threads <= 1 {
            return Team(None);
        }
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|number| format!("team-{number}"))
            .stack_size(8 << 20)
            .build();
        Team(pool.ok().map(Arc::new))
    }

    /// Into how many parts the work is best cut: one where there is nobody to share it.
    pub fn parts(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| PARTS_PER_THREAD * pool.current_num_threads())
    }

    /// Does a piece of work on one of the threads, where the others are at hand; the calling thread
    /// waits, and does nothing else meanwhile.
    pub fn lead<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let Some(pool) = &self.0 else { return work() };
        // From a thread of its own: a thread of another pool would take up that pool's work.
        let before = processor_time(pool);
        let attended = || pool.install(|| standby::attended(work));
        let done = std::thread::scope(|scope| scope.spawn(attended).join());
        if let (Some(before), Some(after)) = (before, processor_time(pool)) {
            LED.set(LED.get() + after - before);
        }
        done.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }

    /// Does the work on every part and its rows.
    pub fn share<P: Part, R: Rows>(
        &self,
        parts: &mut [P],
        rows: R,
        work: &(impl Fn(&mut P, R) + Sync),
    ) {
        self.divide(parts, rows, work);
    }

    /// Does the work on the rows of every part. It only reads the parts.
    pub fn read<P: Part + Sync, R: Rows>(
        &self,
        parts: &[P],
        rows: R,
        work: &(impl Fn(&P, R) + Sync),
    ) {
        self.divide(parts, rows, work);
    }

    fn divide<S: Parts, R: Rows>(&self, parts: S, rows: R, work: &(impl Fn(S::One, R) + Sync)) {
        match (&self.0, parts.count()) {
            (_, 0) => {}
            (Some(pool), 2..) => pool.install(|| divide(parts, rows, true, work)),
            _ => divide(parts, rows, false, work),
        }
    }
}

/// Does the work on parts, on several at once if they are shared.
fn divide<S: Parts, R: Rows>(parts: S, rows: R, shared: bool, work: &(impl Fn(S::One, R) + Sync)) {
    if parts.count() == 1 {
        return work(parts.one(), rows);
    }
    let items = parts.items();
    let (left, right) = parts.halves();
    let (rows_left, rows_right) = rows.split(left.items(), items);
    let first = || divide(left, rows_left, shared, work);
    let second = || divide(right, rows_right, shared, work);
    if shared {
        standby::join(first, second);
    } else {
        first();
        second();
    }
}

/// So many items in so many ranges as even as can be.
pub fn cut(items: usize, parts: usize) -> impl Iterator<Item = Range<usize>> {
    (0..parts).map(move |k| k * items / parts..(k + 1) * items / parts)
}

thread_local! {
    /// Processor time of the teams that this thread has let work, seconds.
    static LED: Cell<f64> = const { Cell::new(0.0) };
}

/// Processor time of the calling thread so far, and of the teams whose work it has waited for,
/// seconds; `None` where the system does not tell.
pub fn thread_processor_time() -> Option<f64> {
    own_processor_time().map(|own| own + LED.get())
}

fn processor_time(pool: &ThreadPool) -> Option<f64> {
    pool.broadcast(|_| own_processor_time()).into_iter().sum()
}

#[cfg(target_os = "linux")]
fn own_processor_time() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

/// Others are not asked.
#[cfg(not(target_os = "linux"))]
fn own_processor_time() -> Option<f64> {
    None
}

/// A part of the work.
pub trait Part: Send {
    /// Which of all items it has; the next part's follow them.
    fn items(&self) -> Range<usize>;
}

/// A part that is nothing but its items.
impl Part for Range<usize> {
    fn items(&self) -> Range<usize> {
        self.clone()
    }
}

/// Consecutive parts, to be written or to be read.
trait Parts: Send + Sized {
    /// One of them.
    type One;
    /// How many they are.
    fn count(&self) -> usize;
    /// How many items they have.
    fn items(&self) -> usize;
    /// The first half of them, and the others.
    fn halves(self) -> (Self, Self);
    /// The only one.
    fn one(self) -> Self::One;
}

impl<'p, P: Part> Parts for &'p mut [P] {
    type One = &'p mut P;

    fn count(&self) -> usize {
        self.len()
    }
    fn items(&self) -> usize {
        items(self)
    }
    fn halves(self) -> (Self, Self) {
        self.split_at_mut(self.len() / 2)
    }
    fn one(self) -> &'p mut P {
        &mut self[0]
    }
}

impl<'p, P: Part + Sync> Parts for &'p [P] {
    type One = &'p P;

    fn count(&self) -> usize {
        self.len()
    }
    fn items(&self) -> usize {
        items(self)
    }
    fn halves(self) -> (Self, Self) {
        self.split_at(self.len() / 2)
    }
    fn one(self) -> &'p P {
        &self[0]
    }
}

/// How many items consecutive parts have.
fn items<P: Part>(parts: &[P]) -> usize {
    let ends = parts.first().zip(parts.last());
    ends.map_or(0, |(first, last)| last.items().end - first.items().start)
}

#[cfg(test)]
mod tests;
