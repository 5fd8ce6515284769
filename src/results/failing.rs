//! Every system call that changes a file fails once in turn, alone or with all that follow. The
//! next process must be able to go on to the same bytes.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::trial::{self, SIMD};
use super::{
    CaseRecord, Checkpoint, Delivery, Directory, Filing, Manifest, OpenMode, Opened, SweepError,
    made_up, write_all_histories,
};
use crate::disk::faults;
use crate::simulation::{CaseResult, Failure};
use crate::study::{Case, CaseId, Study};

fn study() -> Study {
    trial::study("0.1, 0.2, 0.3")
}

/// A session as in `sweep`, with made-up results. `kept` gets the cases that are certainly on the
/// disk.
fn session(
    path: &Path,
    study: &Study,
    mode: OpenMode,
    kept: &mut Vec<CaseId>,
) -> Result<(), SweepError> {
    let (mut directory, _) = Directory::open(path, study, mode, Some(SIMD), SIMD)?;
    Manifest::new(path, study, &[], SIMD).write(path)?;
    let missing = |case: &&Case| directory.runs()[case.index].is_none();
    let missing: Vec<_> = study.runs().filter(missing).cloned().collect();
    for case in &missing {
        directory.attempts().turn(None, &[case.id])?;
        // If a checkpoint cannot be written, only the checkpoint is lost.
        let _ = Checkpoint::of_case(path, case.id, SIMD).write(b"state");
        let result = made_up(&case.config);
        record(&mut directory, study, case, result)?;
        directory.attempts().turn(Some(case.id), &[])?;
        directory.sync(true)?;
        kept.push(case.id);
    }
    directory.attempts().close()?;
    directory.write_tables(study, &|| false)?;
    directory.clear()?;
    directory.demand_in_place()?;
    write_all_histories(path)?;
    Manifest::new(path, study, &[], SIMD).write(path)
}

/// Records a case. The second case is filed by its runner if possible. So is the third, which its
/// runner also puts on the disk.
fn record(
    directory: &mut Directory,
    study: &Study,
    case: &Case,
    result: CaseResult,
) -> Result<(), SweepError> {
    let filing = Filing::here(directory.path());
    let delivery = match case.index {
        0 => Delivery::Whole(Box::new(result)),
        1 => filing.deliver(Some(case.id), result),
        _ => filing.syncing().deliver(Some(case.id), result),
    };
    match delivery {
        Delivery::Whole(result) => {
            let result: Result<CaseResult, Failure> = Ok(*result);
            let record = CaseRecord::new(study, case, &result, 0.5, "here");
            directory.record(record, result.as_ref().ok())
        }
        Delivery::Filed(filed) => {
            let record = CaseRecord::of_filed(study, case, &filed, 0.5, "here");
            directory.record_filed(record, &filed)
        }
    }
}

/// Every file below a directory.
fn files(path: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(path).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            let inside = super::failing::files(&entry.path()).into_iter();
            files.extend(inside.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            files.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    files
}

/// Fails call after call of a session in the state that `before` has left, and goes on after each.
fn fail_in_turn(mode: OpenMode, before: impl Fn(&Path)) {
    let study = study();
    let root = tempfile::tempdir().unwrap();
    let whole = root.path().join("whole");
    session(&whole, &study, OpenMode::Resume, &mut Vec::new()).unwrap();
    let expected = files(&whole);
    for more in [0, 2, usize::MAX] {
        for call in 0.. {
            let room = tempfile::tempdir().unwrap();
            let path = room.path().join("out");
            before(&path);
            let mut kept = Vec::new();
            faults::arm(call, more);
            let ended = session(&path, &study, mode, &mut kept);
            let calls = faults::disarm();
            if calls <= call {
                assert!(ended.is_ok() && call > 20, "{ended:?} after {calls} calls");
                break;
            }
            if let Err(error) = &ended {
                assert!(!error.is_refusal() || kept.is_empty(), "call {call}: {error}");
            }
            // All cases that were reported to be on the disk are there.
            let opened = Directory::open(&path, &study, OpenMode::Resume, None, SIMD);
            let (directory, opened) = opened.unwrap_or_else(|error| panic!("call {call}: {error}"));
            assert!(directory.findings().is_empty(), "call {call}: {:?}", directory.findings());
            if let Opened::Resumed(_) = opened {
                let there = |id: &CaseId| directory.runs().iter().flatten().any(|it| it.id == *id);
                assert!(kept.iter().all(there), "call {call}");
            } else {
                assert!(kept.is_empty(), "call {call}");
            }
            drop(directory);
            session(&path, &study, OpenMode::Resume, &mut kept).unwrap();
            let left = files(&path);
            assert_eq!(
                left.keys().collect::<Vec<_>>(),
                expected.keys().collect::<Vec<_>>(),
                "{call}"
            );
            let differs = expected.iter().find(|(name, bytes)| left[*name] != **bytes);
            assert!(differs.is_none(), "call {call}: {}", differs.unwrap().0);
        }
    }
}

#[test]
fn a_failing_call_of_a_new_study_loses_nothing() {
    fail_in_turn(OpenMode::Resume, |_| {});
}

#[test]
fn a_failing_call_of_a_study_that_is_mended_loses_nothing() {
    fail_in_turn(OpenMode::Resume, |path| {
        session(path, &study(), OpenMode::Resume, &mut Vec::new()).unwrap();
        let journal = path.join("journal.jsonl");
        let text = fs::read_to_string(&journal).unwrap();
        // Its last line is torn, and a history is half written.
        fs::write(&journal, &text[..text.len() - 30]).unwrap();
        fs::write(path.join("histories/0.csv.partial"), "time_s").unwrap();
    });
}

#[test]
fn a_failing_call_of_a_study_that_starts_over_loses_nothing() {
    fail_in_turn(OpenMode::Fresh, |path| {
        session(path, &study(), OpenMode::Resume, &mut Vec::new()).unwrap();
    });
}
