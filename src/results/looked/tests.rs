use std::path::PathBuf;

use super::super::trial::{self, run, study};
use super::super::{Directory, OpenMode, Opened};
use super::*;
use crate::disk::faults;
use crate::study::Study;

/// A study in its directory.
struct Desk {
    root: tempfile::TempDir,
    study: Study,
}

impl Desk {
    /// Of five cases.
    fn new() -> Desk {
        let study = study("0.1, 0.2, 0.3, 0.4, 0.5");
        Desk { root: tempfile::tempdir().unwrap(), study }
    }

    /// Four are done. The first history was damaged before the note, which therefore hides it.
    fn noted() -> Desk {
        let desk = Desk::new();
        let mut directory = trial::open(&desk.path(), &desk.study);
        (0..4).for_each(|case| run(&mut directory, &desk.study, &desk.study.cases[case]));
        flip(&desk.history(0));
        directory.sync(true).unwrap();
        // Times of files are coarse.
        std::thread::sleep(Duration::from_millis(20));
        desk
    }

    fn path(&self) -> PathBuf {
        self.root.path().join("run")
    }

    fn history(&self, case: usize) -> PathBuf {
        self.path().join(format!("histories/{}.csv", self.study.cases[case].id))
    }

    /// Runs a case and puts it on the disk.
    fn run(&self, directory: &mut Directory, case: usize) -> Result<(), SweepError> {
        run(directory, &self.study, &self.study.cases[case]);
        directory.sync(true)
    }

    /// The number of intact cases, and the damage that was found.
    fn opened(&self, path: &Path) -> (usize, String) {
        let open = Directory::open(path, &self.study, OpenMode::Resume, None, trial::SIMD);
        match open.unwrap() {
            (directory, Opened::Resumed(well)) => (well, directory.findings().join("\n")),
            (_, other) => panic!("{other:?}"),
        }
    }

    fn note(&self) -> Option<Looked> {
        sealed::read(&self.path().join(FILE_NAME))
    }

    fn lines(&self) -> Option<usize> {
        self.note().map(|note| note.lines)
    }
}

fn flip(path: &Path) {
    let mut bytes = fs::read(path).unwrap();
    bytes[10] ^= 1;
    fs::write(path, bytes).unwrap();
}

/// A copy under the same name.
fn replace(path: &Path) {
    let copy = path.with_extension("copy");
    fs::copy(path, &copy).unwrap();
    fs::rename(copy, path).unwrap();
}

#[test]
fn what_was_noted_is_not_read() {
    let desk = Desk::noted();
    assert_eq!(desk.opened(&desk.path()), (4, String::new()));
    let moved = desk.root.path().join("moved");
    fs::rename(desk.path(), &moved).unwrap();
    assert_eq!(desk.opened(&moved), (4, String::new()));
}

/// Each of these changes makes a note worthless.
#[test]
fn all_is_read_where_anything_differs() {
    fn chmod(path: &Path) {
        fs::set_permissions(path, fs::metadata(path).unwrap().permissions()).unwrap();
    }
    fn noted(desk: &Desk, change: impl FnOnce(&mut Looked)) {
        let mut note = desk.note().unwrap();
        change(&mut note);
        sealed::write(&desk.path().join(FILE_NAME), &note).unwrap();
    }
    fn journal(desk: &Desk) -> (PathBuf, Vec<u8>) {
        let path = desk.path().join(JOURNAL);
        let text = fs::read(&path).unwrap();
        (path, text)
    }
    fn cut(desk: &Desk) {
        let (path, text) = journal(desk);
        let end = text[..text.len() - 1].iter().rposition(|&byte| byte == b'\n').unwrap();
        let file = fs::OpenOptions::new().write(true).open(path).unwrap();
        file.set_len(end as u64 + 1).unwrap();
    }
    fn break_line(desk: &Desk) {
        let (path, mut text) = journal(desk);
        let end = text[..text.len() / 2].iter().rposition(|&byte| byte == b'\n').unwrap();
        text[end + 12] ^= 1; // of its sum
        fs::write(path, text).unwrap();
    }
    /// A name, the number of intact cases after the change, and the change.
    type Change = (&'static str, usize, fn(&Desk));
    let changes: [Change; 13] = [
        ("time of a file", 3, |desk| chmod(&desk.history(2))),
        ("a file is replaced", 3, |desk| replace(&desk.history(2))),
        ("a file is missing", 2, |desk| fs::remove_file(desk.history(2)).unwrap()),
        ("a file is longer", 2, |desk| fs::write(desk.history(2), [b'1'; 5000]).unwrap()),
        ("another journal", 3, |desk| replace(&desk.path().join(JOURNAL))),
        ("a shorter journal", 2, cut),
        ("a damaged line", 2, break_line),
        ("a damaged note", 3, |desk| flip(&desk.path().join(FILE_NAME))),
        ("no note", 3, |desk| fs::remove_file(desk.path().join(FILE_NAME)).unwrap()),
        ("another version", 3, |desk| noted(desk, |note| note.version += 1)),
        ("a longer journal", 3, |desk| noted(desk, |note| note.bytes += 1)),
        ("more lines", 3, |desk| noted(desk, |note| note.lines += 1)),
        ("other files", 3, |desk| noted(desk, |note| note.files += 1)),
    ];
    for (what, well, change) in changes {
        let desk = Desk::noted();
        change(&desk);
        let (opened, told) = desk.opened(&desk.path());
        assert_eq!(opened, well, "{what}: {told}");
        let first = format!("{}.csv is damaged", desk.study.cases[0].id);
        assert!(told.contains(&first), "{what}: {told}");
        assert_eq!(desk.note(), None, "{what}");
    }
}

/// A note once covered the files of a copy.
#[test]
fn a_copied_directory_is_read() {
    let desk = Desk::noted();
    let copy = desk.root.path().join("copy");
    let copied = std::process::Command::new("cp").arg("-a").arg(desk.path()).arg(&copy).status();
    assert!(copied.unwrap().success());
    assert_eq!(desk.opened(&copy).0, 3);
    assert_eq!(desk.opened(&desk.path()).0, 4);
}

/// For half a line the journal was once written again, as a file unknown to the note.
#[test]
fn a_torn_line_is_cut_off_and_leaves_the_note_its_worth() {
    let desk = Desk::noted();
    let path = desk.path().join(JOURNAL);
    let whole = fs::read(&path).unwrap();
    fs::write(&path, [&whole[..], &whole[whole.len() - 400..whole.len() - 100]].concat()).unwrap();
    assert_eq!(desk.opened(&desk.path()), (4, String::new()));
    assert_eq!(fs::read(&path).unwrap(), whole);
    assert!(desk.opened(&desk.path()).0 == 4 && desk.note().is_some());
}

#[test]
fn nothing_is_noted_before_damaged_cases_have_run() {
    let desk = Desk::noted();
    fs::remove_file(desk.history(2)).unwrap();
    let mut directory = trial::open(&desk.path(), &desk.study);
    desk.run(&mut directory, 0).unwrap();
    assert_eq!((directory.findings().len(), desk.note()), (2, None));
    desk.run(&mut directory, 2).unwrap();
    assert_eq!(desk.lines(), Some(6));
    drop(directory);
    assert_eq!(desk.opened(&desk.path()), (4, String::new()));
    assert_eq!(desk.lines(), Some(6), "what runs again counts once");
}

/// A note once covered files of a killed process that were not on the disk.
#[test]
fn what_a_killed_process_has_left_goes_to_the_disk_before_it_is_noted() {
    let killed = || {
        let desk = Desk::new();
        let mut directory = trial::open(&desk.path(), &desk.study);
        (0..2).for_each(|case| run(&mut directory, &desk.study, &desk.study.cases[case]));
        desk.run(&mut directory, 2).unwrap();
        assert_eq!(desk.lines(), Some(3));
        run(&mut directory, &desk.study, &desk.study.cases[3]);
        std::thread::sleep(Duration::from_millis(20));
        desk
    };
    let desk = killed();
    let mut directory = trial::open(&desk.path(), &desk.study);
    assert_eq!((directory.findings().len(), desk.lines()), (0, Some(3)));
    desk.run(&mut directory, 4).unwrap();
    assert_eq!(desk.lines(), Some(5));
    drop(directory);
    assert_eq!(desk.opened(&desk.path()), (5, String::new()));
    // Files that cannot be put on the disk get no note.
    let desk = killed();
    let mut directory = trial::open(&desk.path(), &desk.study);
    fs::remove_file(desk.history(3)).unwrap();
    assert!(desk.run(&mut directory, 4).is_err());
    assert_eq!(desk.lines(), Some(3));
    drop(directory);
    // Putting all found files on the disk one by one would take too long: no note.
    let desk = killed();
    fs::remove_file(desk.path().join(FILE_NAME)).unwrap();
    let mut directory = trial::open(&desk.path(), &desk.study);
    desk.run(&mut directory, 4).unwrap();
    assert_eq!(desk.lines(), None);
    // Files after a note are read.
    let desk = killed();
    flip(&desk.history(3));
    assert_eq!((desk.opened(&desk.path()).0, desk.lines()), (3, Some(3)));
}

#[test]
fn a_note_comes_after_all_that_it_tells_of() {
    for call in 0.. {
        let desk = Desk::noted();
        let mut directory = trial::open(&desk.path(), &desk.study);
        run(&mut directory, &desk.study, &desk.study.cases[4]);
        faults::arm(call, usize::MAX);
        let synced = directory.sync(true);
        if faults::disarm() <= call {
            synced.unwrap();
            assert!(call > 6 && desk.lines() == Some(5), "{call} calls");
            break;
        }
        assert!(synced.is_err() && desk.lines() == Some(4), "call {call}");
    }
}

#[test]
fn a_small_study_is_read_whole() {
    let desk = Desk { study: study("0.1, 0.2"), ..Desk::new() };
    let mut directory = trial::open(&desk.path(), &desk.study);
    (0..2).for_each(|case| desk.run(&mut directory, case).unwrap());
    assert_eq!(desk.note(), None);
}

#[test]
fn nothing_is_left_of_it_at_the_end() {
    let desk = Desk::noted();
    trial::open(&desk.path(), &desk.study).clear().unwrap();
    assert_eq!(desk.note(), None);
}
