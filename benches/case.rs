//! What a particle costs per step: pair loops, neighbour search, ghosts, the whole step, at four
//! sizes and on every instruction set; and one default case with the memory that it takes.
//!
//! `cargo bench --bench case` prints medians in processor time, as CSV; `scripts/bench` makes
//! tables of them. Compare numbers within one run only.

use std::time::Instant;

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case};

/// Spacings, metres, of a tank of 2.5 m by 0.2 m: about 2,000, 8,000, 32,000, 128,000 particles.
const SPACINGS: [f64; 4] = [0.016, 0.008, 0.004, 0.002];
/// Runs of each, of which the median counts.
const RUNS: usize = 5;

fn main() {
    // Cargo passes --bench, and --test where it only wants to see the program start.
    if std::env::args().any(|word| word == "--test") {
        return;
    }
    println!("simd,particles,quantity,value,unit");
    for path in [SimdPath::Avx512, SimdPath::Avx2, SimdPath::Portable] {
        if !path.is_supported() {
            continue;
        }
        for spacing in SPACINGS {
            if path == SimdPath::Portable && spacing < 0.008 {
                continue; // It would take minutes.
            }
            // A hundred steps or so; the paddle has started by then.
            let case = case("", spacing, Some(12.5 * spacing));
            let runs: Vec<Run> = (0..RUNS).map(|_| Run::of(&case, path)).collect();
            runs[0].print(path, &runs);
        }
    }
    let path = SimdPath::widest();
    let movable =
        "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 250\n";
    let whole = case(movable, 0.008, None);
    let mut seconds: Vec<f64> = (0..3).map(|_| Run::of(&whole, path).seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let particles = 7825;
    println!("{},{particles},default case,{:.2},s", path.name(), seconds[1]);
    if let Some(mebibytes) = peak_memory() {
        println!("{},{particles},peak memory of this program,{mebibytes:.1},MiB", path.name());
    }
}

fn case(scene: &str, spacing: f64, end_time: Option<f64>) -> CaseConfig {
    let end = end_time.map_or(String::new(), |end| format!("end_time_s = {end:e}\n"));
    let scene = format!("wave_height_ratio = 0.5\n{scene}{end}").parse().unwrap();
    let numerics = format!("particle_spacing_m = {spacing}").parse().unwrap();
    CaseConfig::from_tables(&scene, &numerics).unwrap()
}

/// One run: its processor time, and nanoseconds per particle and step of each phase.
struct Run {
    seconds: f64,
    result: CaseResult,
}

impl Run {
    fn of(case: &CaseConfig, path: SimdPath) -> Run {
        let (clock, start) = (processor_time(), Instant::now());
        let result = run_case(case, None, path, &Unwatched).unwrap();
        let seconds = match (clock, processor_time()) {
            (Some(before), Some(after)) => after - before,
            _ => start.elapsed().as_secs_f64(),
        };
        Run { seconds, result }
    }

    fn per_step(&self, seconds: f64) -> f64 {
        let outcome = &self.result.outcome;
        seconds * 1e9 / (outcome.steps as f64 * f64::from(outcome.particles))
    }

    fn print(&self, path: SimdPath, runs: &[Run]) {
        let particles = self.result.outcome.particles;
        let line = |quantity: &str, value: fn(&Run, usize) -> f64, place: usize| {
            let mut values: Vec<f64> = runs.iter().map(|run| value(run, place)).collect();
            values.sort_by(f64::total_cmp);
            let median = values[values.len() / 2];
            println!("{},{particles},{quantity},{median:.1},ns", path.name());
        };
        for (place, phase) in self.result.phases.iter().enumerate() {
            // Phases are told in wall time: their shares of the processor time count.
            let share = |run: &Run, place: usize| {
                let all: f64 = run.result.phases.iter().map(|phase| phase.seconds).sum();
                run.per_step(run.seconds) * run.result.phases[place].seconds / all
            };
            line(&phase.phase, share, place);
        }
        line("whole step", |run, _| run.per_step(run.seconds), 0);
    }
}

/// Processor time of this thread so far, seconds, where the system tells it.
fn processor_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

/// Largest memory of this program so far, MiB, where the system tells it.
fn peak_memory() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}
