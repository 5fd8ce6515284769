//! How many cases a second go through scheduler, workers, journal and summary, where a case costs nothing.
//!
//! `cargo run --release --example load -- DIR CASES [THREADS [WORD...]]` sweeps made-up cases into a new directory
//! below DIR. It reads that again and makes its report. It prints what each part took, on the clock and of
//! processors, and the most memory that was held.
//!
//! `no-report` leaves the report out. `keep` leaves DIR/load and its sweep file DIR/load.toml behind, for
//! `seawall sweep`, `status` and `report`. Where they are there already, it goes on with what is left: of a sweep that
//! was killed it tells after what time the first new case begins.

use std::path::Path;
use std::sync::OnceLock;
use std::time::Instant;

use seawall::execute::fake::cost;
use seawall::execute::{
    Ending, Interrupt, Progress, ProgressStyle, Runner, Session, Setup, coordinate, threads,
};
use seawall::math::simd::SimdPath;
use seawall::math::words::counted;
use seawall::results::{Directory, Manifest, OpenMode, Opened, made_up};
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Monitor, Stopped, TrunkResult};
use seawall::study::{Plan, Study, SweepFile};

const SIMD: SimdPath = SimdPath::Portable;

/// When the first case began.
static FIRST: OnceLock<Instant> = OnceLock::new();

/// Every case ends at once, and all alike.
struct Same(CaseResult);

impl Runner for Same {
    fn trunk(&self, _: &CaseConfig, _: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        Ok(TrunkResult { checkpoint: vec![0; 10_000], time_s: 1.0, steps: 500 })
    }

    fn case(
        &self,
        _: &CaseConfig,
        _: Option<&[u8]>,
        _: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        FIRST.get_or_init(Instant::now);
        Ok(self.0.clone())
    }
}

fn file(cases: usize) -> String {
    format!(
        "name = \"load\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\nwave_height_ratio = [0.2, 0.3, 0.4, 0.5]\n\
         spring_stiffness_n_per_m = {{ from = 10, to = 1e6, points = {}, spacing = \"log\" }}",
        cases.div_ceil(4)
    )
}

fn sweep(out: &Path, study: &Study, count: usize) {
    let interrupt = Interrupt::default();
    let setup = Setup {
        make_runner: &|_| Box::new(Same(made_up(&study.cases[0].config))),
        threads: Some(count),
        interrupt: &interrupt,
        patience: std::time::Duration::MAX,
    };
    threads::with_crew(&setup, |crew| {
        let (mut directory, _) =
            Directory::open(out, study, OpenMode::Resume, Some(SIMD), SIMD).unwrap();
        let missing = |index: usize| directory.runs()[index].is_none();
        let plan = Plan::new(study, true, cost, missing);
        let ranks = crew.ranks().to_vec();
        crew.work(SIMD, out, &mut |link| {
            let mut session = Session {
                study,
                plan: &plan,
                directory: &mut directory,
                ranks: &ranks,
                interrupt: &interrupt,
                progress: Progress::new(ProgressStyle::Quiet, Default::default()),
            };
            let worked = coordinate(link, &mut session)?;
            assert_eq!(worked.ending, Ending::Finished);
            Ok(())
        })
        .unwrap();
    });
}

/// The most memory that this process has held, MB.
fn memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1e3
}

/// The processor time that this process has taken, seconds.
fn processor_time_s() -> f64 {
    let told = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = told.rsplit(')').next().unwrap_or_default().split_whitespace();
    let ticks = fields.skip(11).take(2).filter_map(|field| field.parse::<f64>().ok());
    ticks.sum::<f64>() / 100.0
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [below, cases, rest @ ..] = &words[..] else {
        panic!("load DIR CASES [THREADS [no-report] [keep]]")
    };
    let count = rest.first().map_or(2, |word| word.parse().unwrap());
    let asked = |what: &str| rest.iter().any(|word| word == what);
    let room = tempfile::tempdir_in(below).unwrap();
    let out = if asked("keep") { Path::new(below) } else { room.path() }.join("load");
    let kept = std::fs::read_to_string(out.with_extension("toml"));
    let text = kept.unwrap_or_else(|_| file(cases.parse().unwrap()));
    assert_eq!(text, file(cases.parse().unwrap()), "DIR holds a sweep of other cases");
    std::fs::write(out.with_extension("toml"), &text).unwrap();
    let mut before = 0.0;
    let mut tell = |what: &str, start: Instant| {
        let (wall, processor) = (start.elapsed().as_secs_f64(), processor_time_s() - before);
        before += processor;
        println!("{what}: {wall:.2} s, {processor:.2} s of processors, {:.0} MB", memory_mb());
    };
    let start = Instant::now();
    let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
    tell(&format!("study of {}", counted(study.cases.len(), "case")), start);
    if !out.join("summary.csv").exists() {
        let anew = !out.exists();
        let start = Instant::now();
        sweep(&out, &study, count);
        tell("sweep", start);
        let first = FIRST.get().map_or(0.0, |first| (*first - start).as_secs_f64());
        println!("the first case began after {first:.2} s");
        if anew {
            let rate = study.cases.len() as f64 / start.elapsed().as_secs_f64();
            println!("{rate:.0} cases per second on {}", counted(count, "thread"));
        }
    }
    let start = Instant::now();
    let (directory, opened) = Directory::open(&out, &study, OpenMode::Resume, None, SIMD).unwrap();
    tell("reopening", start);
    assert_eq!(opened, Opened::Resumed(study.cases.len()));
    Manifest::new(&out, &study, &[], SIMD).write(&out).unwrap();
    drop((directory, study));
    if asked("no-report") {
        return;
    }
    let start = Instant::now();
    seawall::report::write(&out).unwrap();
    tell("report", start);
}
