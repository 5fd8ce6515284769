//! A run that goes on from a state that it has kept ends as the one that was never stopped, to the bit.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{
    CaseResult, Keeper, Monitor, Resources, Stopped, Unwatched, run_case, run_trunk,
};

fn config(scene: &str, numerics: &str) -> CaseConfig {
    CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap()).unwrap()
}

/// Keeps a state once in so many steps in which it can be; hands over one.
#[derive(Default)]
struct Shelf {
    every: usize,
    asked: AtomicUsize,
    states: Mutex<Vec<Vec<u8>>>,
    given: Option<Vec<u8>>,
    refused: AtomicBool,
    /// The run is told to stop once so many states are kept.
    most: Option<usize>,
    /// It looks at the water and at the walls at every step.
    films: bool,
}

impl Keeper for Shelf {
    fn last(&self) -> Option<Vec<u8>> {
        self.given.clone()
    }
    fn is_due(&self, stopping: bool) -> bool {
        let asked = self.asked.fetch_add(1, Ordering::Relaxed);
        stopping || (self.every > 0 && asked % self.every == self.every - 1)
    }
    fn keep(&self, state: Vec<u8>) {
        self.states.lock().unwrap().push(state);
    }
    fn refuse(&self, _: &str) {
        self.refused.store(true, Ordering::Relaxed);
    }
}

impl Monitor for Shelf {
    fn keeper(&self) -> Option<&dyn Keeper> {
        Some(self)
    }
    fn film_interval(&self) -> Option<f64> {
        self.films.then_some(1e-9)
    }
    fn films_faces(&self) -> bool {
        self.films
    }
    fn cancelled(&self) -> bool {
        self.most.is_some_and(|most| self.states.lock().unwrap().len() >= most)
    }
}

fn given(state: &[u8]) -> Shelf {
    Shelf { given: Some(state.to_vec()), ..Shelf::default() }
}

/// All bits but the times of the phases, and how often neighbours were listed: lists that are worn as
/// soon as they are made are made once more.
pub fn bits(mut result: CaseResult) -> Vec<u8> {
    result.phases.clear();
    result.list_rebuilds = 0;
    postcard::to_stdvec(&result).unwrap()
}

/// Runs a case whole, keeping about so many states, and on from each of them.
pub fn goes_on(name: &str, case: &CaseConfig, about: usize) {
    let path = SimdPath::widest();
    let counted = Shelf::default();
    let whole = bits(run_case(case, None, path, &counted).unwrap());
    let asked = counted.asked.into_inner();
    let shelf = Shelf { every: (asked / (about + 1)).max(1), ..Shelf::default() };
    assert_eq!(bits(run_case(case, None, path, &shelf).unwrap()), whole, "{name}: keeping");
    let states = shelf.states.into_inner().unwrap();
    assert!(states.len() >= about, "{name}: {} of {asked}", states.len());
    let camera = Shelf { every: shelf.every, films: true, ..Shelf::default() };
    assert_eq!(bits(run_case(case, None, path, &camera).unwrap()), whole, "{name}: filming");
    assert!(camera.states.into_inner().unwrap() == states, "{name}: a film changed what is kept");
    for (number, state) in states.iter().enumerate() {
        let shelf = given(state);
        // The checkpoint of the trunk stands back behind the case's own.
        let again = run_case(case, Some(b"no checkpoint"), path, &shelf).unwrap();
        assert!(!shelf.refused.into_inner());
        assert!(bits(again) == whole, "{name}: from state {number}");
    }
}

const TANK: &str = "tank_length_m = 1.0\nwave_gauge_m = 0.5\nwave_height_ratio = 0.5\n";

#[test]
fn walls_of_all_kinds() {
    let spring = "wall = \"movable\"\nspring_stiffness_n_per_m = 500\nseawall_mass_kg_per_m = 50\n";
    let caisson = "wall = \"caisson\"\nseawall_mass_kg_per_m = 60\nstatic_friction = 0.6\n\
                   submerged_weight_n_per_m = 300\nkinetic_friction = 0.3\n";
    let end = "end_after_stroke_centre_s = 1.2\n";
    for (name, wall) in [("spring", spring), ("caisson", caisson), ("fixed", "")] {
        let probe = "particle_spacing_m = 0.025";
        goes_on(name, &config(&format!("{TANK}{end}{wall}"), probe), 5);
    }
    for numerics in ["precision = \"f32\"", "preset = \"huang2019\"", "boundary = \"mls-linear\""] {
        let numerics = format!("particle_spacing_m = 0.025\n{numerics}");
        goes_on(&numerics, &config(&format!("{TANK}{end}{spring}"), &numerics), 3);
    }
}

#[test]
fn a_bed_a_crest_and_waves_without_end() {
    let bed = "bed = [[0, 0], [0.5, 0], [1, 0.05]]\nend_after_stroke_centre_s = 1.2\n";
    goes_on("bed", &config(&format!("{TANK}{bed}"), "particle_spacing_m = 0.025"), 4);
    let shore = "bed = [[0, 0], [0.5, 0], [1, 0.3]]\nend_after_stroke_centre_s = 1.2\n";
    goes_on("shore", &config(&format!("{TANK}{shore}"), "particle_spacing_m = 0.025"), 4);
    let crest = "behind = \"outflow\"\ncrest_freeboard_m = 0.05\ncrest_width_m = 0.125\n\
                 end_after_stroke_centre_s = 1.4\n";
    goes_on("crest", &config(&format!("{TANK}{crest}"), "particle_spacing_m = 0.025"), 8);
    let train = "tank_length_m = 1.0\nwave_gauge_m = 0.5\nwave_height_ratio = 0.1\n\
                 paddle = \"wave-train\"\nwave_period_s = 0.8\nend_time_s = 2\n";
    goes_on("wave train", &config(train, "particle_spacing_m = 0.025"), 3);
    let absorbing = format!("{train}absorption = true\n");
    goes_on("absorbing", &config(&absorbing, "particle_spacing_m = 0.025"), 3);
}

#[test]
fn incompressible_water() {
    let spring = "wall = \"movable\"\nspring_stiffness_n_per_m = 100\nseawall_mass_kg_per_m = 50\n\
                  end_after_stroke_centre_s = 0.9\n";
    let numerics = "scheme = \"isph\"\nparticle_spacing_m = 0.04";
    goes_on("isph", &config(&format!("{TANK}{spring}"), numerics), 4);
}

#[test]
fn scenes_with_observers() {
    for scene in [
        "kind = \"dam-break\"\nend_time_s = 1.6",
        "kind = \"standing-wave\"\nend_after_periods = 1.6",
        "kind = \"taylor-green\"\nend_time_s = 0.4",
        "kind = \"rotating-patch\"\nend_time_s = 0.5",
        "kind = \"oscillating-drop\"\nend_after_periods = 0.8",
        "kind = \"hydrostatic\"\nend_time_s = 0.5",
    ] {
        goes_on(scene, &config(scene, "particle_spacing_m = 0.05"), 3);
    }
}

#[test]
fn an_end_before_time_and_a_second_attempt() {
    let still = "wave_height_ratio = 0.1\ntank_length_m = 1.0\nwave_gauge_m = 0.5\n\
                 end_after_stroke_centre_s = 30\n";
    let numerics = "particle_spacing_m = 0.04\nstop_when_settled = true";
    goes_on("settles", &config(still, numerics), 4);
    let case = config(
        &format!("{TANK}end_after_stroke_centre_s = 0.9"),
        "bulk_damping = 1\nparticle_spacing_m = 0.025\ncourant_number = 2.5\nretries = 2",
    );
    let told = run_case(&case, None, SimdPath::widest(), &Unwatched).unwrap().outcome.recovered;
    assert!(told.is_some(), "the first attempt was to fail");
    goes_on("second attempt", &case, 6);
}

#[test]
fn trunks_go_on_too_and_on_any_number_of_threads() {
    let scene = format!("{TANK}end_after_stroke_centre_s = 0.9\nthreshold_ratio = 1.5");
    let trunk = config(&scene, "particle_spacing_m = 0.008").trunk().unwrap();
    let resources = |threads| Resources { simd: SimdPath::widest(), threads };
    let shelf = Shelf { every: 60, ..Shelf::default() };
    let whole = run_trunk(&trunk, resources(1), &shelf).unwrap();
    let states = shelf.states.into_inner().unwrap();
    assert!(states.len() > 1);
    for (state, threads) in [(&states[0], 2), (states.last().unwrap(), 1)] {
        assert!(run_trunk(&trunk, resources(threads), &given(state)).unwrap() == whole);
    }
}

#[test]
fn a_run_that_is_told_to_stop_keeps_where_it_was() {
    let case =
        config(&format!("{TANK}end_after_stroke_centre_s = 0.6"), "particle_spacing_m = 0.04");
    let path = SimdPath::widest();
    let whole = bits(run_case(&case, None, path, &Unwatched).unwrap());
    let shelf = Shelf { every: 30, most: Some(1), ..Shelf::default() };
    assert_eq!(run_case(&case, None, path, &shelf), Err(Stopped::Interrupted));
    let states = shelf.states.into_inner().unwrap();
    assert_eq!(states.len(), 2, "one by the clock, one on stopping");
    assert!(bits(run_case(&case, None, path, &given(&states[1])).unwrap()) == whole);
}

#[test]
fn what_is_of_another_case_or_damaged_is_refused_and_the_run_starts_over() {
    let [case, other] = [0.6, 0.7].map(|end| {
        config(&format!("{TANK}end_after_stroke_centre_s = {end}"), "particle_spacing_m = 0.04")
    });
    let path = SimdPath::widest();
    let shelf = Shelf { every: 40, ..Shelf::default() };
    let whole = bits(run_case(&case, None, path, &shelf).unwrap());
    let state = shelf.states.into_inner().unwrap().pop().unwrap();
    let foreign = given(&state);
    run_case(&other, None, path, &foreign).unwrap();
    assert!(foreign.refused.into_inner());
    for length in [0, 10, state.len() / 2, state.len() - 1] {
        let cut = given(&state[..length]);
        assert!(bits(run_case(&case, None, path, &cut).unwrap()) == whole);
        assert!(cut.refused.into_inner());
    }
}
