//! The progress of a study, from the files of its directory.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use serde_json::{Value, json};

use super::failed_cases::FailedCases;
use super::failure::BadInput;
use super::input::demand_output_of_study;
use super::output::duration;
use super::watch::View;
use super::{stored, time_to_go};
use crate::disk::names::JOURNAL;
use crate::math::words::counted;
use crate::results::{
    Closing, Derived, Fared, Header, Load, Lock, Manifest, RankInfo, header_of,
    read_journal_in_blocks,
};
use crate::study::Study;

/// What the journal says.
struct Known {
    header: Option<Header>,
    /// The study with all points that were added, if it can be made again and is not too large.
    study: Option<Study>,
    /// The last line of each run, by place.
    latest: BTreeMap<usize, Fared>,
}

impl Known {
    /// Reads no more than the journal's first line.
    fn of_header(directory: &Path) -> anyhow::Result<Known> {
        let header = header_of(directory)?;
        Ok(Known { header, study: None, latest: BTreeMap::new() })
    }

    /// Reads the whole journal.
    fn of_journal(directory: &Path, manifest: Option<&Manifest>) -> anyhow::Result<Known> {
        let is_small = |manifest: &Manifest| manifest.cases + manifest.companions <= Closing::ABOVE;
        let study = match stored::in_rounds(directory) {
            Ok(Some(study)) => Some(study),
            Ok(None) if manifest.is_some_and(is_small) => {
                stored::file_and_study(directory).ok().map(|(_, study)| study)
            }
            _ => None,
        };
        // Added points have moved the others' places, and other error bars those of companions. Finer numerics have
        // their own ids.
        let index = |study: &Study| study.runs().map(|case| (case.id, case.index)).collect();
        let places: Option<HashMap<_, _>> = study.as_ref().map(index);
        let place = |fared: Fared| match &places {
            Some(places) => Some((*places.get(&fared.id)?, fared)),
            None => Some((fared.index, fared)),
        };
        let mut latest = BTreeMap::new();
        let content = read_journal_in_blocks(directory, |block: Vec<Fared>| {
            latest.extend(block.into_iter().map(Fared::trimmed).filter_map(place));
        })?;
        Ok(Known { header: content.header, study, latest })
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
    /// The time that finished cases and companions have taken, seconds.
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
        let known = match closed {
            true => Known::of_header(directory)?,
            false => Known::of_journal(directory, manifest.as_ref())?,
        };
        let Known { header, study, mut latest } = known;
        let is_lost = header.is_none() && !latest.is_empty();
        let header = if is_lost { header_of(directory)? } else { header };
        let Some(header) = header else {
            let reason =
                "the sweep was stopped before it began, or the journal's first line is lost";
            return Err(BadInput::of(directory, reason).into());
        };
        let cases = study.as_ref().map_or(header.cases, |study| study.cases.len());
        let session = manifest.as_ref().and_then(|manifest| manifest.sessions.last());
        let ranks = session.map_or(&[][..], |session| &session.ranks);
        let places = ranks.iter().map(RankInfo::places).sum();
        // Places after the cases are those of companions.
        let companions_done = latest.range(cases..).count().min(companions);
        let spent_s = time_to_go::spent(&latest);
        let to_go_s = match &study {
            _ if closed => Some(0.0),
            Some(study) => time_to_go::of_study(study, &latest, places),
            None => {
                let cases_left = cases.saturating_sub(latest.range(..cases).count());
                let left = cases_left + companions - companions_done;
                time_to_go::by_number(&latest, left, places)
            }
        };
        latest.split_off(&cases);
        let records: Vec<_> = latest.into_values().collect();
        let failed: Vec<_> = records.iter().filter(|record| record.failure.is_some()).collect();
        let (done, companions_done) =
            if closed { (cases, companions) } else { (records.len(), companions_done) };
        let running = Lock::is_held(directory);
        let load = Load::read(directory).filter(|_| running);
        Ok(Standing {
            cases,
            done,
            failed: failed.len(),
            companions,
            companions_done,
            owed: Derived::is_owed(directory),
            cut: Derived::is_cut(directory),
            running,
            to_go_s: to_go_s.filter(|_| session.is_some()),
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
        if self.companions > 0 {
            let companions = counted(self.companions, "companion");
            text.push_str(&format!(
                "\n{} of {companions} for error bars done",
                self.companions_done
            ));
        }
        if let Some(seconds) = self.to_go_s.filter(|_| self.left() + self.companions_left() > 0) {
            text.push_str(&format!(", about {} to go", duration(seconds)));
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
