//! Whether a directory still holds what was written into it.

use std::path::Path;

use super::error::SweepError;
use super::manifest::Manifest;
use super::record::CaseRecord;
use super::{checkpoints, files, journal, opening, summary};
use crate::study::Study;

/// Everything in a directory that is not as it was written, in words. `records` are those of the study,
/// see [`super::finished`].
///
/// # Errors
/// A journal that cannot be read.
pub fn verify(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<Vec<String>, SweepError> {
    let content = journal::read_journal(directory)?;
    let mut told: Vec<String> = opening::told_damage(&content).into_iter().collect();
    let cases = records[..study.cases.len()].iter().flatten().filter(|record| record.is_ok());
    let damaged = cases.filter_map(|record| files::damage(directory, record.id, &record.files));
    told.extend(damaged.map(|(path, what)| format!("{} {what}", path.display())));
    let kept = checkpoints::damaged(directory);
    told.extend(
        kept.map(|path| format!("{} is damaged: what it is of starts over", path.display())),
    );
    if !summary_fits(directory, study, records)? {
        told.push("summary.csv is not what the journal says".to_owned());
    }
    if Manifest::read(directory).is_none() {
        told.push("manifest.json is missing or damaged".to_owned());
    }
    Ok(told)
}

/// Makes `summary.csv` again where it is not what the journal says; whether it did. A summary with more
/// rows than the journal knows stays: the sweep's next run brings both together.
///
/// # Errors
/// A file that cannot be read or written.
pub fn renew_summary(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<bool, SweepError> {
    let known = records[..study.cases.len()].iter().flatten().count();
    let renew = !summary_fits(directory, study, records)? && rows(directory) <= known;
    if renew {
        summary::write(directory, study, records)?;
    }
    Ok(renew)
}

/// Rows of `summary.csv`, damaged or not.
fn rows(directory: &Path) -> usize {
    let text = std::fs::read(directory.join("summary.csv")).unwrap_or_default();
    text.iter().filter(|&&byte| byte == b'\n').count().saturating_sub(1)
}

fn summary_fits(
    directory: &Path,
    study: &Study,
    records: &[Option<CaseRecord>],
) -> Result<bool, SweepError> {
    let path = directory.join("summary.csv");
    let wrong = |error: csv::Error| SweepError::io(&path)(error.into());
    let table = summary::table(study, records).map_err(wrong)?;
    if !path.exists() && records[..study.cases.len()].iter().any(Option::is_none) {
        return Ok(true); // The sweep has not come so far.
    }
    let there = if path.exists() { std::fs::read(&path) } else { Ok(Vec::new()) };
    Ok(there.map_err(SweepError::io(&path))? == table)
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::super::{Directory, OpenMode, finished};
    use super::*;
    use crate::math::simd::SimdPath;
    use crate::study::SweepFile;

    #[test]
    fn a_flipped_bit_is_told_wherever_it_is() {
        let root = tempfile::tempdir().unwrap();
        let text = "name = \"a\"\n[grid]\nwave_height_ratio = [0.2, 0.3]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let path = root.path().join("run");
        let open = || Directory::open(&path, &study, OpenMode::Resume, None, SimdPath::Portable);
        let (mut directory, _) = open().unwrap();
        for case in &study.cases {
            let result = made_up(&case.config);
            let record = CaseRecord::new(&study, case, &Ok(result.clone()), 1.0, "here");
            directory.record(record, Some(&result)).unwrap();
        }
        directory.sync(true).unwrap();
        directory.write_tables(&study).unwrap();
        Manifest::new(&path, &study, &[], SimdPath::Portable).write(&path).unwrap();
        drop(directory);
        let told = || verify(&path, &study, &finished(&path, &study).unwrap()).unwrap();
        assert_eq!(told(), Vec::<String>::new());
        let history = std::fs::read_dir(path.join("histories")).unwrap().next().unwrap().unwrap();
        for (name, case_runs_again) in [
            (history.path(), true),
            (path.join("summary.csv"), false),
            (path.join("journal.jsonl"), true),
        ] {
            let before = std::fs::read(&name).unwrap();
            let mut damaged = before.clone();
            let place = damaged.len() * 3 / 4;
            damaged[place] ^= 4;
            std::fs::write(&name, damaged).unwrap();
            assert!(!told().is_empty(), "{}", name.display());
            let (directory, _) = open().unwrap();
            assert_eq!(directory.records().iter().flatten().count() == 1, case_runs_again);
            assert_eq!(!directory.findings().is_empty(), case_runs_again);
            drop(directory);
            std::fs::write(&name, before).unwrap();
        }
        std::fs::write(path.join("manifest.json"), "").unwrap();
        assert_eq!(told(), ["manifest.json is missing or damaged"]);
        std::fs::write(path.join("summary.csv"), "x").unwrap();
        let records = finished(&path, &study).unwrap();
        assert!(renew_summary(&path, &study, &records).unwrap());
        assert!(!renew_summary(&path, &study, &records).unwrap());
    }
}
