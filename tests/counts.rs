//! What a run costs, counted: steps, pairs, lists, memory. Counts do not depend on the machine or on
//! what else it does, so they stand in for timings in continuous integration.
//!
//! A change that moves a count is a change of speed: say so with the commit, and put the new counts
//! from the failing test's message in place of the old.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Unwatched, run_case};

static COUNT: AtomicU64 = AtomicU64::new(0);
/// Tests that count what all threads allocate take turns.
static TURN: Mutex<()> = Mutex::new(());

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

/// A movable wall in a short, coarse tank; its history is sampled twice, at both ends.
fn run(end_time_s: f64, numerics: &str, path: SimdPath) -> CaseResult {
    let scene = format!(
        "wave_height_ratio = 0.5\ntank_length_m = 1.6\nwave_gauge_m = 0.8\n\
         wall = \"movable\"\nspring_stiffness_n_per_m = 100\nseawall_mass_kg_per_m = 50\n\
         end_time_s = {end_time_s}\nhistory_interval_s = 10\n"
    );
    let table = |text: &str| text.parse().unwrap();
    let case = CaseConfig::from_tables(&table(&scene), &table(numerics));
    run_case(&case.unwrap(), None, path, &Unwatched).unwrap()
}

/// Allocations and steps of a run.
fn allocations(end_time_s: f64, numerics: &str) -> (u64, u64) {
    let before = COUNT.load(Ordering::Relaxed);
    let result = run(end_time_s, numerics, SimdPath::widest());
    (COUNT.load(Ordering::Relaxed) - before, result.outcome.steps)
}

/// Half of these steps more cost at most a handful of growing arrays (the longest list so far),
/// not one allocation per step or per rebuild of the lists.
fn check(numerics: &str, most: u64) {
    let (few, fewer_steps) = allocations(0.9, numerics);
    let (more, more_steps) = allocations(1.8, numerics);
    let (steps, taken) = (more_steps - fewer_steps, more.saturating_sub(few));
    assert!(steps > 100, "{steps}");
    assert!(taken <= most, "{numerics}: {taken} allocations in {steps} steps");
}

#[test]
fn steps_take_no_memory() {
    let _turn = TURN.lock();
    check("particle_spacing_m = 0.02", 8);
    check("particle_spacing_m = 0.02\nscheme = \"isph\"", 40);
}

/// Steps, pairs evaluated and rebuilds of the lists, until the wave stands at the wall.
#[test]
fn a_small_case_takes_the_work_it_took_before() {
    const STEPS: u64 = 561;
    const PAIR_EVALUATIONS: u64 = 95_445_744;
    const LIST_REBUILDS: u64 = 50;
    let path = SimdPath::widest();
    if path == SimdPath::Portable {
        return; // Rounded otherwise, a pair at the edge of the support may count or not.
    }
    let _turn = TURN.lock();
    let result = run(1.8, "particle_spacing_m = 0.02", path);
    let outcome = &result.outcome;
    assert_eq!(
        (outcome.steps, outcome.pair_evaluations, result.list_rebuilds),
        (STEPS, PAIR_EVALUATIONS, LIST_REBUILDS),
        "steps, pair evaluations, list rebuilds"
    );
}
