//! Progress of a sweep: a bar on a terminal, plain lines elsewhere.

use std::io::Write;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle as BarStyle};

use crate::math::words::counted;

/// How progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressStyle {
    /// No progress.
    Quiet,
    /// A bar with the time to go.
    Bar,
    /// A line from time to time.
    Lines,
}

/// At most one line in this time.
const LINE_EVERY: Duration = Duration::from_secs(2);
/// And only after this share more of the work.
const LINE_SHARE: f64 = 0.05;
/// Places of a bar.
const LENGTH: u64 = 1_000_000;

/// Shows progress on standard error.
#[derive(Debug)]
pub struct Progress {
    style: ProgressStyle,
    bar: Option<ProgressBar>,
    start: Instant,
    last_line: Instant,
    last_share: f64,
    /// Particle-steps done, the largest value so far.
    done: f64,
    /// Particle-steps left.
    left: f64,
    /// The share that is shown as left.
    share_left: f64,
    cases: Tally,
    companions: Tally,
    failed: usize,
}

/// Number done and number of all, from the start of the sweep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// All there are.
    pub all: usize,
    /// Done so far.
    pub done: usize,
}

impl Progress {
    /// Progress of cases and companions, some of which may be done.
    pub fn new(style: ProgressStyle, [cases, companions]: [Tally; 2]) -> Progress {
        let bar = (style == ProgressStyle::Bar).then(bar);
        let now = Instant::now();
        Progress {
            style,
            bar,
            start: now,
            last_line: now,
            last_share: 0.0,
            done: 0.0,
            left: 0.0,
            share_left: 1.0,
            cases,
            companions,
            failed: 0,
        }
    }

    /// A case is done.
    pub fn case(&mut self, ok: bool) {
        self.cases.done += 1;
        self.failed += usize::from(!ok);
    }

    /// A companion is done.
    pub fn companion(&mut self) {
        self.companions.done += 1;
    }

    /// Sets the particle-steps that are done and left. Their number is an estimate that changes on
    /// the way. The bar never goes back: from its present place it goes to its end as the work
    /// does.
    pub fn reached(&mut self, [done, left]: [f64; 2]) {
        let more = done - self.done;
        if more > 0.0 {
            self.share_left *= left / (left + more);
            self.done = done;
        }
        self.left = left;
        self.show();
    }

    /// The numbers: `12 of 300 cases, 5 of 300 companions, 1 failed`.
    fn message(&self) -> String {
        let mut message = format!("{} of {}", self.cases.done, counted(self.cases.all, "case"));
        if self.companions.all > 0 {
            let companions = counted(self.companions.all, "companion");
            message += &format!(", {} of {companions}", self.companions.done);
        }
        if self.failed > 0 {
            message += &format!(", {} failed", self.failed);
        }
        message
    }

    fn show(&mut self) {
        let share = 1.0 - self.share_left;
        if let Some(bar) = &self.bar {
            bar.set_message(self.message());
            bar.set_position((share * LENGTH as f64) as u64);
            return;
        }
        let due = self.last_line.elapsed() >= LINE_EVERY && share - self.last_share >= LINE_SHARE;
        if self.style == ProgressStyle::Lines && due {
            self.last_line = Instant::now();
            self.last_share = share;
            let left = duration(self.start.elapsed().as_secs_f64() * self.left / self.done);
            let line = format!("{:3.0} %  {}, {left} to go", 100.0 * share, self.message());
            // If progress cannot be written, the sweep must still go on.
            let _ = writeln!(std::io::stderr(), "{line}");
        }
    }
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(LENGTH);
    let template = "{bar:20} {percent:>3} %  {msg}  to go: {eta}";
    if let Ok(look) = BarStyle::with_template(template) {
        bar.set_style(look);
    }
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

impl Drop for Progress {
    /// Leaves the terminal as it was.
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// A time for people: `42 s`, `3 min 20 s`, `2 h 05 min`, `3.5 days`, `12 years`.
pub fn duration(seconds: f64) -> String {
    const DAY: u64 = 24 * 3600;
    const YEAR: u64 = 365 * DAY;
    let whole = seconds.max(0.0).round() as u64;
    match whole {
        0..60 => format!("{whole} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        3600..172_800 => format!("{} h {:02} min", whole / 3600, whole / 60 % 60),
        172_800..63_072_000 => format!("{:.1} days", seconds / DAY as f64),
        _ => format!("{:.0} years", seconds / YEAR as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bar once stood at its end while more than half of the work was left.
    #[test]
    fn what_is_shown_goes_on_as_the_work_does_when_there_is_more_than_was_thought() {
        let mut progress = Progress::new(ProgressStyle::Quiet, Default::default());
        let mut shown = |done: f64, left: f64| {
            progress.reached([done, left]);
            (1e9 * (1.0 - progress.share_left)).round() / 1e9
        };
        assert_eq!([shown(250.0, 750.0), shown(500.0, 500.0)], [0.25, 0.5]);
        assert_eq!(shown(500.0, 1000.0), 0.5);
        assert_eq!(shown(400.0, 1100.0), 0.5);
        assert_eq!([shown(1000.0, 500.0), shown(1250.0, 250.0)], [0.75, 0.875]);
        assert_eq!(shown(1500.0, 0.0), 1.0);
    }
}
