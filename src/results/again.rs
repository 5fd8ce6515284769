//! Checks whether a case that ran again gave the same results, to the bit.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use csv::StringRecord;

use super::ended::{Ended, EndedLine, Line};
use super::error::SweepError;
use super::filling::{self, Filling};
use super::record::{CaseRecord, HeldLine};
use super::{files, journal, summary};
use crate::disk::names::{JOURNAL, SUMMARY, of_case};
use crate::math::words::{counted, in_words};
use crate::quantities::summary::{CASE_ID, WALL_TIME};
use crate::simulation::CaseResult;
use crate::study::{Case, CaseId, Study};

/// The finished cases and companions of a study in a directory, in the order of [`Study::runs`].
/// They are read from the journal alone, as far as tables and figures need them.
pub fn finished(directory: &Path, study: &Study) -> Result<Vec<Option<CaseRecord>>, SweepError> {
    let mut filling = Filling::<HeldLine>::new(directory, study).blind();
    journal::read_in_blocks(directory, |lines| filling.take(lines))?;
    Ok(filling.all().0)
}

/// The same without those that must run again.
///
/// # Errors
/// The journal no longer has a run that has ended.
pub(super) fn finished_of(
    directory: &Path,
    study: &Study,
    runs: &[Option<Ended>],
) -> Result<Vec<Option<CaseRecord>>, SweepError> {
    let mut records = finished(directory, study)?;
    for (record, run) in records.iter_mut().zip(runs) {
        record.take_if(|_| run.is_none());
        if let (None, Some(run)) = (record, run) {
            let lost = format!("the line of case {} can no longer be read", run.id);
            let again = "give the same command again: the case runs again";
            return Err(SweepError::refused(&directory.join(JOURNAL), format!("{lost}; {again}")));
        }
    }
    Ok(records)
}

/// Those of [`finished`] with all their data in the journal. For a large study this is gigabytes.
pub fn finished_whole(
    directory: &Path,
    study: &Study,
) -> Result<Vec<Option<CaseRecord>>, SweepError> {
    let lines = journal::read_journal(directory)?.records;
    let places: HashMap<_, _> = study.runs().map(|case| (case.id, case.index)).collect();
    let mut records = vec![None; study.run_count()];
    for record in lines {
        if let Some(&index) = places.get(&record.id) {
            records[index] = Some(CaseRecord { index, ..record });
        }
    }
    Ok(records)
}

/// The first difference between a case's new result and its row in `summary.csv`, its energies and
/// its files in a directory, in words. `None` if all except the wall time is the same to the bit.
/// `records` are those of the study, see [`finished`].
pub fn first_difference(
    directory: &Path,
    (study, records): (&Study, &[Option<CaseRecord>]),
    case: &Case,
    result: &CaseResult,
) -> Result<Option<String>, SweepError> {
    let record = CaseRecord::new(study, case, &Ok(result.clone()), 0.0, "");
    let path = directory.join(SUMMARY);
    let wrong = |error: csv::Error| SweepError::io(&path)(error.into());
    let new = summary::row(study, records, case, &record).map_err(wrong)?;
    let id = case.id.to_string();
    let unreadable = |error: std::io::Error| format!("summary.csv: {}", in_words(&error));
    let damaged = |error: csv::Error| match error.is_io_error() {
        true => unreadable(error.into()),
        false => "summary.csv is damaged; `seawall report` makes it again".to_owned(),
    };
    let old = File::open(&path).map_err(unreadable);
    let old = match old.and_then(|old| row_of(BufReader::new(old), &id).map_err(damaged)) {
        Ok(old) => old,
        Err(told) => return Ok(Some(told)),
    };
    let difference = in_rows(old, row_of(&new[..], &id).map_err(wrong)?);
    if difference.is_some() {
        return Ok(difference);
    }
    let energy = records.get(case.index).and_then(|record| record.as_ref()?.energy);
    if energy.is_some_and(|energy| energy != result.energy) {
        return Ok(Some("the journal has other energies".to_owned()));
    }
    for (folder, new) in files::texts(result) {
        let path = of_case(directory, folder, case.id);
        let name = files::name(folder);
        let difference = match std::fs::read(&path) {
            Ok(old) => in_lines(&String::from_utf8_lossy(&old), &new, name),
            Err(error) => Some(format!("the {name} cannot be read: {}", in_words(&error))),
        };
        if difference.is_some() {
            return Ok(difference);
        }
    }
    Ok(None)
}

/// The files of a case that have changed since they were written, by the journal's checksums, in
/// words.
///
/// # Errors
/// The journal cannot be read.
pub fn damaged_files(directory: &Path, id: CaseId) -> Result<Vec<String>, SweepError> {
    let mut damage = Vec::new();
    journal::read_in_blocks(directory, |lines: Vec<EndedLine>| {
        for line in lines.into_iter().filter(|line| line.ended().id == id) {
            damage = files::damage(directory, id, &line.split(0).1);
        }
    })?;
    Ok(damage.iter().map(filling::in_words).collect())
}

/// Column names and cells of a case.
fn row_of(table: impl Read, id: &str) -> csv::Result<(StringRecord, Option<StringRecord>)> {
    let mut reader = csv::Reader::from_reader(table);
    let header = reader.headers()?.clone();
    let place = header.iter().position(|name| name == CASE_ID.name).unwrap_or(0);
    let is_its = |row: &csv::Result<StringRecord>| {
        row.as_ref().map_or(true, |row| row.get(place) == Some(id))
    };
    Ok((header, reader.records().find(is_its).transpose()?))
}

fn in_rows(
    (old_header, old): (StringRecord, Option<StringRecord>),
    (new_header, new): (StringRecord, Option<StringRecord>),
) -> Option<String> {
    let (Some(old), Some(new)) = (old, new) else {
        return Some("summary.csv has no row of this case".to_owned());
    };
    if old_header != new_header {
        return Some("summary.csv has other columns than this program writes".to_owned());
    }
    let cells = old_header.iter().zip(old.iter().zip(&new));
    let differs = |&(name, (old, new)): &(&str, (&str, &str))| name != WALL_TIME.name && old != new;
    let told = |(name, (old, new))| format!("summary.csv has {name} = {old}, not {new}");
    cells.filter(|cell| differs(cell)).map(told).next()
}

fn in_lines(old: &str, new: &str, name: &str) -> Option<String> {
    let pairs = old.lines().zip(new.lines()).enumerate();
    let told = |(at, (old, new))| format!("line {} of the {name} is {old}, not {new}", at + 1);
    let first = pairs.filter(|(_, (old, new))| old != new).map(told).next();
    let [lines, now] = [old, new].map(|text| text.lines().count());
    first.or_else(|| {
        (old != new).then(|| match lines == now {
            true => format!("the {name} has other line ends"),
            false => format!("the {name} has {}, not {now}", counted(lines, "line")),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::super::trial;
    use super::*;

    #[test]
    fn a_planted_difference_is_told() {
        let (_root, path, study) = trial::room("0.2, 0.3");
        let directory = trial::finished(&path, &study);
        let case = &study.cases[1];
        let told = |result: &CaseResult| {
            first_difference(&path, (&study, directory.records()), case, result)
                .unwrap()
                .unwrap_or_default()
        };
        let result = made_up(&case.config);
        assert_eq!(told(&result), "");
        let mut planted = result.clone();
        planted.outcome.force_max.value =
            f64::from_bits(result.outcome.force_max.value.to_bits() + 1);
        assert!(told(&planted).starts_with("summary.csv has force_max = "), "{}", told(&planted));
        let mut planted = result.clone();
        planted.history[7].runup = 0.5;
        assert!(told(&planted).starts_with("line 9 of the history is "), "{}", told(&planted));
        planted.history.clone_from(&result.history);
        planted.history.pop();
        assert!(
            told(&planted).starts_with("the history has 21 lines, not 20"),
            "{}",
            told(&planted)
        );
        assert_eq!(in_lines("a\n", "", "history").unwrap(), "the history has 1 line, not 0");
        assert_eq!(in_lines("a\r\n", "a\n", "history").unwrap(), "the history has other line ends");
        let mut planted = result.clone();
        planted.energy.kinetic += 1.0;
        assert_eq!(told(&planted), "the journal has other energies");
        let mut planted = result.clone();
        planted.envelope[1].pressure_max_pa += 1.0;
        assert!(told(&planted).starts_with("line 3 of the envelope is "), "{}", told(&planted));
        assert!(damaged_files(&path, case.id).unwrap().is_empty());
        let history = files::history_path(&path, case.id);
        let damage: [(&dyn Fn(), [&str; 2]); 3] = [
            (&|| std::fs::write(&history, "time_s\r\n").unwrap(), ["line 1 of the", "is damaged"]),
            (&|| std::fs::write(&history, b"\xff\n").unwrap(), ["line 1 of the", "is damaged"]),
            (&|| std::fs::remove_file(&history).unwrap(), ["the history cannot be", "is missing"]),
        ];
        for (way, [difference, damage]) in damage {
            way();
            assert!(told(&result).starts_with(difference), "{}", told(&result));
            let files = damaged_files(&path, case.id).unwrap();
            assert!(files.len() == 1 && files[0].ends_with(damage), "{files:?}");
        }
        for text in [&b"\xff\xfe\n"[..], b""] {
            std::fs::write(path.join("summary.csv"), text).unwrap();
            assert!(told(&result).starts_with("summary.csv"), "{}", told(&result));
        }
        std::fs::remove_file(path.join("summary.csv")).unwrap();
        assert!(told(&result).starts_with("summary.csv: there is no"), "{}", told(&result));
    }
}
