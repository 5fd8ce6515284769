//! Threads that work on one case together.
//!
//! Work is cut into parts. Each part is written by one thread and read by all. Sums over parts are
//! taken afterwards in a fixed order. So the answer depends neither on the number of threads nor on
//! their timing.

mod growing;
mod rows;
mod standby;

use std::cell::Cell;
use std::ops::Range;
use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};

pub use growing::Growing;
pub use rows::{First, Rows};

/// Parts for each thread. A late thread leaves the rest of its parts to the others.
const PARTS_PER_THREAD: usize = 4;

/// The threads of a case. By default there are none, and the calling thread does all the work.
#[derive(Debug, Clone, Default)]
pub struct Team(Option<Arc<ThreadPool>>);

impl Team {
    /// A team of this many threads; none for a single one, or if the system starts no more.
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

    /// The best number of parts for the work: one if nobody shares it.
    pub fn parts(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| PARTS_PER_THREAD * pool.current_num_threads())
    }

    /// Does some work on one of the threads while the others are ready. The calling thread only
    /// waits.
    pub fn lead<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let Some(pool) = &self.0 else { return work() };
        // From a new thread: a thread of another pool would start other work of that pool.
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

    /// Does the work on the rows of every part, and only reads the parts.
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

/// Does the work on parts, on several at once if `shared`.
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

/// Cuts this many items into ranges that are as even as possible.
pub fn cut(items: usize, parts: usize) -> impl Iterator<Item = Range<usize>> {
    (0..parts).map(move |k| k * items / parts..(k + 1) * items / parts)
}

thread_local! {
    /// Processor time of the teams that worked for this thread, seconds.
    static LED: Cell<f64> = const { Cell::new(0.0) };
}

/// Processor time of the calling thread so far, and of the teams whose work it has waited for,
/// seconds. `None` if the system does not provide it.
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

/// Other systems are not asked.
#[cfg(not(target_os = "linux"))]
fn own_processor_time() -> Option<f64> {
    None
}

/// A part of the work.
pub trait Part: Send {
    /// The range of its items. The next part's items follow.
    fn items(&self) -> Range<usize>;
}

/// A part without other data.
impl Part for Range<usize> {
    fn items(&self) -> Range<usize> {
        self.clone()
    }
}

/// Consecutive parts, for writing or for reading.
trait Parts: Send + Sized {
    /// One of them.
    type One;
    /// Number of parts.
    fn count(&self) -> usize;
    /// Number of their items.
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

/// Number of items of consecutive parts.
fn items<P: Part>(parts: &[P]) -> usize {
    let ends = parts.first().zip(parts.last());
    ends.map_or(0, |(first, last)| last.items().end - first.items().start)
}

#[cfg(test)]
mod tests;
