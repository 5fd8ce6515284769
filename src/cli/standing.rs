//! The progress of a study, from the files of its directory.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use serde_json::{Value, json};

use super::failed_cases::FailedCases;
use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::duration;
use super::stored;
use super::watch::View;
use crate::disk::names::JOURNAL;
use crate::math::words::counted;
use crate::results::{
    Closing, Derived, Fared, Header, Load, Lock, Manifest, RankInfo, header_of,
    read_journal_in_blocks,
};

/// What the journal says.
struct Known {
    header: Option<Header>,
    /// How many cases there are, if points were added.
    added: Option<usize>,
    /// The last line of each run, by place.
    latest: BTreeMap<usize, Fared>,
}

impl Known {
    /// Reads no more than the journal's first line.
    fn of_header(directory: &Path) -> anyhow::Result<Known> {
        let header = header_of(directory)?;
        Ok(Known { header, added: None, latest: BTreeMap::new() })
    }

    /// Reads the whole journal.
    fn of_journal(directory: &Path) -> anyhow::Result<Known> {
        let (mut added, mut places) = (None, None);
        if let Ok(Some(study)) = stored::in_rounds(directory) {
            // Added points have moved the others' places. Finer numerics have their own ids.
            added = Some(study.cases.len());
            let index = study.runs().map(|case| (case.id, case.index));
            places = Some(index.collect::<HashMap<_, _>>());
        }
        let place = |fared: Fared| match &places {
            Some(places) => Some((*places.get(&fared.id)?, fared)),
            None => Some((fared.index, fared)),
        };
        let mut latest = BTreeMap::new();
        let content = read_journal_in_blocks(directory, |block: Vec<Fared>| {
            latest.extend(block.into_iter().map(Fared::trimmed).filter_map(place));
        })?;
        Ok(Known { header: content.header, added, latest })
    }
}

/// What is done, what has failed and what is left.
pub(super) struct Standing {
    header: Header,
    /// The cases of the file, and added points.
    cases: usize,
    done: usize,
    pub(super) failed: usize,
    companions: usize,
    companions_done: usize,
    /// Whether films and page are still to be made.
    owed: bool,
    /// Whether a report ended before it had made page, figures and tables.
    cut: bool,
    pub(super) running: bool,
    to_go_s: Option<f64>,
    failures: Vec<FailedCases>,
    /// The load of the last session's ranks.
    load: Option<Load>,
    ranks: usize,
    /// How many cases the ranks run at once.
    places: usize,
    /// The time that finished cases have taken, seconds.
    spent_s: f64,
}

impl Standing {
    /// The progress of a directory's study.
    pub(super) fn of(directory: &Path) -> anyhow::Result<Standing> {
        demand_output_of_study(directory, JOURNAL)?;
        let manifest = Manifest::read(directory);
        let companions = manifest.as_ref().map_or(0, |manifest| manifest.companions);
        // For a closed study without failures there is nothing more to report.
        let closed = Closing::read(directory).is_some_and(|closing| closing.failed == 0);
        let known =
            if closed { Known::of_header(directory)? } else { Known::of_journal(directory)? };
        let Known { header, added, mut latest } = known;
        let is_lost = header.is_none() && !latest.is_empty();
        let header = if is_lost { header_of(directory)? } else { header };
        let Some(header) = header else {
            let reason =
                "the sweep was stopped before it began, or the journal's first line is lost";
            return Err(BadInput::of(directory, reason).into());
        };
        let cases = added.unwrap_or(header.cases);
        // Places after the cases are those of companions.
        let companions_done = latest.split_off(&cases).len().min(companions);
        let records: Vec<_> = latest.into_values().collect();
        let failed: Vec<_> = records.iter().filter(|record| record.failure.is_some()).collect();
        let (done, companions_done) =
            if closed { (cases, companions) } else { (records.len(), companions_done) };
        let session = manifest.as_ref().and_then(|manifest| manifest.sessions.last());
        let ranks = session.map_or(&[][..], |session| &session.ranks);
        let places = ranks.iter().map(RankInfo::places).sum();
        let running = Lock::is_held(directory);
        let load = Load::read(directory).filter(|_| running);
        let spent_s = records.iter().map(|record| record.wall_time_s).sum();
        let of_session = |_| if closed { Some(0.0) } else { time_to_go(&records, cases, places) };
        Ok(Standing {
            cases,
            done,
            failed: failed.len(),
            companions,
            companions_done,
            owed: Derived::is_owed(directory),
            cut: Derived::is_cut(directory),
            running,
            to_go_s: session.and_then(of_session),
            failures: FailedCases::of(&failed),
            load: load.or_else(|| session.and_then(|session| session.load.clone())),
            ranks: ranks.len(),
            places,
            spent_s,
            header,
        })
    }

    fn left(&self) -> usize {
        self.cases.saturating_sub(self.done)
    }

    fn companions_left(&self) -> usize {
        self.companions - self.companions_done
    }

    /// Whether nothing is left, neither companions nor films and page.
    pub(super) fn is_whole(&self) -> bool {
        self.left() + self.companions_left() == 0 && !self.owed && !self.cut
    }

    /// The words for people.
    pub(super) fn text(&self) -> String {
        let state = match self.left() + self.companions_left() {
            0 if self.running => "running: all cases done, makes films and page",
            _ if self.running => "running",
            0 if self.owed => "stopped after its cases; the same command makes films and page",
            0 if self.cut => "finished but for its page; `seawall report` makes it again",
            0 => "finished",
            _ => "stopped; the same command goes on",
        };
        let mut text = format!(
            "{}: {state}\n{} of {} done, {} failed, {} left",
            self.header.name,
            self.done,
            counted(self.cases, "case"),
            self.failed,
            self.left()
        );
        if let Some(seconds) = self.to_go_s.filter(|_| self.left() > 0) {
            text.push_str(&format!(", about {} to go", duration(seconds)));
        }
        if self.companions > 0 {
            let companions = counted(self.companions, "companion");
            text.push_str(&format!(
                "\n{} of {companions} for error bars done",
                self.companions_done
            ));
        }
        text.push('\n');
        text.extend(self.failures.iter().map(FailedCases::text));
        let load = self.load.as_ref().and_then(Load::in_words);
        text.extend(load.map(|told| format!("{told}\n")));
        text
    }

    /// The same for programs.
    pub(super) fn json(&self) -> Value {
        let rank =
            |load: &Load, rank: usize| json!({ "busy_share": load.share(rank), "rank": rank });
        let load = self.load.as_ref().map(|load| {
            json!({
                "busy_share": load.whole_share(),
                "ranks": (0..load.ranks.len()).map(|number| rank(load, number)).collect::<Vec<_>>(),
            })
        });
        json!({
            "name": self.header.name,
            "cases": self.cases,
            "done": self.done,
            "ok": self.done - self.failed,
            "failed": self.failed,
            "left": self.left(),
            "companions": self.companions,
            "companions_left": self.companions_left(),
            "films_and_page_left": self.owed || self.cut,
            "running": self.running,
            "time_to_go_s": self.to_go_s,
            "simd": self.header.simd,
            "failures": self.failures,
            "load": load,
        })
    }

    /// The numbers for someone who looks again and again.
    pub(super) fn view(&self) -> View {
        View {
            busy_s: self.load.as_ref().map(Load::busy_s),
            done: self.done + self.companions_done,
            left: self.left() + self.companions_left(),
            spent_s: self.spent_s,
            ranks: self.ranks,
            places: self.places,
        }
    }
}

/// The mean time of a finished case, times those left, over the places of the last session.
fn time_to_go(records: &[Fared], cases: usize, places: usize) -> Option<f64> {
    let spent: f64 = records.iter().map(|record| record.wall_time_s).sum();
    let mean = spent / (!records.is_empty()).then_some(records.len())? as f64;
    Some(mean * cases.saturating_sub(records.len()) as f64 / places.max(1) as f64)
}
