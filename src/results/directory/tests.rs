use std::fs;
use std::time::Duration;

use super::super::trial::{room, run, study};
use super::super::waiting;
use super::*;
use crate::disk::names::JOURNAL;

fn open(path: &Path, study: &Study, mode: OpenMode) -> Result<(Directory, Opened), SweepError> {
    Directory::open(path, study, mode, None, SimdPath::Avx2)
}

fn run_first(directory: &mut Directory, study: &Study) {
    run(directory, study, &study.cases[0]);
    directory.sync(true).unwrap();
}

#[test]
fn a_sweep_goes_on_where_it_stopped() {
    let (_root, path, study) = room("0.1, 0.2");
    let (mut directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::New);
    run_first(&mut directory, &study);
    drop(directory);
    let (directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::Resumed(1));
    drop(directory);
    // A power cut may leave the name of a file without its content.
    let history = fs::read_dir(path.join("histories")).unwrap().next().unwrap().unwrap().path();
    fs::File::create(&history).unwrap();
    let (mut directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::Resumed(0));
    run_first(&mut directory, &study);
    drop(directory);
    fs::remove_file(history).unwrap();
    let (_directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::Resumed(0));
}

/// The journal still has its line.
#[test]
fn tables_leave_out_a_case_that_is_to_run_again() {
    let (_root, path, study) = room("0.1, 0.2");
    drop(super::super::trial::finished(&path, &study));
    fs::write(super::files::history_path(&path, study.cases[0].id), "damaged").unwrap();
    let (mut directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::Resumed(1));
    assert!(directory.records().is_empty());
    directory.write_tables(&study, &|| false).unwrap();
    let there = directory.case_records().iter().map(|record| record.is_some());
    assert_eq!(there.collect::<Vec<_>>(), [false, true]);
    assert_eq!(fs::read_to_string(path.join("summary.csv")).unwrap().lines().count(), 2);
}

#[test]
fn what_is_recorded_while_a_group_is_on_its_way_belongs_to_the_next() {
    let (_root, path, study) = room("0.1, 0.2, 0.3");
    let (mut directory, _) = open(&path, &study, OpenMode::Resume).unwrap();
    for case in &study.cases {
        run(&mut directory, &study, case);
        // A line is there at once, so a killed process loses nothing.
        assert_eq!(journal::read_journal(&path).unwrap().records.len(), case.index + 1);
        std::thread::sleep(waiting::LONGEST);
        directory.sync(false).unwrap();
    }
    directory.sync(true).unwrap();
    assert!(directory.waiting.is_over());
    assert!(!directory.journal.waits(Duration::ZERO));
    drop(directory);
    let (_directory, opened) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(opened, Opened::Resumed(3));
}

#[test]
fn another_sweeps_directory_is_refused_untouched() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("run");
    open(&path, &study("0.1, 0.2"), OpenMode::Resume).unwrap();
    let before = fs::read(path.join(JOURNAL)).unwrap();
    let error = open(&path, &study("0.1, 0.3"), OpenMode::Resume).unwrap_err();
    assert!(error.to_string().contains("holds another sweep"), "{error}");
    assert_eq!(fs::read(path.join(JOURNAL)).unwrap(), before);
    let (_directory, opened) = open(&path, &study("0.1, 0.3"), OpenMode::Fresh).unwrap();
    assert_eq!(opened, Opened::Moved(root.path().join("run.old-1")));
}

/// Between the old directory and the first line of the new journal there is nothing to move aside.
/// A process that looked then once took the other one's results for its own.
#[test]
fn who_starts_over_never_goes_on_with_what_another_began() {
    let (root, path, study) = room("0.1, 0.2");
    fs::create_dir(&path).unwrap();
    let lock = Lock::hold(&path).unwrap();
    std::thread::scope(|scope| {
        let second = scope.spawn(|| open(&path, &study, OpenMode::Fresh));
        std::thread::sleep(Duration::from_millis(300));
        let header = Header::new(&study.name, &study.identity, 2, SimdPath::Avx2);
        Journal::create(&path, &header).unwrap();
        drop(lock);
        match second.join().unwrap() {
            Err(error) => assert!(error.to_string().contains("just started over"), "{error}"),
            // It may have looked after the first line was there.
            Ok((_, opened)) => assert_eq!(opened, Opened::Moved(root.path().join("run.old-1"))),
        }
    });
}

/// A link to a large disk was once moved aside, and a folder beside it took the new results.
#[test]
fn a_link_still_leads_to_the_disk_it_led_to() {
    let root = tempfile::tempdir().unwrap();
    let [disk, link] = ["disk", "link"].map(|name| root.path().join(name));
    fs::create_dir(&disk).unwrap();
    std::os::unix::fs::symlink(disk.join("run"), &link).unwrap();
    fs::create_dir(disk.join("run")).unwrap();
    open(&link, &study("0.1, 0.2"), OpenMode::Resume).unwrap();
    let (_directory, opened) = open(&link, &study("0.1, 0.2"), OpenMode::Fresh).unwrap();
    let disk = fs::canonicalize(disk).unwrap();
    assert_eq!(opened, Opened::Moved(disk.join("run.old-1")));
    assert!(link.is_symlink() && disk.join("run").join(JOURNAL).is_file());
}

#[test]
fn a_strangers_directory_is_never_moved() {
    let root = tempfile::tempdir().unwrap();
    fs::write(root.path().join("thesis.tex"), "").unwrap();
    for mode in [OpenMode::Resume, OpenMode::Fresh] {
        assert!(open(root.path(), &study("0.1"), mode).unwrap_err().is_refusal());
    }
    assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
}

#[test]
fn the_instruction_set_is_kept() {
    let (_root, path, study) = room("0.1, 0.2");
    let with = |requested, widest| {
        Directory::open(&path, &study, OpenMode::Resume, requested, widest)
            .map(|(directory, _)| directory.simd())
    };
    use SimdPath::{Avx2, Avx512, Portable};
    assert!(with(Some(Avx512), Avx2).is_err());
    assert!(!path.exists(), "nothing is written for a refused request");
    assert_eq!(with(None, Avx2).unwrap(), Avx2);
    assert_eq!(with(None, Avx512).unwrap(), Avx2);
    assert!(with(None, Portable).is_err());
    assert!(with(Some(Portable), Avx2).is_err());
}

#[test]
fn files_that_go_away_are_missed() {
    let (_root, path, study) = room("0.1, 0.2");
    let (mut directory, _) = open(&path, &study, OpenMode::Resume).unwrap();
    run_first(&mut directory, &study);
    let told = |directory: &Directory| directory.left().demand(&path).map_err(|e| e.to_string());
    assert_eq!(told(&directory), Ok(()));
    // The journal's reader knows it as well as a new run.
    drop(directory);
    let (directory, _) = open(&path, &study, OpenMode::Resume).unwrap();
    assert_eq!(told(&directory), Ok(()));
    fs::remove_dir_all(path.join("histories")).unwrap();
    let first = told(&directory).unwrap_err();
    assert!(first.contains("histories/") && first.contains(".csv went away"), "{first}");
    fs::remove_dir_all(path.join("envelopes")).unwrap();
    assert!(told(&directory).unwrap_err().contains(".csv and 1 other file went away"));
}
