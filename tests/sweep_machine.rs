//! The sweep around made-up physics: the same bits for any number of threads, with and without
//! branches, after failures and interrupts.

mod common;

use std::path::Path;
use std::time::Duration;

use seawall::execute::fake::{FakeRunner, Fate, cost};
use seawall::execute::{
    Ending, Interrupt, Progress, ProgressStyle, Session, Setup, Worked, coordinate, threads,
};
use seawall::math::simd::SimdPath;
use seawall::results::{Directory, OpenMode, Savings};
use seawall::simulation::FailureKind;
use seawall::study::{Plan, Study, SweepFile};

const GRID: &str = r#"
name = "fake"
[scene]
wall = "movable"
[grid]
wave_height_ratio = [0.2, 0.3, 0.4]
spring_stiffness_n_per_m = [0, 10, 1e7]
seawall_mass_kg_per_m = [50, 100]
"#;

fn study(text: &str) -> Study {
    Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap()
}

struct Run {
    runner: FakeRunner,
    threads: usize,
    branching: bool,
    interrupt: Interrupt,
}

impl Default for Run {
    fn default() -> Run {
        Run {
            runner: FakeRunner::default(),
            threads: 2,
            branching: true,
            interrupt: Interrupt::default(),
        }
    }
}

fn sweep(out: &Path, study: &Study, run: &Run) -> (Ending, Savings) {
    let runner = run.runner;
    let setup = Setup {
        make_runner: &|_| Box::new(runner),
        threads: Some(run.threads),
        interrupt: &run.interrupt,
        patience: std::time::Duration::MAX,
    };
    threads::with_crew(&setup, |crew| {
        let simd = SimdPath::Portable;
        let (mut directory, _) =
            Directory::open(out, study, OpenMode::Resume, Some(simd), simd).unwrap();
        let plan = Plan::new(study, run.branching, cost, |index| directory.runs()[index].is_none());
        let ranks = crew.ranks().to_vec();
        let mut ended = None;
        crew.work(simd, out, &mut |link| {
            let mut session = Session {
                study,
                plan: &plan,
                directory: &mut directory,
                ranks: &ranks,
                interrupt: &run.interrupt,
                progress: Progress::new(ProgressStyle::Quiet, Default::default()),
            };
            ended = Some(coordinate(link, &mut session)?);
            Ok(())
        })
        .unwrap();
        let worked: Worked = ended.unwrap();
        (worked.ending, worked.savings)
    })
}

#[test]
fn threads_and_branches_do_not_change_a_bit() {
    let root = tempfile::tempdir().unwrap();
    let (reference, study) = (root.path().join("reference"), study(GRID));
    let (ending, savings) = sweep(&reference, &study, &Run { threads: 1, ..Run::default() });
    assert_eq!(ending, Ending::Finished);
    assert_eq!(savings.steps_from_rest, 18 * 1000);
    assert_eq!(savings.steps_computed, 3 * 500 + 18 * 500);
    for threads in [2, 4] {
        for branching in [true, false] {
            let out = root.path().join(format!("{threads}-{branching}"));
            sweep(&out, &study, &Run { threads, branching, ..Run::default() });
            common::assert_same(&reference, &out);
        }
    }
}

#[test]
fn a_failed_trunk_leaves_its_cases_to_run_from_rest() {
    let root = tempfile::tempdir().unwrap();
    let (reference, out, study) =
        (root.path().join("reference"), root.path().join("out"), study(GRID));
    sweep(&reference, &study, &Run::default());
    let runner = FakeRunner { trunks_fail: true, ..FakeRunner::default() };
    let (_, savings) = sweep(&out, &study, &Run { runner, ..Run::default() });
    assert_eq!((savings.trunks, savings.branches), (0, 0));
    common::assert_same(&reference, &out);
}

#[test]
fn failures_and_panics_are_rows_like_any_other() {
    let root = tempfile::tempdir().unwrap();
    let text = GRID.replace("[grid]", "[grid]\nforce_coupling = [0.5, 1.0, 2.0]");
    let study = study(&text);
    let fate = |config: &seawall::scene::CaseConfig| {
        let scene = config.scene.seawall().unwrap();
        match scene.force_coupling {
            0.5 => Fate::Fails,
            2.0 => Fate::Panics,
            _ => Fate::Well,
        }
    };
    let runner = FakeRunner { fate, ..FakeRunner::default() };
    sweep(root.path(), &study, &Run { runner, ..Run::default() });
    let records = seawall::results::read_journal(root.path()).unwrap().records;
    let count = |kind| records.iter().filter(|record| record.failure == kind).count();
    assert_eq!(count(None), 18);
    assert_eq!(count(Some(FailureKind::RunawaySpeed)), 18);
    assert_eq!(count(Some(FailureKind::Internal)), 18);
    assert!(records.iter().all(|record| !record.reason.contains('\n')));
}

#[test]
fn an_interrupted_sweep_goes_on_to_the_same_bits() {
    let root = tempfile::tempdir().unwrap();
    let text = GRID.replace("[grid]", "[numerics]\nerror_bars = \"triple\"\n[grid]");
    let (reference, out, study) =
        (root.path().join("reference"), root.path().join("out"), study(&text));
    sweep(&reference, &study, &Run::default());
    let runner = FakeRunner { delay: Duration::from_millis(15), ..FakeRunner::default() };
    let mut sessions = 0;
    loop {
        sessions += 1;
        assert!(sessions < 100, "every session gets somewhere");
        let run = Run { runner, ..Run::default() };
        let interrupt = run.interrupt.clone();
        let alarm = std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(70));
            interrupt.raise();
        });
        let (ending, _) = sweep(&out, &study, &run);
        alarm.join().unwrap();
        if ending == Ending::Finished {
            break;
        }
    }
    assert!(sessions > 1);
    common::assert_same(&reference, &out);
}

#[test]
fn companions_fill_the_error_bars_and_nothing_else() {
    let root = tempfile::tempdir().unwrap();
    let (plain, barred) = (root.path().join("plain"), root.path().join("barred"));
    let paired = study(&GRID.replace("[grid]", "[numerics]\nerror_bars = \"pair\"\n[grid]"));
    sweep(&plain, &study(GRID), &Run::default());
    let (ending, savings) = sweep(&barred, &paired, &Run::default());
    assert_eq!(ending, Ending::Finished);
    assert_eq!((savings.trunks, savings.branches), (6, 36), "companions have trunks of their own");
    let (cells, bars) = (summary(&plain), summary(&barred));
    assert_eq!((cells.len(), bars.len()), (18, 18));
    for (without, with) in cells.iter().zip(&bars) {
        for (name, cell) in with {
            // The stand-in has neither runup nor moment of a first impact: no bars of them.
            let bars = ["force_error", "displacement_error", "force_max_error"];
            let whole = ["runup_max_error", "moment_max_error"];
            if bars.iter().chain(&whole).any(|bar| bar == name) {
                assert!(cell.parse::<f64>().unwrap() > 0.0 && without[name].is_empty(), "{name}");
            } else if name != "wall_time_s" {
                assert_eq!(cell, &without[name], "{name}");
            }
        }
    }
    let files = |out: &Path| std::fs::read_dir(out.join("histories")).unwrap().count();
    assert_eq!(files(&barred), files(&plain));
    // A finished directory takes its companions later, and ends up the same.
    let (ending, savings) = sweep(&plain, &paired, &Run::default());
    assert_eq!((ending, savings.branches), (Ending::Finished, 18));
    common::assert_same(&plain, &barred);
}

fn summary(out: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}
