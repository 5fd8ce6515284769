//! The speed of a sweep, seen from outside: from one look at its files to the next.

use std::time::Instant;

use crate::math::words::counted;

/// The numbers of a look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct View {
    /// Finished cases and companions.
    pub(super) done: usize,
    /// Those that are left.
    pub(super) left: usize,
    /// Seconds that finished cases have taken.
    pub(super) spent_s: f64,
    /// The time that its ranks have been busy in this session, with their current work, seconds.
    pub(super) busy_s: Option<f64>,
    /// Ranks of the last session.
    pub(super) ranks: usize,
    /// How many cases the ranks run at once.
    pub(super) places: usize,
}

/// A sweep that is looked at again and again.
pub(super) struct Watch {
    first: View,
    since: Instant,
    /// The first look that found no case left, and its time since the first of all, seconds.
    last: Option<(View, f64)>,
}

impl Watch {
    pub(super) fn begin(first: View) -> Watch {
        Watch { first, since: Instant::now(), last: None }
    }

    /// A look's text, with the rate since the first look, if there is one. While films and page are
    /// made it stays what it was at the last case.
    pub(super) fn with_rate(&mut self, text: &str, now: View) -> String {
        let seconds = self.since.elapsed().as_secs_f64();
        self.with_rate_at(text, now, seconds)
    }

    fn with_rate_at(&mut self, text: &str, now: View, seconds: f64) -> String {
        let seen = match self.last {
            Some(last) if now.left == 0 => last,
            _ => (now, seconds),
        };
        self.last = (now.left == 0).then_some(seen);
        let line = rate(self.first, seen.0, seen.1);
        line.map_or_else(|| text.to_owned(), |line| format!("{text}{line}\n"))
    }
}

/// Cases per hour, the ranks, and the idle share of their places; `None` before a case has ended.
/// If the ranks' load is unknown, only finished cases count.
fn rate(first: View, now: View, seconds: f64) -> Option<String> {
    let done = now.done.checked_sub(first.done).filter(|&done| done > 0)?;
    let per_hour = done as f64 / seconds * 3600.0;
    let own = now.busy_s.zip(first.busy_s).map(|(now, first)| now - first);
    let busy = own.filter(|busy| *busy >= 0.0).unwrap_or(now.spent_s - first.spent_s);
    let busy = busy / (seconds * now.places.max(1) as f64);
    let idle = 100.0 * (1.0 - busy).clamp(0.0, 1.0);
    let (ranks, done) = (counted(now.ranks, "rank"), counted(done, "case"));
    Some(format!("{done} in {seconds:.0} s: {per_hour:.0} per hour on {ranks}, {idle:.0} % idle"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_needs_two_looks() {
        let first = View { done: 3, left: 20, spent_s: 10.0, busy_s: None, ranks: 2, places: 4 };
        assert_eq!(rate(first, first, 5.0), None);
        let now = View { done: 13, spent_s: 40.0, ..first };
        let told = rate(first, now, 10.0).unwrap();
        assert_eq!(told, "10 cases in 10 s: 3600 per hour on 2 ranks, 25 % idle");
        // The ranks' current work counts if they report it.
        let [first, now] =
            [(first, 20.0), (now, 58.0)].map(|(view, busy)| View { busy_s: Some(busy), ..view });
        assert!(rate(first, now, 10.0).unwrap().ends_with("on 2 ranks, 5 % idle"));
    }

    /// The story: while films were made, the rate fell and all ranks were called idle.
    #[test]
    fn the_rate_stays_once_all_cases_are_done() {
        let first = View { done: 3, left: 10, spent_s: 10.0, busy_s: None, ranks: 2, places: 4 };
        let mut watch = Watch::begin(first);
        let now = View { done: 13, left: 0, spent_s: 40.0, ..first };
        let told = "done\n10 cases in 10 s: 3600 per hour on 2 ranks, 25 % idle\n";
        for seconds in [10.0, 60.0] {
            assert_eq!(watch.with_rate_at("done\n", now, seconds), told);
        }
        // A study may get more cases.
        let more = watch.with_rate_at("", View { left: 2, ..now }, 100.0);
        assert!(more.starts_with("10 cases in 100 s"), "{more}");
    }
}
