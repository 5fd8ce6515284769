//! A step takes no memory: all that it needs is there once the first lists have been made.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, Ordering};

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{Unwatched, run_case};

static COUNT: AtomicU64 = AtomicU64::new(0);

struct Counting;

// SAFETY: all work is the system's.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        unsafe { System.dealloc(place, layout) }
    }
    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations and steps of a run with two samples of its history, one at each end.
fn run(end_time_s: f64, numerics: &str) -> (u64, u64) {
    let scene = format!(
        "wave_height_ratio = 0.5\ntank_length_m = 1.6\nwave_gauge_m = 0.8\n\
         wall = \"movable\"\nspring_stiffness_n_per_m = 100\nseawall_mass_kg_per_m = 50\n\
         end_time_s = {end_time_s}\nhistory_interval_s = 10\n"
    );
    let table = |text: &str| text.parse().unwrap();
    let case = CaseConfig::from_tables(&table(&scene), &table(numerics));
    let before = COUNT.load(Ordering::Relaxed);
    let result = run_case(&case.unwrap(), None, SimdPath::widest(), &Unwatched).unwrap();
    (COUNT.load(Ordering::Relaxed) - before, result.outcome.steps)
}

/// Half of these steps more cost at most a handful of growing arrays (the longest list so far),
/// not one allocation per step or per rebuild of the lists.
fn check(numerics: &str, most: u64) {
    let (few, fewer_steps) = run(0.9, numerics);
    let (more, more_steps) = run(1.8, numerics);
    let (steps, taken) = (more_steps - fewer_steps, more.saturating_sub(few));
    assert!(steps > 100, "{steps}");
    assert!(taken <= most, "{numerics}: {taken} allocations in {steps} steps");
}

#[test]
fn steps_take_no_memory() {
    check("particle_spacing_m = 0.02", 8);
    check("particle_spacing_m = 0.02\nscheme = \"isph\"", 40);
}
