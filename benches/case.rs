//! What a particle costs per step: pair loops, neighbour search, ghosts, the whole step, at four
//! sizes, on every instruction set and in both precisions of pair terms; one default case with the
//! memory that it takes; allocations per step; the core's clock, to tell times in cycles.
//!
//! `cargo bench --bench case` prints medians in processor time, as CSV, and the best of whole steps
//! and cases: what the machine gives when nothing else shares it. `scripts/bench` makes tables of
//! them. Compare numbers within one run only.

use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use seawall::math::name::name_of;
use seawall::math::simd::SimdPath;
use seawall::math::team::thread_processor_time;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case};

/// Spacings, metres, of a tank of 2.5 m by 0.2 m (about 2,000, 8,000, 32,000, 128,000 particles),
/// and how many runs of each: the median counts.
const SIZES: [(f64, usize); 4] = [(0.016, 15), (0.008, 15), (0.004, 5), (0.002, 3)];
const MOVABLE: &str =
    "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 250\n";
const PRECISIONS: [&str; 2] = ["f64", "f32"];
/// How many default cases are run in each precision, in turns.
const ALONE_RUNS: usize = 5;
/// Turns of a chain that tells the clock, a tenth of a millisecond or two, and how many such chains.
const CHAIN: u64 = 100_000;
const CHAINS: u32 = 50;
/// How often the clock is told after every size.
const CLOCK_RUNS: usize = 9;
/// Asks this program to run one default case in a precision and to tell its time and memory.
const ALONE: &str = "--default-case=";

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

struct Counting;

// SAFETY: all work is the system's.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.dealloc(place, layout) }
    }
    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn main() {
    // Cargo passes --bench, and --test where it only wants to see the program start.
    if std::env::args().any(|word| word == "--test") {
        return;
    }
    let widest = SimdPath::widest();
    let alone = std::env::args().find_map(|word| word.strip_prefix(ALONE).map(str::to_owned));
    if let Some(precision) = alone {
        let run = Run::of(&case(MOVABLE, 0.008, None, &precision), widest);
        println!("{},{}", run.seconds, peak_memory().unwrap_or(f64::NAN));
        return;
    }
    println!("simd,precision,particles,quantity,value,unit");
    // After every size, as the clock of a machine goes with its load and with what it computes.
    let mut clocks: Vec<f64> = Vec::new();
    for path in [SimdPath::Avx512, SimdPath::Avx2, SimdPath::Portable] {
        if !path.is_supported() {
            continue;
        }
        for (spacing, count) in SIZES {
            if path == SimdPath::Portable && spacing < 0.008 {
                continue; // It would take minutes.
            }
            // Two hundred steps or so, in which the paddle starts: with fewer the set-up, and memory
            // touched for the first time, would count as much as steps do. Precisions in turns, so that
            // what else the machine does meets both.
            let cases = PRECISIONS.map(|p| case("", spacing, Some(37.5 * spacing), p));
            let mut runs: [Vec<Run>; 2] = Default::default();
            for _ in 0..count {
                for (case, runs) in cases.iter().zip(&mut runs) {
                    runs.push(Run::of(case, path));
                }
            }
            for (precision, runs) in PRECISIONS.iter().zip(&runs) {
                runs[0].print(path, precision, runs);
            }
            if path == widest {
                clocks.extend((0..CLOCK_RUNS).map(|_| core_clock()));
            }
        }
    }
    let path = name_of(widest);
    let mut told: [Vec<[f64; 2]>; 2] = Default::default();
    for _ in 0..ALONE_RUNS {
        for (precision, told) in PRECISIONS.iter().zip(&mut told) {
            told.push(alone_in_a_process(precision));
        }
    }
    for (precision, told) in PRECISIONS.iter().zip(&mut told) {
        told.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let [seconds, mebibytes] = told[ALONE_RUNS / 2];
        println!("{path},{precision},7825,default case,{seconds:.2},s");
        println!("{path},{precision},7825,best default case,{:.2},s", told[0][0]);
        println!("{path},{precision},7825,peak memory,{mebibytes:.1},MiB");
    }
    clocks.sort_by(f64::total_cmp);
    println!("{path},,,core clock,{:.0},MHz", clocks[clocks.len() / 2]);
    println!("{path},,,best core clock,{:.0},MHz", clocks[clocks.len() - 1]);
    let allocations = |end: f64| {
        let before = ALLOCATIONS.load(Ordering::Relaxed);
        let run = Run::of(&case(MOVABLE, 0.016, Some(end), "f64"), widest);
        (ALLOCATIONS.load(Ordering::Relaxed) - before, run.result.outcome.steps)
    };
    let ((few, fewer), (more, steps)) = (allocations(1.0), allocations(2.0));
    let per_step = more.saturating_sub(few) as f64 / (steps - fewer) as f64;
    println!("{path},f64,2028,allocations per step (history on),{per_step:.4},");
}

/// MHz of the core at this moment: three shifts and three exclusive ors, each of which waits for the
/// one before and takes one cycle. By wall time, as processor time is told too coarsely; so chains are
/// shorter than a scheduler's slice, and the fastest of them leaves other load out.
fn core_clock() -> f64 {
    let mut seconds = f64::INFINITY;
    let mut state = black_box(0x9e37_79b9_7f4a_7c15_u64);
    for _ in 0..CHAINS {
        let start = Instant::now();
        for _ in 0..CHAIN {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
        }
        state = black_box(state);
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    6.0 * CHAIN as f64 * 1e-6 / seconds
}

/// Seconds and MiB of one default case in a process of its own.
fn alone_in_a_process(precision: &str) -> [f64; 2] {
    let program = std::env::current_exe().unwrap();
    let output = Command::new(program).arg(format!("{ALONE}{precision}")).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let (seconds, mebibytes) = text.trim().split_once(',').expect("a time and a size");
    [seconds.parse().unwrap(), mebibytes.parse().unwrap()]
}

fn case(scene: &str, spacing: f64, end_time: Option<f64>, precision: &str) -> CaseConfig {
    let end = end_time.map_or(String::new(), |end| format!("end_time_s = {end:e}\n"));
    let scene = format!("wave_height_ratio = 0.5\n{scene}{end}").parse().unwrap();
    let numerics =
        format!("particle_spacing_m = {spacing}\nprecision = \"{precision}\"").parse().unwrap();
    CaseConfig::from_tables(&scene, &numerics).unwrap()
}

/// One run: its processor time, and nanoseconds per particle and step of each phase.
struct Run {
    seconds: f64,
    result: CaseResult,
}

impl Run {
    fn of(case: &CaseConfig, path: SimdPath) -> Run {
        let (clock, start) = (thread_processor_time(), Instant::now());
        let result = run_case(case, None, path, &Unwatched).unwrap();
        let seconds = match (clock, thread_processor_time()) {
            (Some(before), Some(after)) => after - before,
            _ => start.elapsed().as_secs_f64(),
        };
        Run { seconds, result }
    }

    fn per_step(&self, seconds: f64) -> f64 {
        let outcome = &self.result.outcome;
        seconds * 1e9 / (outcome.steps as f64 * f64::from(outcome.particles))
    }

    fn print(&self, path: SimdPath, precision: &str, runs: &[Run]) {
        let particles = self.result.outcome.particles;
        let sorted = |value: &dyn Fn(&Run) -> f64| {
            let mut values: Vec<f64> = runs.iter().map(value).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let tell = |quantity: &str, value: f64| {
            println!("{},{precision},{particles},{quantity},{value:.1},ns", name_of(path));
        };
        let median = |values: &[f64]| values[values.len() / 2];
        for (place, phase) in self.result.phases.iter().enumerate() {
            // Phases are told in wall time: their shares of the processor time count.
            let share = |run: &Run| {
                let all: f64 = run.result.phases.iter().map(|phase| phase.seconds).sum();
                run.per_step(run.seconds) * run.result.phases[place].seconds / all
            };
            tell(&phase.phase, median(&sorted(&share)));
        }
        let whole = sorted(&|run| run.per_step(run.seconds));
        tell("best step", whole[0]);
        tell("whole step", median(&whole));
    }
}

/// Largest memory of this program so far, MiB, where the system tells it.
fn peak_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}
