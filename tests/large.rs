//! Studies of very many cases: what they take in memory and time to be reported and to be opened again.

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use seawall::execute::fake::{FakeRunner, cost};
use seawall::execute::{
    Ending, Interrupt, Progress, ProgressStyle, Session, Setup, coordinate, threads,
};
use seawall::math::simd::SimdPath;
use seawall::results::{CaseRecord, Closing, Directory, Manifest, OpenMode, made_up};
use seawall::study::{Plan, Study, SweepFile};

use common::{expect_code, seawall};

/// Bytes that are held, and the most that ever were.
static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

/// Whose turn it is: what one test holds counts in the other, too.
static ALONE: Mutex<()> = Mutex::new(());

struct Counting;

// SAFETY: all work is the system's.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Relaxed) + layout.size();
        MOST.fetch_max(held, Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A study of made-up cases that is finished, or goes on to its end, and its sweep file.
fn finished(root: &Path, cases: usize) -> (PathBuf, PathBuf) {
    let text = format!(
        "name = \"large\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
         wave_height_ratio = 0.3\n[grid]\n\
         spring_stiffness_n_per_m = {{ from = 10, to = 1e6, points = {cases}, spacing = \"log\" }}\n"
    );
    let (file, out) = (root.join("large.toml"), root.join("out"));
    fs::write(&file, &text).unwrap();
    let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
    let interrupt = Interrupt::default();
    let setup = Setup {
        make_runner: &|_| Box::new(FakeRunner::default()),
        threads: Some(2),
        interrupt: &interrupt,
        patience: Duration::MAX,
    };
    threads::with_crew(&setup, |crew| {
        let simd = SimdPath::Portable;
        let open = Directory::open(&out, &study, OpenMode::Resume, Some(simd), simd);
        let (mut directory, _) = open.unwrap();
        let missing = |index: usize| directory.runs()[index].is_none();
        let plan = Plan::new(&study, true, cost, missing);
        let ranks = crew.ranks().to_vec();
        crew.work(simd, &out, &mut |link| {
            let mut session = Session {
                study: &study,
                plan: &plan,
                directory: &mut directory,
                ranks: &ranks,
                interrupt: &interrupt,
                progress: Progress::new(ProgressStyle::Quiet, Default::default()),
            };
            assert_eq!(coordinate(link, &mut session)?.ending, Ending::Finished);
            Ok(())
        })
        .unwrap();
        Manifest::new(&out, &study, &[], simd).write(&out).unwrap();
    });
    (file, out)
}

/// Runs the sweep, here finished; what it told.
fn again(file: &Path, out: &Path) -> String {
    let mut command = seawall();
    command.arg("sweep").arg(file).arg("--out").arg(out).args(["--film", "none"]);
    let output = command.output().unwrap();
    expect_code(&output, 0);
    assert!(String::from_utf8_lossy(&output.stderr).contains("is finished; --fresh would run"));
    String::from_utf8(output.stdout).unwrap()
}

fn changed(path: &Path) -> std::time::SystemTime {
    fs::metadata(path).unwrap().modified().unwrap()
}

/// A large study is read once after its end. After that it is told again without its journal, its grid and its
/// files, until anything of it has changed.
#[test]
fn a_closed_study_is_told_again_until_it_changes() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let root = tempfile::tempdir().unwrap();
    let (file, out) = finished(root.path(), Closing::ABOVE + 1);
    let told = again(&file, &out);
    assert!(told.contains("10001 of 10001 cases are well") && told.contains("report.html"));
    let (summary, page) = (out.join("summary.csv"), out.join("report.html"));
    let (first, made) = (fs::read(&summary).unwrap(), changed(&page));
    let journal = out.join("journal.jsonl");
    assert_eq!(again(&file, &out), told);
    assert_eq!(changed(&page), made, "the page was not made again");
    // Another file is another study.
    let other = root.path().join("other.toml");
    fs::write(&other, fs::read_to_string(&file).unwrap().replace("0.3", "0.4")).unwrap();
    let mut command = seawall();
    command.arg("sweep").arg(&other).arg("--out").arg(&out).args(["--film", "none"]);
    expect_code(&command.output().unwrap(), 2);
    // A line that is there twice changes nothing but the journal's length: all is read again.
    let lines = fs::read(&journal).unwrap();
    let last = lines[..lines.len() - 1].iter().rposition(|&byte| byte == b'\n').unwrap();
    fs::write(&journal, [&lines[..], &lines[last + 1..]].concat()).unwrap();
    fs::write(&summary, "damaged").unwrap();
    assert_eq!(again(&file, &out), told);
    assert_eq!(fs::read(&summary).unwrap(), first, "the summary was made again");
    assert!(changed(&page) > made);
    // What a report makes again does not open a closed study.
    expect_code(&seawall().arg("report").arg(&out).output().unwrap(), 0);
    let made = changed(&page);
    assert_eq!(again(&file, &out), told);
    assert_eq!(changed(&page), made);
}

/// The story: to go on with a million cases every file of those that were done was read again, which took minutes.
#[test]
fn a_large_study_that_was_killed_goes_on_to_the_same_bytes() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let cases = Closing::ABOVE + 1;
    let [one, other] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (file, whole) = finished(one.path(), cases);
    let out = other.path().join("out");
    let study = Study::new(&SweepFile::read(&fs::read_to_string(&file).unwrap(), &[]).unwrap());
    let (study, simd) = (study.unwrap(), SimdPath::Portable);
    // It dies twice, with files and lines that nobody has put on the disk.
    for part in [0..4000, 4000..7000] {
        let open = Directory::open(&out, &study, OpenMode::Resume, Some(simd), simd);
        let mut directory = open.unwrap().0;
        assert_eq!(directory.runs().iter().flatten().count(), part.start);
        assert_eq!(directory.findings(), Vec::<String>::new());
        assert_eq!(out.join("looked.json").exists(), part.start > 0, "a note that counts stays");
        for case in &study.cases[part] {
            let result = Ok(made_up(&case.config));
            let record = CaseRecord::new(&study, case, &result, 0.0, "here");
            directory.record(record, result.as_ref().ok()).unwrap();
            directory.sync(false).unwrap();
        }
        let late = Instant::now() + Duration::from_secs(60);
        while !out.join("looked.json").exists() {
            assert!(Instant::now() < late, "nothing is noted");
            std::thread::sleep(Duration::from_millis(20));
            directory.sync(false).unwrap();
        }
    }
    let (file, _) = finished(other.path(), cases);
    again(&file, &out);
    assert!(!out.join("looked.json").exists());
    for folder in ["histories", "envelopes"] {
        let files = fs::read_dir(whole.join(folder)).unwrap();
        let names: Vec<_> = files.map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names.len(), cases);
        assert_eq!(fs::read_dir(out.join(folder)).unwrap().count(), cases);
        for name in names {
            let [one, other] = [&whole, &out].map(|of| fs::read(of.join(folder).join(&name)));
            assert!(one.unwrap() == other.unwrap(), "{folder}/{}", name.display());
        }
    }
    let [one, other] = [&whole, &out].map(|of| fs::read(of.join("energy.csv")).unwrap());
    assert!(one == other);
    expect_code(&seawall().arg("verify").arg(&out).output().unwrap(), 0);
}

/// A case more of a study beyond what a page shows whole takes little more than its row of the summary: a million of
/// them stay far below two gigabytes.
#[test]
fn a_report_holds_little_of_each_case() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    const MOST_PER_CASE: usize = 1_500;
    let root = tempfile::tempdir().unwrap();
    let (_, out) = finished(root.path(), 30);
    let [rows, budgets] = ["summary.csv", "energy.csv"].map(|name| {
        let text = fs::read_to_string(out.join(name)).unwrap();
        let mut lines = text.lines().map(str::to_owned);
        (lines.next().unwrap(), lines.next().unwrap())
    });
    let peak = |cases: usize| {
        for (name, (header, row)) in [("summary.csv", &rows), ("energy.csv", &budgets)] {
            let mut table = BufWriter::new(fs::File::create(out.join(name)).unwrap());
            writeln!(table, "{header}").unwrap();
            let (_, rest) = row.split_once(',').unwrap();
            for case in 0..cases {
                let id = (case as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
                // Every case has a spring of its own.
                let rest = rest.replacen(",10,", &format!(",{},", 10 + case), 1);
                writeln!(table, "{id:016x},{rest}").unwrap();
            }
        }
        let before = HELD.load(Relaxed);
        MOST.store(before, Relaxed);
        seawall::report::write(&out).unwrap();
        MOST.load(Relaxed) - before
    };
    let (few, many) = (peak(21_000), peak(61_000));
    let each = many.saturating_sub(few) / 40_000;
    assert!(each < MOST_PER_CASE, "{each} bytes for each case: {few} and {many}");
    assert!(each > 300, "{each} bytes for each case: the rows are not counted");
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("show 10000 of 61000 cases"));
    assert!(page.contains("10000 of 61000 rows; tables/summary.csv has all"));
    let table = fs::read_to_string(out.join("tables/summary.csv")).unwrap();
    assert_eq!(table.lines().count(), 61_001);
}
