use tempfile::TempDir;

use super::super::trial;
use super::*;

/// A journal of three cases in a directory, its header and its records.
fn filled() -> (TempDir, PathBuf, Header, Vec<CaseRecord>) {
    let root = tempfile::tempdir().unwrap();
    let (directory, study) = (root.path(), trial::study("0.1, 0.2, 0.3"));
    let header = Header::new("a", &study.identity, 3, trial::SIMD);
    let mut journal = Journal::create(directory, &header).unwrap();
    let mut records = Vec::new();
    for case in &study.cases {
        let record = CaseRecord { wall_time_s: 0.1 + 0.2, ..trial::record(&study, case) };
        journal.record(&record).unwrap();
        records.push(record);
    }
    assert!(journal.waits(Duration::ZERO));
    journal.sync().unwrap();
    let path = directory.join(JOURNAL);
    (root, path, header, records)
}

fn resume(directory: &Path, header: &Header) -> (Journal, Vec<CaseRecord>) {
    let content = read_journal(directory).unwrap();
    (Journal::resume(directory, &content, header).unwrap(), content.records)
}

#[test]
fn a_journal_round_trips_every_bit() {
    let (directory, _, header, records) = filled();
    let content = read_journal(directory.path()).unwrap();
    assert_eq!((content.header, content.records), (Some(header), records));
}

#[test]
fn a_torn_tail_is_cut_wherever_it_tore() {
    let (directory, path, header, records) = filled();
    let bytes = std::fs::read(&path).unwrap();
    let ends: Vec<_> = (1..=bytes.len()).filter(|&end| bytes[end - 1] == b'\n').collect();
    let near_an_end = |length: &usize| ends.iter().any(|end| end.abs_diff(*length) <= 2);
    for length in (0..bytes.len()).filter(|length| length % 97 == 0 || near_an_end(length)) {
        std::fs::write(&path, &bytes[..length]).unwrap();
        let whole = ends.iter().filter(|&&end| end <= length).count();
        let (mut journal, read) = resume(directory.path(), &header);
        assert_eq!(read, records[..whole.saturating_sub(1)]);
        journal.record(&records[0]).unwrap();
        let again = read_journal(directory.path()).unwrap();
        assert_eq!((again.records.len(), again.damaged), (whole.max(1), 0));
    }
}

#[test]
fn a_flipped_bit_costs_its_record_alone() {
    let (directory, path, header, records) = filled();
    let bytes = std::fs::read(&path).unwrap();
    let breaks: Vec<_> = (0..bytes.len()).filter(|&at| bytes[at] == b'\n').collect();
    let near_a_break = |at: &usize| breaks.iter().any(|other| other.abs_diff(*at) <= 1);
    let places = (0..bytes.len()).filter(|at| at % 101 == 0 || near_a_break(at));
    for (at, bit) in places.flat_map(|at| (0..8).map(move |bit| (at, bit))) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << bit;
        std::fs::write(&path, &damaged).unwrap();
        let (_, read) = resume(directory.path(), &header);
        let lost = breaks.iter().filter(|&&end| end < at).count();
        let kept = |number: usize| {
            let record = &records[number];
            read.contains(record) || (lost == number + 1 && !breaks.contains(&at))
        };
        assert!((0..records.len()).all(kept), "byte {at}, bit {bit}");
        let again = read_journal(directory.path()).unwrap();
        assert_eq!((again.header.as_ref(), again.records), (Some(&header), read));
    }
}

#[test]
fn a_whole_line_of_another_version_is_never_cut_off() {
    let (directory, path, ..) = filled();
    let mut bytes = std::fs::read(&path).unwrap();
    let entry = br#"{"tide":{"level_m":0.2}}"#;
    let sum = super::super::checksum::checksum(entry);
    bytes.extend(format!("{{\"sum\":\"{sum}\",\"entry\":").into_bytes());
    bytes.extend(entry);
    bytes.extend(b"}\n");
    std::fs::write(&path, &bytes).unwrap();
    let error = read_journal(directory.path()).unwrap_err();
    assert!(error.is_refusal());
    assert!(error.to_string().contains("line 5: is whole, but written by another"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), bytes);
}

#[test]
fn a_journal_that_is_moved_is_missed() {
    let (directory, path, header, _) = filled();
    let (journal, _) = resume(directory.path(), &header);
    journal.demand_in_place().unwrap();
    std::fs::rename(&path, directory.path().join("elsewhere")).unwrap();
    assert!(journal.demand_in_place().is_err());
    std::fs::copy(directory.path().join("elsewhere"), &path).unwrap();
    assert!(journal.demand_in_place().is_err());
}
