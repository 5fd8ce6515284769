//! Threads that work on one case together.
//!
//! What they share is cut into parts that are written by one thread each and read by all; sums over
//! parts are taken afterwards in a fixed order, so that the answer does not depend on how many
//! threads there are, nor on which of them is the first.

mod crew;
mod growing;
mod rows;

use std::cell::Cell;
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use crew::{Crew, MOST};
pub use growing::Growing;
pub use rows::{First, Rows};

/// Parts for each thread: one that is late leaves the rest of its parts to the others.
const PARTS_PER_THREAD: usize = 4;

/// A case's own threads; none by default, then all is done by whoever asks.
#[derive(Debug, Clone, Default)]
pub struct Team(Option<Arc<Crew>>);

impl Team {
    /// So many threads; none for a single one.
    pub fn of(threads: usize) -> Team {
        Team((threads > 1).then(|| Arc::new(Crew::new(threads))))
    }

    /// Into how many parts the work is best cut: one where there is nobody to share it.
    pub fn parts(&self) -> usize {
        self.0.as_ref().map_or(1, |crew| PARTS_PER_THREAD * crew.threads())
    }

    /// Does a piece of work while the other threads are at hand.
    pub fn lead<T>(&self, work: impl FnOnce() -> T) -> T {
        let Some(crew) = &self.0 else { return work() };
        let (done, spent) = crew.lead(work, own_processor_time);
        LED.set(LED.get() + spent.into_iter().flatten().sum::<f64>());
        done
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
        let Some(crew) = self.0.as_ref().filter(|_| parts.count() > 1) else {
            return divide(parts, rows, work);
        };
        let pieces = [const { Mutex::new(None) }; MOST];
        let mut count = 0;
        pieces_of(parts, rows, MOST, &mut |parts, rows| {
            *pieces[count].lock().unwrap_or_else(PoisonError::into_inner) = Some((parts, rows));
            count += 1;
        });
        crew.share(count, &|piece| {
            let taken = pieces[piece].lock().unwrap_or_else(PoisonError::into_inner).take();
            let (parts, rows) = taken.expect("each piece is taken once");
            divide(parts, rows, work);
        });
    }
}

/// Cuts parts, with their rows, into at most so many pieces: halves of halves, as far as single parts.
fn pieces_of<S: Parts, R: Rows>(parts: S, rows: R, most: usize, take: &mut impl FnMut(S, R)) {
    if most == 1 || parts.count() <= 1 {
        return take(parts, rows);
    }
    let ([left, right], [rows_left, rows_right]) = halves(parts, rows);
    pieces_of(left, rows_left, most / 2, take);
    pieces_of(right, rows_right, most / 2, take);
}

/// Does the work on parts, one after the other.
fn divide<S: Parts, R: Rows>(parts: S, rows: R, work: &impl Fn(S::One, R)) {
    match parts.count() {
        0 => {}
        1 => work(parts.one(), rows),
        _ => {
            let ([left, right], [rows_left, rows_right]) = halves(parts, rows);
            divide(left, rows_left, work);
            divide(right, rows_right, work);
        }
    }
}

fn halves<S: Parts, R: Rows>(parts: S, rows: R) -> ([S; 2], [R; 2]) {
    let items = parts.items();
    let (left, right) = parts.halves();
    let (rows_left, rows_right) = rows.split(left.items(), items);
    ([left, right], [rows_left, rows_right])
}

/// So many items in so many ranges as even as can be.
pub fn cut(items: usize, parts: usize) -> impl Iterator<Item = Range<usize>> {
    (0..parts).map(move |k| k * items / parts..(k + 1) * items / parts)
}

thread_local! {
    /// Processor time of the threads that stood by while this one led, seconds.
    static LED: Cell<f64> = const { Cell::new(0.0) };
}

/// Processor time of the calling thread so far, and of the threads that stood by while it led, seconds; `None` where the system does not tell.
pub fn thread_processor_time() -> Option<f64> {
    own_processor_time().map(|own| own + LED.get())
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
