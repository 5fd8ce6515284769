//! What a run promises of every wall and every paddle that is declared, in short, coarse tanks.
//!
//! Kinds are those of the keys `wall` and `paddle`. The keys of a kind have the values of a shipped scene with it.

use std::collections::BTreeMap;
use std::fs;

use seawall::keys::{Key, Shape};
use seawall::math::simd::SimdPath;
use seawall::quantities::{Bars, Case, Value, energy, summary};
use seawall::scene::{CaseConfig, Kind, scene_keys};
use seawall::simulation::{CaseResult, Unwatched, run_case, run_trunk};
use toml::Table;

use crate::kept::{bits, goes_on};

/// A tank with five rows of water, and gauges in it and at its wall. Every step is a sample.
const TANK: &str = "tank_length_m = 1.0\nwave_gauge_m = 0.5\nhistory_interval_s = 1e-6\n";
const SCHEMES: [&str; 2] = ["wcsph", "isph"];
/// The force of its still water, N per metre of width: ½ρgh².
const STILL_FORCE: f64 = 0.5 * 1000.0 * 9.81 * 0.2 * 0.2;
/// Its depth, metres.
const DEPTH: f64 = 0.2;

fn key(name: &str) -> &'static Key {
    scene_keys(Kind::Seawall).into_iter().find(|key| key.name == name).unwrap()
}

/// The names of all kinds of wall or paddle.
fn kinds(of: &str) -> &'static [&'static str] {
    let Shape::Names(names) = (key(of).shape)() else { panic!("{of} has no names") };
    names
}

/// The keys that only some walls, or some paddles, have.
fn own_keys(of: &str) -> Vec<&'static Key> {
    let mut keys = scene_keys(Kind::Seawall);
    keys.retain(|key| key.rule.only.is_some_and(|when| when.key == of));
    keys
}

/// The `[scene]` tables of all shipped scenes.
fn shipped() -> Vec<Table> {
    let files = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps/scenes")).unwrap();
    let mut files: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    let scene = |path| fs::read_to_string(path).unwrap().parse::<Table>().unwrap()["scene"].clone();
    files.iter().map(|path| scene(path).as_table().unwrap().clone()).collect()
}

/// Of a wall or a paddle of this kind: its name, and the keys that a shipped scene gives it.
fn of_kind(of: &str, kind: &str) -> Table {
    let usual = (key(of).default)().unwrap();
    let has = |scene: &Table| {
        let of_seawalls = scene.get("kind").is_none_or(|kind| kind.as_str() == Some("seawall"));
        of_seawalls && scene.get(of).unwrap_or(&usual).as_str() == Some(kind)
    };
    let scene = shipped().into_iter().find(has);
    let mut scene = scene.unwrap_or_else(|| panic!("sweeps/scenes has no {of} = {kind:?}"));
    let own = own_keys(of);
    scene.retain(|name, _| own.iter().any(|key| key.name == name));
    scene.insert(of.to_owned(), kind.into());
    scene
}

fn config(scene: &str, scheme: &str) -> CaseConfig {
    let [scene, numerics, gauge] = [
        format!("{TANK}{scene}"),
        format!("particle_spacing_m = 0.04\nscheme = \"{scheme}\""),
        "name = \"low\"\nkind = \"pressure\"\nwall = \"right\"\ny_m = 0.05".to_owned(),
    ]
    .map(|text| text.parse().unwrap());
    CaseConfig::with_probes(&scene, &numerics, &[gauge]).unwrap()
}

/// Seconds after the middle of the stroke: walls have come to rest, or nearly so.
const END: f64 = 0.9;

/// A solitary wave on every kind of wall up to this time; where a wall may lean, on leaning ones, too.
fn walls(end: f64) -> Vec<(String, CaseConfig)> {
    let leaning = key("wall_angle_deg").rule.read.unwrap().values;
    let mut all = Vec::new();
    for (kind, scheme) in kinds("wall").iter().flat_map(|kind| SCHEMES.map(|by| (*kind, by))) {
        let wave = format!("wave_height_ratio = 0.5\nend_after_stroke_centre_s = {end}\n");
        let scene = format!("{wave}{}", of_kind("wall", kind));
        all.push((format!("{kind}, {scheme}"), config(&scene, scheme)));
        if leaning.contains(&kind) && scheme == SCHEMES[0] {
            for angle in [60, 120] {
                let leaning = format!("{scene}wall_angle_deg = {angle}\n");
                all.push((format!("{kind} of {angle} degrees"), config(&leaning, scheme)));
            }
        }
    }
    all
}

/// The waves of every kind of paddle on a fixed wall, also of one that absorbs what comes back.
fn paddles() -> Vec<(String, CaseConfig)> {
    let mut all = Vec::new();
    for kind in kinds("paddle") {
        let waves = "wave_height_ratio = 0.2\nend_time_s = 2\n";
        let scene = format!("{waves}{}", of_kind("paddle", kind));
        all.extend(SCHEMES.map(|by| (format!("{kind}, {by}"), config(&scene, by))));
        let absorbing = format!("{scene}absorption = true\n");
        all.push((format!("{kind} that absorbs"), config(&absorbing, SCHEMES[0])));
    }
    all
}

fn run(case: &CaseConfig) -> CaseResult {
    run_case(case, None, SimdPath::widest(), &Unwatched).unwrap()
}

/// Work of the water's force on the wall, J per metre of width. What the water of few rows lacks at rest was
/// added to the force in the history, and does no work.
fn work_on_wall(result: &CaseResult) -> f64 {
    let lacking = 1.0 - result.outcome.force_at_rest;
    let steps = result.history.windows(2);
    let work = steps.map(|by| (by[0].force - lacking) * (by[1].displacement - by[0].displacement));
    STILL_FORCE * DEPTH * work.sum::<f64>()
}

/// What the water does to a wall is in the wall's motion, in its spring, or in what holds it, at any time. A wall
/// that never moves takes nothing.
#[test]
fn a_wall_keeps_or_books_all_work_that_is_done_on_it() {
    let mut most_own = BTreeMap::new();
    for (name, case) in [0.5, 0.7, END].into_iter().flat_map(walls) {
        let result = run(&case);
        let (work, budget) = (work_on_wall(&result), result.energy);
        let own = budget.wall_kinetic + budget.spring + budget.stops;
        let booked = own + budget.threshold_device;
        let moves = case.scene.seawall().unwrap().wall.moves();
        println!("{name}: {work} J/m, {booked} booked, {own} its own");
        assert_eq!([work, own].map(|energy| energy > 0.0), [moves; 2], "{name}: {work} J/m, {own}");
        assert_eq!(result.outcome.displacement_max.is_some(), moves, "{name}");
        // What holds a wall may take nearly all; an error in its own energy has to show beside that.
        let most = own.max(*most_own.get(&name).unwrap_or(&0.0));
        assert!(
            (booked - work).abs() <= 0.1 * most,
            "{name}: {booked} booked of {work} J/m, {own} its own"
        );
        most_own.insert(name, most);
    }
}

/// Nothing comes from nowhere, whatever moves the water.
#[test]
fn the_energy_of_every_tank_is_booked() {
    for (name, case) in walls(END).into_iter().chain(paddles()) {
        let outcome = run(&case).outcome;
        assert!(outcome.energy_gap_percent.abs() < 5.0, "{name}: {}", outcome.energy_gap_percent);
    }
}

#[test]
fn all_that_is_read_is_finite_and_has_a_name() {
    for (name, case) in walls(END).into_iter().chain(paddles()) {
        let CaseResult { outcome, history, probes, readings, energy: budget, .. } = run(&case);
        let told = Case {
            id: name.clone(),
            config: &case,
            outcome: Some(&outcome),
            reason: "",
            bars: Bars::default(),
            wall_time_s: 0.0,
        };
        for column in summary::ALL.iter() {
            let number = column.value(&told);
            let finite = !matches!(number, Some(Value::Number(number)) if !number.is_finite());
            assert!(finite, "{name}: {} = {number:?}", column.name);
        }
        for term in energy::ALL.iter() {
            assert!((term.read)(&budget).is_finite(), "{name}: {}", term.name);
        }
        let rows = history.iter();
        let rows =
            rows.map(|row| [row.force, row.runup, row.displacement, row.wall_velocity_m_per_s]);
        assert!(rows.flatten().all(f64::is_finite), "{name}");
        let probes = probes.unwrap();
        assert!(probes.values.iter().all(|value| value.is_finite()), "{name}");
        assert!(probes.columns.iter().all(|column| !column.name.is_empty()), "{name}");
        assert!(readings.iter().all(|one| !one.name.is_empty() && one.value.is_finite()), "{name}");
        let wall = case.scene.seawall().unwrap().wall;
        assert!(
            [wall.words(), wall.title(), wall.resistance()].iter().all(|word| !word.is_empty())
        );
    }
}

#[test]
fn every_body_goes_on_from_what_is_kept_and_from_its_trunk_to_the_bit() {
    let path = SimdPath::widest();
    for (name, case) in walls(END).into_iter().chain(paddles()) {
        goes_on(&name, &case, 3);
        let trunk = run_trunk(&case.trunk().unwrap(), path, &Unwatched).unwrap();
        let branch = run_case(&case, Some(&trunk.checkpoint), path, &Unwatched).unwrap();
        assert!(bits(branch) == bits(run(&case)), "{name}: from its trunk");
    }
}

/// A paddle moves as its velocity and acceleration say, and no farther than it says.
#[test]
fn a_paddle_moves_as_it_says() {
    for (name, case) in paddles() {
        let scene = case.scene.seawall().unwrap();
        let (paddle, start) = (scene.paddle().unwrap(), scene.start_s());
        let [back, forth] = [paddle.goes_back(), paddle.goes_forth()];
        let step = 1e-5;
        // Between the points of a record, where its acceleration may jump.
        for time in (0..2000).map(|k| start + 1e-3 * (f64::from(k) + 0.5)) {
            let [before, now, after] = [-step, 0.0, step].map(|by| paddle.motion(time + by));
            let speed = (after.offset - before.offset) / (2.0 * step);
            assert!((speed - now.velocity).abs() < 1e-4, "{name} at {time} s: {speed}, {now:?}");
            let push = (after.velocity - before.velocity) / (2.0 * step);
            assert!((push - now.acceleration).abs() < 1e-1, "{name} at {time} s: {push}, {now:?}");
            let reach = -back - 1e-9..=forth + 1e-9;
            assert!(reach.contains(&now.offset), "{name} at {time} s: {now:?}, {reach:?}");
            let stands = now.velocity.abs() < 1e-9;
            assert!(time < paddle.still_from() || stands, "{name} at {time} s: {now:?}");
        }
    }
}

/// A key that only some walls or paddles have is refused with all others, which are told whose it is.
#[test]
fn a_key_of_one_body_is_refused_with_all_others() {
    for of in ["wall", "paddle"] {
        let mut refused = 0;
        for (theirs, key) in
            kinds(of).iter().flat_map(|kind| own_keys(of).into_iter().map(move |key| (kind, key)))
        {
            let when = key.rule.only.unwrap();
            if when.values.contains(theirs) {
                continue;
            }
            let mut scene = of_kind(of, theirs);
            let Some(value) = of_kind(of, when.values[0]).get(key.name).cloned() else { continue };
            scene.insert(key.name.to_owned(), value);
            scene.insert("end_time_s".to_owned(), 2.0.into());
            scene.insert("wave_height_ratio".to_owned(), 0.2.into());
            let told = CaseConfig::from_tables(&scene, &Table::new()).unwrap_err().to_string();
            let expected = format!("belongs to {when}");
            assert!(told.starts_with(&format!("scene.{}", key.name)), "{theirs}: {told}");
            assert!(told.ends_with(&expected), "{theirs}: {told:?}, {expected:?}");
            refused += 1;
        }
        assert!(refused >= kinds(of).len(), "{of}: {refused} keys were tried");
    }
}
