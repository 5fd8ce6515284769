//! Threads within a case change nothing but the time it takes.

use std::fs;

use crate::common::{ended, results, write_file};
use seawall::body::BodyMotion;
use seawall::math::simd::SimdPath;
use seawall::math::team::Team;
use seawall::scene::CaseConfig;
use seawall::scheme::{NextStep, StepWalls};
use seawall::simulation::{CaseResult, Resources, Unwatched, run_case, run_trunk};

fn case(scene: &str, numerics: &str) -> CaseConfig {
    let scene = format!("wave_height_ratio = 0.5\nwave_gauge_m = 0.6\n{scene}").parse().unwrap();
    CaseConfig::from_tables(&scene, &numerics.parse().unwrap()).unwrap()
}

/// A seawall's tank.
const TANK: &str = "wave_height_ratio = 0.5\nwave_gauge_m = 0.6\ntank_length_m = 0.9\nwall = \"movable\"\n\
                    spring_stiffness_n_per_m = 100\nseawall_mass_kg_per_m = 50\nend_time_s = 1\n";

/// The bits of all fields, loads and losses after so many steps of a tank whose right wall moves at
/// such a speed, m/s.
fn bits_after_steps(
    (scene, speed): (&str, f64),
    numerics: &str,
    steps: u32,
    threads: usize,
) -> Vec<u64> {
    let (scene, numerics) = (scene.parse().unwrap(), numerics.parse().unwrap());
    let config = CaseConfig::from_tables(&scene, &numerics).unwrap();
    let team = Team::of(threads);
    let tank = config.scene.build(&config.numerics, SimdPath::widest());
    let (mut water, dt) = (tank.water, tank.frame.time_step(&config.numerics));
    let mut told = Vec::new();
    team.lead(|| {
        water.take_on(&team);
        let mut bodies = [BodyMotion::default(); 3];
        bodies[1].acceleration = 0.1;
        for step in 0..steps {
            bodies[2] =
                BodyMotion { velocity: speed, offset: speed * dt * f64::from(step), ..bodies[2] };
            water.prepare(&bodies, dt).unwrap();
            water.respond(dt).unwrap();
            for load in (0..3).map(|body| water.load(body)) {
                told.extend([load.force, load.added_mass]);
            }
            if step % 5 == 0 {
                told.extend([water.face_force(2, &bodies[2]), water.level_at(2)]);
            }
            water.settle(-0.2);
            let next = NextStep { bodies: &bodies, dt };
            let walls = StepWalls { bodies: &bodies, acceleration: -0.2, next };
            let lost = water.finish(dt, &walls, step % 7 == 0);
            told.extend([lost.viscous_power, lost.diffusion_power, lost.shifting_work]);
        }
        water.prepare(&bodies, dt).unwrap();
        told.extend((0..3).map(|body| water.load(body).force));
    });
    let fluid = water.fluid();
    let fields: [&[f64]; 6] =
        [&fluid.x, &fluid.y, &fluid.vx, &fluid.vy, &fluid.density, water.pressures()];
    told.extend(fields.into_iter().flatten());
    assert!(told.iter().all(|value| value.is_finite()));
    told.push(water.pair_evaluations() as f64);
    told.into_iter().map(f64::to_bits).collect()
}

fn assert_same_bits(scene: (&str, f64), numerics: &str, steps: u32) {
    let alone = bits_after_steps(scene, numerics, steps, 1);
    for threads in [2, 3] {
        let shared = bits_after_steps(scene, numerics, steps, threads);
        assert!(shared == alone, "{scene:?} {numerics}, {threads} threads");
    }
}

const WEAKLY_COMPRESSIBLE: [&str; 8] = [
    "",
    "corrected_gradients = false\ndensity_diffusion = \"molteni\"",
    "slip = \"no\"\ndensity_diffusion = \"none\"\nshifting = \"none\"",
    "precision = \"f32\"",
    "density_diffusion = \"renormalised\"\nkinematic_viscosity_m2_per_s = 1e-4",
    "preset = \"huang2019\"",
    "boundary = \"mls-linear\"",
    "boundary = \"dummy\"",
];

#[test]
fn every_pass_gives_the_same_bits_on_any_number_of_threads() {
    for numerics in WEAKLY_COMPRESSIBLE {
        let numerics = format!("particle_spacing_m = 0.02\n{numerics}");
        assert_same_bits((TANK, 0.3), &numerics, 200);
    }
}

const INCOMPRESSIBLE: [&str; 4] = [
    "",
    "kinematic_viscosity_m2_per_s = 1e-4\npreconditioner = \"jacobi\"",
    "laplacian = \"symmetric\"",
    "laplacian = \"schwaiger\"\npreconditioner = \"incomplete\"",
];

#[test]
fn every_pass_and_solve_of_incompressible_water_gives_the_same_bits_on_any_number_of_threads() {
    for numerics in INCOMPRESSIBLE {
        let numerics = format!("particle_spacing_m = 0.02\nscheme = \"isph\"\n{numerics}");
        assert_same_bits((TANK, 0.3), &numerics, 100);
    }
}

/// A wall that yields to what the paddle sends ahead of the wave, within a quarter of a second. There
/// are enough particles for three threads.
fn movable() -> CaseConfig {
    let scene = "tank_length_m = 1.4\nwall = \"movable\"\nspring_stiffness_n_per_m = 100\n\
                 seawall_mass_kg_per_m = 50\nthreshold_ratio = 1.002\nend_time_s = 0.26\n";
    case(scene, "particle_spacing_m = 0.0065")
}

fn timeless(result: CaseResult) -> CaseResult {
    CaseResult { phases: Vec::new(), ..result }
}

#[test]
fn a_case_and_its_branch_end_alike_on_any_number_of_threads() {
    let (case, simd) = (movable(), SimdPath::widest());
    let alone = timeless(run_case(&case, None, simd, &Unwatched).unwrap());
    assert!(alone.outcome.displacement_max.unwrap().value > 0.0, "{:?}", alone.outcome);
    assert!(alone.outcome.particles > 6000);
    for threads in [2, 3] {
        let resources = Resources { simd, threads };
        let whole = run_case(&case, None, resources, &Unwatched).unwrap();
        assert!(timeless(whole) == alone, "{threads} threads");
        // A trunk of one number of threads serves a branch of another.
        let trunk = run_trunk(&case.trunk().unwrap(), resources, &Unwatched).unwrap();
        for resources in [resources, simd.into()] {
            let kept = Some(&*trunk.checkpoint);
            let branch = run_case(&case, kept, resources, &Unwatched).unwrap();
            assert!(timeless(branch) == alone, "{threads} threads, then {}", resources.threads);
        }
    }
}

/// Two cases with particles for three threads each.
const TWO: &str = r#"
name = "two"
[scene]
tank_length_m = 1.4
wave_gauge_m = 0.6
end_time_s = 0.06
[numerics]
particle_spacing_m = 0.0065
[grid]
wave_height_ratio = [0.3, 0.5]
"#;

#[test]
fn a_sweep_of_few_cases_gives_the_same_files_on_any_number_of_threads_and_resumed() {
    let root = tempfile::tempdir().unwrap();
    let file = write_file(root.path(), TWO);
    let path = |name: &str| root.path().join(name).to_str().unwrap().to_owned();
    let sweep = |out: &str, threads: &str| {
        ended(0, &["sweep", &file, "--out", out, "--threads", threads, "--film", "none"]).err
    };
    let (alone, four, resumed) = (path("alone"), path("four"), path("resumed"));
    assert!(sweep(&alone, "1").contains("2 cases on 1 thread,"));
    let told = sweep(&four, "4");
    assert!(told.contains("2 cases on 4 threads, up to 2 threads on one case,"), "{told}");
    assert!(results(four.as_ref()) == results(alone.as_ref()), "four threads");
    // The case that came last runs again, on three threads.
    sweep(&resumed, "1");
    let journal = root.path().join("resumed/journal.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let last = text.trim_end().rfind('\n').unwrap() + 1;
    fs::write(&journal, &text[..last]).unwrap();
    let told = sweep(&resumed, "3");
    assert!(told.contains("1 case on 3 threads, up to 3 threads on one case,"), "{told}");
    assert!(results(resumed.as_ref()) == results(alone.as_ref()), "resumed");
}

#[test]
fn a_single_scene_gives_the_same_files_on_any_number_of_threads() {
    let root = tempfile::tempdir().unwrap();
    let text = TWO.replace("[grid]\nwave_height_ratio = [0.3, 0.5]\n", "");
    let text = text.replace("[scene]", "[scene]\nwave_height_ratio = 0.5");
    let file = write_file(root.path(), &text);
    for scheme in ["wcsph", "isph"] {
        let numerics = format!("numerics.scheme={scheme}");
        let outs = ["1", "2", "3"].map(|threads| {
            let out = root.path().join(format!("{scheme}_{threads}"));
            let out = out.to_str().unwrap();
            ended(0, &["run", &file, "--threads", threads, "--set", &numerics, "--out", out]);
            results(out.as_ref())
        });
        assert!(outs[1] == outs[0] && outs[2] == outs[0], "{scheme}");
    }
}
