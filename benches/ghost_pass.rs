//! Cost of every boundary interpolator: the ghost pass alone, and as a part of whole steps.
//!
//! `cargo bench --bench ghost_pass` (with `-- --brief` at 8,000 particles alone) prints
//! comma-separated tables; compare numbers within one run only. The pass alone is lists at hand, water at rest: weights, filling and new velocities, per
//! ghost that has water in reach. In whole cases it comes with wetness and moving water.

use std::time::Instant;

use seawall::body::BodyMotion;
use seawall::boundary::{
    BoundaryChoice, Exchange, ExchangeRules, GhostGravity, InterpolatorChoice, TankLayout, Water,
    tank_ghosts,
};
use seawall::kernel::KernelChoice;
use seawall::keys::Shape;
use seawall::math::simd::SimdPath;
use seawall::math::team::thread_processor_time;
use seawall::pairs::Strips;
use seawall::pairs::{Factors, Flow, Fluid, Record, Scaling};
use seawall::scene::{CaseConfig, Numerics, Preset};
use seawall::simulation::{Unwatched, run_case};

/// Spacings, metres, of a tank of 2.5 m by 0.2 m: about 2,000, 8,000, 32,000 and 128,000 particles.
const SPACINGS: [f64; 4] = [0.016, 0.008, 0.004, 0.002];
const ROUNDS: usize = 5;

fn main() {
    // Cargo passes --bench, and --test where it only wants to see the program start.
    if std::env::args().any(|word| word == "--test") {
        return;
    }
    let brief = std::env::args().any(|word| word == "--brief");
    let spacings = if brief { &SPACINGS[1..2] } else { &SPACINGS[..] };
    let boundaries = boundaries();
    println!(
        "table,boundary,particles,ns_per_ghost,us_per_step_ghosts,us_per_step_total,ghosts_percent"
    );
    for &spacing in spacings {
        // In turns, so that what else the machine does meets all of them.
        let mut alone = vec![Vec::new(); boundaries.len()];
        for _ in 0..ROUNDS {
            for (boundary, times) in boundaries.iter().zip(&mut alone) {
                times.push(ghost_pass(interpolator(boundary), spacing));
            }
        }
        for (boundary, times) in boundaries.iter().zip(alone) {
            let particles = (2.5 / spacing).round() * (0.2 / spacing).round();
            println!("ghost_pass,{boundary},{particles},{:.1},,,", median(times));
        }
    }
    for &spacing in spacings {
        let mut whole = vec![(Vec::new(), Vec::new()); boundaries.len()];
        let mut particles = 0;
        for _ in 0..3 {
            for (boundary, (ghosts, total)) in boundaries.iter().zip(&mut whole) {
                let [a, b, count] = step(boundary, spacing);
                ghosts.push(a);
                total.push(b);
                particles = count as u32;
            }
        }
        for (boundary, (ghosts, total)) in boundaries.iter().zip(whole) {
            let (ghosts, total) = (median(ghosts), median(total));
            let share = 100.0 * ghosts / total;
            println!("step,{boundary},{particles},,{ghosts:.1},{total:.1},{share:.2}");
        }
    }
}

/// The names of all interpolators.
fn boundaries() -> &'static [&'static str] {
    match Shape::of::<BoundaryChoice>() {
        Shape::Names(names) => names,
        other => unreachable!("{other:?} is no choice"),
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn numerics(boundary: &str, spacing: f64) -> toml::Table {
    format!("particle_spacing_m = {spacing}\nboundary = \"{boundary}\"").parse().unwrap()
}

fn interpolator(boundary: &str) -> InterpolatorChoice {
    let choice = serde_json::from_value(boundary.into()).unwrap();
    Numerics { boundary: choice, ..Numerics::preset(Preset::Default) }.interpolator()
}

/// Nanoseconds per ghost with water in reach: the fastest of many passes, each shorter than a
/// scheduler's slice, so that other load is left out.
fn ghost_pass(interpolator: InterpolatorChoice, spacing: f64) -> f64 {
    let (path, kernel, radius) = (SimdPath::widest(), KernelChoice::WendlandC2, 4.0 * spacing);
    let (strip, scaling) = (3.0 * spacing, Scaling::new(kernel, radius));
    let layout = TankLayout {
        length: 2.5,
        spacing_x: spacing,
        spacing_y: spacing,
        support_radius: radius,
        wall_height: 0.8,
        bed_beyond_wall: 2.4,
        bed_before_paddle: 0.0,
        crest: None,
        wall_angle_deg: 90.0,
        still_level: f64::INFINITY,
        dry_bed: false,
    };
    let (columns, rows) = ((2.5 / spacing).round() as u32, (0.2 / spacing).round() as u32);
    // A lattice put a little out of order.
    let at = |k: u32, factor: f64| 0.4 * (f64::from(k) * factor).fract() + 0.3;
    let points = (0..columns * rows).map(|k| {
        let (column, row) = (f64::from(k / rows), f64::from(k % rows));
        let (x, y) = (column + at(k, 0.618_034), row + at(k, 0.754_878));
        [x * spacing, y * spacing, 1000.0, 1000.0 * spacing * spacing]
    });
    let mut fluid = Fluid::at_rest(points);
    let len = fluid.len();
    let (strips, order) = Strips::sort(&fluid.x[..len], &fluid.y[..len], &fluid.id, strip);
    fluid.reorder(&order, &mut Vec::new());
    let inverse = scaling.inverse_radius;
    let weight = spacing * spacing * scaling.weight_per_volume;
    let water: Vec<Record> = fluid
        .x
        .iter()
        .zip(&fluid.y)
        .map(|(x, y)| Record([x * inverse, y * inverse, 0.1, 0.1, weight, 0.0, 0.0, 0.0]))
        .collect();
    let pressure: Vec<f64> = fluid.y.iter().map(|y| 9810.0 * (0.2 - y)).collect();
    let (ones, tenths) = (vec![1.0; fluid.padded_len()], vec![0.1; fluid.padded_len()]);
    let rules = ExchangeRules {
        kernel,
        interpolator,
        scaling,
        spacing,
        gravity: 9.81,
        surface_density: 1000.0,
        sound_speed: 11.2,
        ghost_gravity: GhostGravity::InSum,
        no_slip: false,
        bed_between_walls: true,
        conservative_bed: false,
        conservative_crest: false,
    };
    let ghosts = tank_ghosts(&layout, None, strip);
    let bodies = [BodyMotion::default(); 3];
    let mut exchange = Exchange::new(rules, &ghosts);
    let places = (&strips, &fluid.x[..len], &fluid.y[..len]);
    exchange.rebuild(path, &ghosts, &bodies, places, 1.15 * radius);
    let read = Water {
        records: &water,
        pressure: &pressure,
        correction: Some([&ones; 3]),
        acceleration: [&ones; 2],
    };
    let mut records = vec![Record::default(); ghosts.len()];
    let mut numbers = vec![Factors::default(); ghosts.len()];
    let flow = Flow { corrected: true, strained: false, diffusing: true, sharing: false };
    let mut pass = || {
        exchange.weigh(path, &ghosts, &bodies, read);
        exchange.fill(path, &ghosts, &bodies, 2, &mut records);
        let velocities = [&tenths[..], &tenths];
        exchange.refresh_velocities(path, &ghosts, &bodies, velocities, (flow, &mut numbers));
    };
    pass();
    let mut seconds = f64::INFINITY;
    for _ in 0..(0.4 / spacing) as u32 {
        let start = Instant::now();
        pass();
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    let wet = records.iter().filter(|record| record.0[Record::WEIGHT] != 0.0).count();
    1e9 * seconds / wet as f64
}

/// Microseconds per step in the ghost pass and in all of a wave case, and its particles. At the two
/// finer spacings some fifty steps are enough.
fn step(boundary: &str, spacing: f64) -> [f64; 3] {
    let end = if spacing < 0.008 { 6.25 * spacing } else { 0.1 };
    let scene = format!("wave_height_ratio = 0.5\nend_time_s = {end}").parse().unwrap();
    let case = CaseConfig::from_tables(&scene, &numerics(boundary, spacing)).unwrap();
    let start = processor_seconds();
    let result = run_case(&case, None, SimdPath::widest(), &Unwatched).unwrap();
    let total = processor_seconds() - start;
    // The phases are wall time: their shares are what other load leaves as it is.
    let phases = |ghosts: bool| -> f64 {
        let phases = result.phases.iter().filter(|p| !ghosts || p.phase == "ghosts");
        phases.map(|p| p.seconds).sum()
    };
    let ghosts = total * phases(true) / phases(false);
    let per_step = 1e6 / result.outcome.steps as f64;
    [ghosts * per_step, total * per_step, f64::from(result.outcome.particles)]
}

/// Processor time of this thread where the system tells it, wall time elsewhere.
fn processor_seconds() -> f64 {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    thread_processor_time()
        .unwrap_or_else(|| START.get_or_init(Instant::now).elapsed().as_secs_f64())
}
