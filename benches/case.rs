//! Time per particle and step of whole coarse and fine cases, on every instruction set there is.
//!
//! `cargo bench`: a plain program that prints medians; compare numbers within one run only.

use std::time::Instant;

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{Unwatched, run_case};

/// Spacings, metres, of a tank of 2.5 m by 0.2 m: about 2,000, 8,000 and 32,000 particles.
const SPACINGS: [f64; 3] = [0.016, 0.008, 0.004];

fn main() {
    // Cargo passes --bench, and --test where it only wants to see the program start.
    if std::env::args().any(|word| word == "--test") {
        return;
    }
    for path in [SimdPath::Avx512, SimdPath::Avx2] {
        if !path.is_supported() {
            continue;
        }
        for spacing in SPACINGS {
            let scene = "wave_height_ratio = 0.5\nend_time_s = 0.1".parse().unwrap();
            let numerics = format!("particle_spacing_m = {spacing}").parse().unwrap();
            let case = CaseConfig::from_tables(&scene, &numerics).unwrap();
            let mut times: Vec<f64> = (0..5).map(|_| nanoseconds(&case, path)).collect();
            times.sort_by(f64::total_cmp);
            println!("{} dx {spacing} m: {:.0} ns per particle and step", path.name(), times[2]);
        }
    }
}

fn nanoseconds(case: &CaseConfig, path: SimdPath) -> f64 {
    let start = Instant::now();
    let outcome = run_case(case, None, path, &Unwatched).unwrap().outcome;
    let work = outcome.steps as f64 * f64::from(outcome.particles);
    start.elapsed().as_secs_f64() * 1e9 / work
}
