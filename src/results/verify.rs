//! Checks whether the contents of a directory are unchanged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::derived::{CUT, Derived};
use super::ended::{EndedLine, Line};
use super::entries::{Condition, Content};
use super::error::SweepError;
use super::filling::{self, Damaged, Filling};
use super::lock::Lock;
use super::manifest::Manifest;
use super::record::{CaseRecord, HeldLine};
use super::tables::{Fit, Table};
use super::{checkpoints, derived, files, journal, opening};
use crate::disk::names::PAGE;
use crate::keys::named;
use crate::study::Study;

/// The result of a check.
#[derive(Debug)]
pub struct Verified {
    /// Everything that has changed, in words.
    pub told: Vec<String>,
    /// Tables that are no longer or not yet those of the journal, because a sweep is at work or was
    /// killed, in words.
    pub older: Vec<String>,
    /// Files of cases that are damaged or missing.
    pub damaged: Vec<PathBuf>,
    /// Number of finished cases. Without the study: of those that have files.
    pub cases: usize,
    /// The finished cases and companions, as in [`super::finished`]. Empty without the study.
    pub records: Vec<Option<CaseRecord>>,
}

/// Checks everything in a directory. Without the study that is every file with a checksum: the
/// tables that are made from the journal have none.
pub fn verify(directory: &Path, study: Option<&Study>) -> Result<Verified, SweepError> {
    let mut running = Lock::is_held(directory);
    let (mut told, damage, cases, records) = match study {
        Some(study) => of_study(directory, study, running)?,
        None => of_files(directory, running)?,
    };
    told.extend(damage.iter().map(filling::in_words));
    told.extend(of_checkpoints(directory));
    let mut older = Vec::new();
    if let Some(study) = study {
        for table in Table::ALL {
            let fit = table.fit(directory, study, &records)?;
            running = running || Lock::is_held(directory);
            match fit {
                Fit::Right => {}
                Fit::Wrong(what) if !running => told.push(format!("{} {what}", table.name())),
                Fit::Older | Fit::Wrong(_) => older.push(format!("{} {OLDER}", table.name())),
            }
        }
    }
    told.extend(of_the_rest(directory));
    // A sweep that died after its last case has made no page of it.
    let early = !older.is_empty() || !directory.join(PAGE).exists();
    let is_whole = study.is_some() && records.iter().all(Option::is_some);
    let is_owed = !running && is_whole && Derived::is_owed(directory);
    if is_owed && early && !told.iter().any(|line| line == CUT) {
        told.push(CUT.to_owned());
    }
    let damaged = damage.into_iter().map(|(path, _)| path).collect();
    Ok(Verified { told, older, damaged, cases, records })
}

const OLDER: &str =
    "is older than the journal; the next `seawall sweep` or `seawall report` makes it again";

/// The damage of the journal, that of the cases' files, the number of finished cases, and records.
type Known = (Vec<String>, Vec<Damaged>, usize, Vec<Option<CaseRecord>>);

fn of_study(directory: &Path, study: &Study, running: bool) -> Result<Known, SweepError> {
    let mut filling = Filling::<HeldLine>::new(directory, study);
    let content = journal::read_in_blocks(directory, |lines| filling.take(lines))?;
    let (records, damage) = filling.all();
    let cases = records[..study.cases.len()].iter().flatten().count();
    Ok((of_journal(&content, Some(study), running), damage, cases, records))
}

fn of_files(directory: &Path, running: bool) -> Result<Known, SweepError> {
    let mut latest = BTreeMap::new();
    let content = journal::read_in_blocks(directory, |lines: Vec<EndedLine>| {
        latest.extend(lines.into_iter().map(|line| (line.ended().id, line)));
    })?;
    // Failed cases and companions have no files.
    let well = latest.into_iter().filter(|(_, line)| line.ended().is_ok);
    let files: Vec<_> = well.map(|(id, line)| (id, line.split(0).1)).collect();
    let cases = files.iter().filter(|(_, seals)| !seals.is_empty()).count();
    let damage = files.iter().flat_map(|(id, seals)| files::damage(directory, *id, seals));
    Ok((of_journal(&content, None, running), damage.collect(), cases, Vec::new()))
}

/// The damage of a journal. The last line of a running sweep may be on its way.
fn of_journal(content: &Content<impl Sized>, study: Option<&Study>, running: bool) -> Vec<String> {
    let mut told: Vec<String> = opening::told_damage(content, false).into_iter().collect();
    let is_other = |sweep: &String| study.is_some_and(|study| *sweep != study.identity);
    match &content.header {
        Some(header) if is_other(&header.sweep) => {
            told.push(format!("journal.jsonl is of another sweep (\"{}\")", header.name));
        }
        None if told.is_empty() => told.push("journal.jsonl has lost its beginning".to_owned()),
        _ if told.is_empty() && !running && content.condition != Condition::Intact => {
            told.push("journal.jsonl: its last line does not end".to_owned());
        }
        _ => {}
    }
    told
}

fn of_checkpoints(directory: &Path) -> impl Iterator<Item = String> {
    let kept = checkpoints::damaged(directory);
    kept.map(|path| format!("{} is damaged: what it is of starts over", named(&path)))
}

fn of_the_rest(directory: &Path) -> impl Iterator<Item = String> {
    let manifest = Manifest::damage(directory).map(|what| format!("manifest.json {what}"));
    manifest.into_iter().chain(derived::damage(directory))
}

#[cfg(test)]
mod tests {
    use super::super::{SessionInfo, finished, renew_tables, trial};
    use super::*;

    #[test]
    fn a_flipped_bit_is_told_wherever_it_is() {
        let (_root, path, study) = trial::room("0.2, 0.3");
        drop(trial::finished(&path, &study));
        Manifest::new(&path, &study, &[], trial::SIMD).write(&path).unwrap();
        let told = || verify(&path, Some(&study)).unwrap().told;
        assert_eq!(told(), Vec::<String>::new());
        let history = std::fs::read_dir(path.join("histories")).unwrap().next().unwrap().unwrap();
        for (name, case_runs_again) in [
            (history.path(), true),
            (path.join("summary.csv"), false),
            (path.join("energy.csv"), false),
            (path.join("manifest.json"), false),
            (path.join("journal.jsonl"), true),
        ] {
            let before = std::fs::read(&name).unwrap();
            let mut damaged = before.clone();
            let place = damaged.len() * 3 / 4;
            damaged[place] ^= 4;
            std::fs::write(&name, damaged).unwrap();
            let found = told();
            assert!(!found.is_empty(), "{}", name.display());
            // A check repairs nothing.
            assert!(!found[0].contains("set aside"), "{found:?}");
            let directory = trial::open(&path, &study);
            assert_eq!(directory.runs().iter().flatten().count() == 1, case_runs_again);
            assert_eq!(!directory.findings().is_empty(), case_runs_again);
            drop(directory);
            std::fs::write(&name, before).unwrap();
        }
        std::fs::write(path.join("manifest.json"), "").unwrap();
        assert_eq!(told(), ["manifest.json is damaged"]);
        for table in [Table::Summary, Table::Energy] {
            std::fs::write(path.join(table.name()), "x").unwrap();
        }
        let records = finished(&path, &study).unwrap();
        assert_eq!(renew_tables(&path, &study, &records).unwrap(), ["summary.csv", "energy.csv"]);
        assert!(renew_tables(&path, &study, &records).unwrap().is_empty());
        // An extra line is no case that the journal lacks.
        let line_too_many = std::fs::read_to_string(path.join("summary.csv")).unwrap() + "junk\n";
        std::fs::write(path.join("summary.csv"), line_too_many).unwrap();
        assert_eq!(renew_tables(&path, &study, &records).unwrap(), ["summary.csv"]);
        std::fs::write(path.join("journal.jsonl"), "").unwrap();
        assert_eq!(told()[0], "journal.jsonl has lost its beginning");
    }

    /// The story: while a sweep ran, and after it was killed, its tables were called damaged.
    #[test]
    fn tables_of_an_earlier_state_are_older_and_no_damage() {
        let (_root, path, study) = trial::room("0.2, 0.3, 0.4");
        drop(trial::finished(&path, &study));
        let mut manifest = Manifest::new(&path, &study, &[], trial::SIMD);
        manifest.sessions.push(SessionInfo::default());
        manifest.write(&path).unwrap();
        let count = || {
            let Verified { told, older, .. } = verify(&path, Some(&study)).unwrap();
            [told.len(), older.len()]
        };
        assert_eq!(count(), [0, 0]);
        for name in ["summary.csv", "energy.csv"] {
            let text = std::fs::read_to_string(path.join(name)).unwrap();
            let lines: Vec<_> = text.lines().collect();
            std::fs::write(path.join(name), format!("{}\n{}\n", lines[0], lines[2])).unwrap();
        }
        assert_eq!(count(), [0, 2], "it was killed");
        manifest.sessions[0].ended = Some(String::new());
        manifest.write(&path).unwrap();
        assert_eq!(count(), [2, 0], "it came to its end");
        let lock = Lock::hold(&path).unwrap();
        assert_eq!(count(), [0, 2], "it runs");
        drop(lock);
        manifest.sessions[0].ended = None;
        manifest.write(&path).unwrap();
        std::fs::write(path.join("summary.csv"), "case_id\nx\n").unwrap();
        assert_eq!(count(), [1, 1], "no earlier state");
        std::fs::remove_file(path.join("summary.csv")).unwrap();
        assert_eq!(count(), [0, 2]);
    }

    #[test]
    fn files_are_checked_without_the_study() {
        let (_root, path, study) = trial::room("0.2, 0.3");
        drop(trial::finished(&path, &study));
        Manifest::new(&path, &study, &[], trial::SIMD).write(&path).unwrap();
        let found = verify(&path, None).unwrap();
        assert_eq!((found.told, found.cases), (Vec::new(), 2));
        let history = files::history_path(&path, study.cases[1].id);
        std::fs::write(&history, "time_s\n").unwrap();
        let found = verify(&path, None).unwrap();
        assert_eq!((found.told.len(), found.damaged), (1, vec![history]));
    }
}
