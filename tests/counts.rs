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
use seawall::simulation::{CaseResult, Resources, Unwatched, run_case};

static COUNT: AtomicU64 = AtomicU64::new(0);
/// Tests that count what all threads allocate take turns.
static TURN: Mutex<()> = Mutex::new(());

struct Counting;

// SAFETY: all work is the system's.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.dealloc(place, layout) }
    }
    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise is passed on as it is.
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A wave in a short tank before a movable wall.
const WAVE: &str = "wave_height_ratio = 0.5\ntank_length_m = 1.6\nwave_gauge_m = 0.8\n\
                    wall = \"movable\"\nspring_stiffness_n_per_m = 100\n\
                    seawall_mass_kg_per_m = 50\n";
/// A column that falls beside gauges of every kind.
const DAM: &str = "kind = \"dam-break\"\n";
const GAUGES: &str = "[[probe]]\nname = \"foot\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = 0.05\n\
                      [[probe]]\nname = \"level\"\nkind = \"level\"\nx_m = 0.3\n\
                      [[probe]]\nname = \"void\"\nkind = \"void\"\nwall = \"right\"\n";

fn run(scene: &str, numerics: &str, end_time_s: f64, resources: Resources) -> CaseResult {
    let table = |text: &str| text.parse::<toml::Table>().unwrap();
    let gauges = match scene {
        DAM => table(GAUGES)["probe"].clone().try_into::<Vec<_>>().unwrap(),
        _ => Vec::new(),
    };
    let scene = table(&format!("end_time_s = {end_time_s}\n{scene}"));
    let case = CaseConfig::with_probes(&scene, &table(numerics), &gauges).unwrap();
    run_case(&case, None, resources, &Unwatched).unwrap()
}

/// Twice as many steps cost nothing, or at most a handful of arrays that grow (the longest list so far):
/// not one allocation per step, per sample or per rebuild of the lists.
fn check(scene: &str, numerics: &str, end_time_s: f64, (threads, most): (usize, u64)) {
    let allocations = |end_time_s: f64| {
        let before = COUNT.load(Ordering::Relaxed);
        let resources = Resources { simd: SimdPath::widest(), threads };
        let result = run(scene, numerics, end_time_s, resources);
        (COUNT.load(Ordering::Relaxed) - before, result.outcome.steps, result.history.len() as u64)
    };
    let twice_as_long = || {
        let (few, fewer_steps, fewer_samples) = allocations(end_time_s);
        let (more, more_steps, more_samples) = allocations(2.0 * end_time_s);
        let (steps, samples) = (more_steps - fewer_steps, more_samples - fewer_samples);
        assert!(steps > 2 * most && samples > most, "{numerics}: {steps} steps, {samples} samples");
        (more.saturating_sub(few), steps, samples)
    };
    let mut found = twice_as_long();
    if threads > 1 && found.0 > most {
        // The pool's queue grows where the machine does other work as well: not in the same way twice.
        found = found.min(twice_as_long());
    }
    let (taken, steps, samples) = found;
    assert!(taken <= most, "{numerics}: {taken} allocations in {steps} steps, {samples} samples");
}

#[test]
fn steps_and_samples_take_no_memory() {
    let _turn = TURN.lock();
    check(WAVE, "particle_spacing_m = 0.02", 0.9, (1, 0));
    check(WAVE, "particle_spacing_m = 0.02\nprecision = \"f32\"", 0.9, (1, 0));
    check(WAVE, "particle_spacing_m = 0.02\npreset = \"huang2019\"", 0.3, (1, 0));
    check(WAVE, "particle_spacing_m = 0.02\nscheme = \"isph\"", 0.9, (1, 1));
    let compact = "particle_spacing_m = 0.02\nscheme = \"isph\"\nlaplacian = \"schwaiger\"";
    check(WAVE, compact, 0.9, (1, 1));
    // The lists of water that spreads go on growing.
    check(DAM, "particle_spacing_m = 0.02", 0.4, (1, 60));
}

#[test]
fn threads_and_large_water_take_no_memory() {
    let _turn = TURN.lock();
    let often = format!("{WAVE}history_interval_s = 0.002\n");
    // The pool has a queue.
    check(&often, "particle_spacing_m = 0.008", 0.5, (2, 4));
    let incompressible = "particle_spacing_m = 0.01\nscheme = \"isph\"";
    check(&often, incompressible, 0.6, (2, 30));
    // In parts: more particles than the caches hold.
    check(&often, "particle_spacing_m = 0.003", 0.06, (1, 0));
}

/// Steps, pairs that passes went through and rebuilds of the lists, until the wave stands at the wall.
#[test]
fn a_small_case_takes_the_work_it_took_before() {
    const STEPS: u64 = 502;
    const PAIR_EVALUATIONS: u64 = 125_543_136;
    const LIST_REBUILDS: u64 = 60;
    let path = SimdPath::widest();
    if path == SimdPath::Portable {
        return; // Rounded otherwise, a pair at the edge of the support may count or not.
    }
    let _turn = TURN.lock();
    let result = run(WAVE, "particle_spacing_m = 0.02", 1.8, path.into());
    let outcome = &result.outcome;
    assert_eq!(
        (outcome.steps, outcome.pair_evaluations, result.list_rebuilds),
        (STEPS, PAIR_EVALUATIONS, LIST_REBUILDS),
        "steps, pair evaluations, list rebuilds"
    );
}

/// What is off takes no time: a phase of it is not there.
#[test]
fn what_a_scene_does_not_use_is_not_computed() {
    let _turn = TURN.lock();
    let phases = |numerics: &str| -> Vec<String> {
        let result = run(WAVE, numerics, 0.1, SimdPath::widest().into());
        result.phases.into_iter().map(|share| share.phase).collect()
    };
    let has = |phases: &[String], name: &str| phases.iter().any(|phase| phase == name);
    let usual = phases("particle_spacing_m = 0.02");
    assert!(has(&usual, "shifting") && !has(&usual, "viscosity"), "{usual:?}");
    let still = phases("particle_spacing_m = 0.02\nshifting = \"none\"");
    assert!(!has(&still, "shifting"), "{still:?}");
    let viscous = phases("particle_spacing_m = 0.02\nkinematic_viscosity_m2_per_s = 1e-3");
    assert!(has(&viscous, "viscosity"), "{viscous:?}");
}
