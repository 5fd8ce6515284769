//! Telling how far a sweep is: a bar on a terminal, plain lines elsewhere.

use std::io::Write;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle as BarStyle};

use crate::math::words::counted;

/// How progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressStyle {
    /// Not at all.
    Quiet,
    /// A bar with the time to go.
    Bar,
    /// A line now and then.
    Lines,
}

/// At most one line in this time.
const LINE_EVERY: Duration = Duration::from_secs(2);
/// And only after so much more of the work.
const LINE_SHARE: f64 = 0.05;

/// Shows progress on standard error.
#[derive(Debug)]
pub struct Progress {
    style: ProgressStyle,
    bar: Option<ProgressBar>,
    start: Instant,
    last_line: Instant,
    last_share: f64,
    total_work: u64,
    work: u64,
    /// Of the pieces that are being worked on.
    under_way: u64,
    cases: Tally,
    companions: Tally,
    failed: usize,
}

/// How many of how many are done, from the start of the sweep on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// All there are.
    pub all: usize,
    /// Done so far.
    pub done: usize,
}

impl Progress {
    /// Progress of cases and companions of which some are done, towards so much work.
    pub fn new(style: ProgressStyle, [cases, companions]: [Tally; 2], total_work: u64) -> Progress {
        let bar = (style == ProgressStyle::Bar).then(|| bar(total_work));
        let now = Instant::now();
        Progress {
            style,
            bar,
            start: now,
            last_line: now,
            last_share: 0.0,
            total_work,
            work: 0,
            under_way: 0,
            cases,
            companions,
            failed: 0,
        }
    }

    /// A shared stretch is done.
    pub fn trunk(&mut self, work: u64) {
        self.advance(work);
    }

    /// A case is done.
    pub fn case(&mut self, work: u64, ok: bool) {
        self.cases.done += 1;
        self.failed += usize::from(!ok);
        self.advance(work);
    }

    /// A companion is done.
    pub fn companion(&mut self, work: u64) {
        self.companions.done += 1;
        self.advance(work);
    }

    /// So much of the work is done in pieces that are being worked on.
    pub fn under_way(&mut self, work: u64) {
        self.under_way = work;
        self.show();
    }

    fn advance(&mut self, work: u64) {
        self.work = self.work.saturating_add(work);
        self.show();
    }

    /// Where it is: `12 of 300 cases, 5 of 300 companions, 1 failed`.
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
        let work = self.work.saturating_add(self.under_way).min(self.total_work);
        if let Some(bar) = &self.bar {
            bar.set_message(self.message());
            // It never goes back, though what is under way is an estimate.
            bar.set_position(work.max(bar.position()));
            return;
        }
        let share = work as f64 / self.total_work.max(1) as f64;
        let due = self.last_line.elapsed() >= LINE_EVERY && share - self.last_share >= LINE_SHARE;
        if self.style == ProgressStyle::Lines && due {
            self.last_line = Instant::now();
            self.last_share = share;
            let spent = self.start.elapsed().as_secs_f64();
            let left = duration(spent * (1.0 - share).max(0.0) / share);
            let line = format!("{:3.0} %  {}, {left} to go", 100.0 * share, self.message());
            // Progress that nobody reads must not end a sweep.
            let _ = writeln!(std::io::stderr(), "{line}");
        }
    }
}

fn bar(total_work: u64) -> ProgressBar {
    let bar = ProgressBar::new(total_work.max(1));
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

/// Seconds for the human eye: `42 s`, `3 min 20 s`, `2 h 05 min`, `3.5 days`, `12 years`.
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
