//! `probes/columns.csv`: the contents of the probes' columns. They follow from the study alone.

use std::fs;
use std::path::Path;

use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, case_tables};
use crate::disk;
use crate::disk::names::PROBE_COLUMNS;
use crate::simulation::probe_columns;
use crate::study::{Case, Study};

/// The whole file; `None` if no case has probes. It is the same for all cases of a sweep, except
/// that only some walls may have a crest. Then the file has the columns of those with a crest.
pub(super) fn text(study: &Study) -> Option<String> {
    let columns = study.cases.iter().map(|case| probe_columns(&case.config));
    let most = columns.max_by_key(Vec::len).filter(|columns| !columns.is_empty())?;
    Some(case_tables::probe_columns(&most))
}

/// Whether a case with probes was successful, so that the file exists.
fn is_due(study: &Study, records: &[Option<CaseRecord>]) -> bool {
    let ended = |record: &Option<CaseRecord>| record.as_ref().is_some_and(CaseRecord::is_ok);
    let is_probed = |case: &Case| !probe_columns(&case.config).is_empty();
    study.cases.iter().zip(records).any(|(case, record)| ended(record) && is_probed(case))
}

/// Whether the file exists and is right, or is not needed.
pub(super) fn fits(directory: &Path, study: &Study, records: &[Option<CaseRecord>]) -> bool {
    !is_due(study, records) || text(study).is_none_or(|text| is_written(directory, &text))
}

/// Writes the file if it is needed and not right.
pub(super) fn write(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<(), SweepError> {
    let text = text(study).filter(|_| is_due(study, records));
    text.map_or(Ok(()), |text| put(directory, &text))
}

/// The same for a known text, for a case with probes.
pub(super) fn put(directory: &Path, text: &str) -> Result<(), SweepError> {
    if is_written(directory, text) {
        return Ok(());
    }
    let path = directory.join(PROBE_COLUMNS);
    let folder = path.parent().unwrap_or(directory);
    disk::create_folder(folder).map_err(SweepError::io(folder))?;
    atomic_file::write(&path, text.as_bytes())
}

fn is_written(directory: &Path, text: &str) -> bool {
    fs::read(directory.join(PROBE_COLUMNS)).is_ok_and(|there| there == text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::super::trial;
    use super::*;

    #[test]
    fn columns_of_a_crest_are_there_whichever_case_has_ended() {
        let text = "name = \"a\"\n[scene]\nwall = \"fixed\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.1\n\
            [[probe]]\nname = \"p\"\nkind = \"level\"\nx_m = 0.5\n\
            [grid]\nbehind = [\"nothing\", \"outflow\"]";
        let study = trial::of_file(text);
        let root = tempfile::tempdir().unwrap();
        let record = trial::record(&study, &study.cases[0]);
        let mut records = vec![None; 2];
        assert!(fits(root.path(), &study, &records), "it need not be there yet");
        records[0] = Some(record);
        assert!(!fits(root.path(), &study, &records));
        write(root.path(), &study, &records).unwrap();
        assert!(fits(root.path(), &study, &records));
        let text = fs::read_to_string(root.path().join(PROBE_COLUMNS)).unwrap();
        assert_eq!(text.lines().count(), 6, "{text}");
        fs::write(root.path().join(PROBE_COLUMNS), "name,unit,method\n").unwrap();
        assert!(!fits(root.path(), &study, &records));
    }
}
