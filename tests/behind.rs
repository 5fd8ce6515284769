//! What lies behind a wall that water goes over: a dry floor or a basin, up to an end wall.

use std::sync::Mutex;

use crate::common::{Desk, ended, expect_refused, results};
use seawall::math::simd::SimdPath;
use seawall::scene::CaseConfig;
use seawall::simulation::{CaseResult, Film, HistoryRow, Monitor, Unwatched, run_case};
use toml::Table;

const LENGTH: f64 = 1.6;
const WIDTH: f64 = 0.2;
const TANK: &str = "tank_length_m = 1.6\nwave_gauge_m = 0.8\ncrest_width_m = 0.2\n";
const WAVE: &str = "wave_height_ratio = 0.6\ncrest_freeboard_m = 0.04\n";
const NUMERICS: &str =
    "particle_spacing_m = 0.02\nboundary = \"normalized\"\ncourant_number = 0.6\n";

fn case(scene: &str, probes: &[Table]) -> CaseConfig {
    let table = |text: &str| text.parse::<Table>().unwrap();
    CaseConfig::with_probes(&table(scene), &table(NUMERICS), probes).unwrap()
}

fn computed(scene: &str) -> CaseResult {
    run_case(&case(scene, &[]), None, SimdPath::widest(), &Unwatched).unwrap()
}

fn reading(case: &CaseResult, name: &str) -> f64 {
    case.readings.iter().find(|reading| reading.name == name).unwrap().value
}

/// Keeps the places and masses of the particles, film by film.
#[derive(Default)]
struct Places(Mutex<Vec<Vec<[f64; 3]>>>);

impl Monitor for Places {
    fn film_interval(&self) -> Option<f64> {
        Some(0.1)
    }
    fn film(&self, film: &Film<'_>) {
        let fluid = film.fluid;
        let all = (0..fluid.len()).map(|k| [fluid.x[k], fluid.y[k], fluid.mass[k]]);
        self.0.lock().unwrap().push(all.collect());
    }
}

/// A gauge at the wall's face stood on the crest, and one at the end wall on top of that, 0.8 m high.
#[test]
fn gauges_at_both_faces_read_the_water_before_them() {
    let scene = format!(
        "{TANK}wave_height_ratio = 0\nend_time_s = 0.1\ncrest_freeboard_m = 0.06\nbehind = \"basin\"\n\
         floor_length_m = 0.6\nbasin_level_m = 0.16\n"
    );
    let gauge = |x: f64| format!("name = \"x{x}\"\nkind = \"level\"\nx_m = {x}").parse().unwrap();
    let config = case(&scene, &[1.6, 2.4].map(gauge));
    let still = run_case(&config, None, SimdPath::widest(), &Unwatched).unwrap();
    let probes = still.probes.unwrap();
    let (_, levels) = probes.rows().next().unwrap();
    assert!((levels[0] - 0.2).abs() < 0.002 && (levels[1] - 0.16).abs() < 0.002, "{levels:?}");
}

/// The story: `water_in_tank` held the water on the crest and behind it, too, and the parts were more than the whole.
fn assert_parts_make_the_whole(case: &CaseResult, parts: &[&str]) {
    let sum: f64 = parts.iter().map(|part| reading(case, part)).sum();
    let whole = reading(case, "water_at_start");
    assert!((sum + reading(case, "water_gap") - whole).abs() < 1e-9, "{sum} kg/m of {whole}");
}

/// Both waters lie still beside one another at their own levels, and the wall feels its front alone.
#[test]
fn a_basin_rests_beside_the_tank() {
    let still = format!("{TANK}wave_height_ratio = 0\nend_time_s = 4\ncrest_freeboard_m = 0.06\n");
    let alone = computed(&format!("{still}behind = \"outflow\"\n"));
    for (floor, level) in [(-0.05, 0.16), (0.0, 0.2), (0.04, 0.22)] {
        let basin = format!(
            "behind = \"basin\"\nfloor_height_m = {floor}\nfloor_length_m = 0.6\nbasin_level_m = {level}\n"
        );
        let places = Places::default();
        let config = case(&(still.clone() + &basin), &[]);
        let both = run_case(&config, None, SimdPath::widest(), &places).unwrap();
        let over = both.outcome.overtopped.unwrap();
        let off = both.history.iter().map(|row| (row.force - 1.0).abs()).fold(0.0, f64::max);
        let kinetic = both.energy.kinetic;
        println!("{floor} {level}: {kinetic} J/m, F* off by {off}, {} m² over", over.volume_m2);
        assert!(kinetic < 1e-3 && off < 0.02 && over.volume_m2.abs() < 1e-12);
        assert!(reading(&both, "water_gap").abs() < 1e-9 && both.outcome.particles_lost == 0);
        assert_parts_make_the_whole(&both, &["water_in_tank", "water_on_crest", "water_behind"]);
        let moved = both.outcome.force_at_rest / alone.outcome.force_at_rest - 1.0;
        assert!(moved.abs() < 1e-9, "the wall feels what is behind it: {moved}");
        let films = places.0.into_inner().unwrap();
        let highest = films[films.len() - 1].iter().filter(|[x, ..]| *x > LENGTH + WIDTH);
        let highest = highest.map(|[_, y, _]| *y).fold(f64::MIN, f64::max);
        assert!((highest - level).abs() < 0.02, "{highest} at a level of {level}");
    }
}

/// All that goes over lies on the floor in the end, and none of it before it, below it or beyond it.
#[test]
fn what_goes_over_lies_on_the_floor() {
    let probe = format!("name = \"beyond\"\nkind = \"volume\"\nx_m = {}", LENGTH + WIDTH);
    let floor = -0.05;
    let scene = format!(
        "{TANK}{WAVE}behind = \"floor\"\nfloor_height_m = {floor}\nfloor_length_m = 0.8\n\
         end_after_stroke_centre_s = 3\n"
    );
    let places = Places::default();
    let config = case(&scene, &[probe.parse().unwrap()]);
    let case = run_case(&config, None, SimdPath::widest(), &places).unwrap();
    let over = case.outcome.overtopped.unwrap();
    let (back, end) = (LENGTH + WIDTH, LENGTH + WIDTH + 0.8);
    let films = places.0.into_inner().unwrap();
    let first: f64 = films[0].iter().map(|[.., mass]| mass).sum();
    for film in &films {
        let mass: f64 = film.iter().map(|[.., mass]| mass).sum();
        assert!((mass / first - 1.0).abs() < 1e-12, "{mass} of {first} kg/m");
        for &[x, y, _] in film.iter().filter(|[x, ..]| *x > LENGTH) {
            let ground = if x < back { 0.24 } else { floor };
            assert!(y > ground && x < end, "leaked to {x} {y}");
        }
    }
    assert!(reading(&case, "water_gap").abs() < 1e-9);
    assert_eq!((reading(&case, "water_taken_away"), case.outcome.particles_lost), (0.0, 0));
    // By the particles there, by a probe, and by the discharge at the back.
    let last = &films[films.len() - 1];
    let there: f64 = last.iter().filter(|[x, ..]| *x > back).map(|[.., mass]| mass / 1000.0).sum();
    let table = case.probes.as_ref().unwrap();
    let rows: Vec<_> = table.rows().map(|(time, row)| (time, row.to_vec())).collect();
    let beyond = rows[rows.len() - 1].1[0];
    let passed: f64 =
        rows.windows(2).map(|w| (w[1].0 - w[0].0) * 0.5 * (w[0].1[2] + w[1].1[2])).sum();
    let volume = over.volume_m2;
    println!("{volume} m² over, {there} m² there, {beyond} m² beyond, {passed} m² passed");
    println!("energy gap {} %", case.outcome.energy_gap_percent);
    assert!(volume > 0.02 && over.thickness_max_m > 0.04 && over.speed_max_m_per_s > Some(0.5));
    assert!((there / volume - 1.0).abs() < 0.02 && (beyond / volume - 1.0).abs() < 0.02);
    // The discharge counts water by and by, on a way of five spacings around the back: a drop that stays there in part.
    let counted = |[x, y, mass]: &[f64; 3]| {
        let past = if *x > back { x - back + (0.24 - y).max(0.0) } else { x - back };
        let part = (past / 0.1 + 0.5).clamp(0.0, 1.0);
        part.powi(3) * (part * (6.0 * part - 15.0) + 10.0) * mass / 1000.0
    };
    let by_and_by: f64 = last.iter().map(counted).sum();
    println!("{by_and_by} m² as the discharge counts it");
    assert!((passed / by_and_by - 1.0).abs() < 0.002 && (by_and_by / volume - 1.0).abs() < 0.02);
    // The story: ghosts that went along with the water made 2.6 % more of it.
    assert!(case.outcome.energy_gap_percent.abs() < 1.0);
}

/// Until water could come back over, the front cannot tell a floor or a basin from an outflow.
#[test]
fn the_front_feels_nothing_of_what_is_behind() {
    let wave = format!("{TANK}{WAVE}end_after_stroke_centre_s = 1.8\n");
    let outflow = computed(&format!("{wave}behind = \"outflow\"\n"));
    let floor = "floor_length_m = 0.8\nfloor_height_m = -0.1\n";
    for behind in [
        format!("behind = \"floor\"\n{floor}"),
        format!("behind = \"basin\"\n{floor}basin_level_m = 0.15\n"),
    ] {
        let kept = computed(&(wave.clone() + &behind));
        let table = kept.probes.as_ref().unwrap();
        // As water comes to the back an outflow's back is pressed, and counts.
        let dry = table.rows().take_while(|(_, row)| row[1].abs() < 1e-9).count();
        let rows = outflow.history.iter().zip(&kept.history);
        let off = |(a, b): (&HistoryRow, &HistoryRow)| (a.force - b.force).abs();
        let before = rows.clone().take(dry).map(off).fold(0.0, f64::max);
        let force = rows.clone().map(off).fold(0.0, f64::max);
        let runup = rows.map(|(a, b)| (a.runup - b.runup).abs()).fold(0.0, f64::max);
        let [a, b] = [&outflow, &kept].map(|case| case.outcome.overtopped.unwrap());
        println!("{behind}: F* off by {before}, then {force}, R* by {runup}");
        println!("{} and {} m² over", a.volume_m2, b.volume_m2);
        assert!(before < 1e-3 && force < 0.1 && runup < 0.02, "{before} {force} {runup}");
        assert!((b.thickness_max_m / a.thickness_max_m - 1.0).abs() < 0.01);
        assert!((b.speed_max_m_per_s.unwrap() / a.speed_max_m_per_s.unwrap() - 1.0).abs() < 0.05);
        assert!((b.volume_m2 / a.volume_m2 - 1.0).abs() < 0.05);
        assert!(b.volume_m2 > 0.01, "nothing went over");
    }
}

/// At the end of a beach, with threads, films and files for ParaView.
#[test]
fn threads_films_and_files_of_a_basin() {
    let text = "name = \"over\"\n[scene]\ntank_length_m = 1.6\nwave_gauge_m = 0.6\n\
                bed = [[0, 0], [0.8, 0], [1.6, 0.05]]\nend_after_stroke_centre_s = 1.4\n\
                behind = \"basin\"\nfloor_length_m = 0.5\nfloor_height_m = -0.05\nbasin_level_m = 0.1\n\
                crest_freeboard_m = 0.05\ncrest_width_m = 0.2\n[numerics]\n\
                particle_spacing_m = 0.02\nboundary = \"normalized\"\n";
    let desk = Desk::new(text);
    let ran = |name: &str, more: &[&str]| {
        let out = desk.path().join(name);
        let command = ["run", &desk.file, "--out", out.to_str().unwrap()];
        ended(0, &[&command[..], more].concat());
        out
    };
    let one = ran("one", &["--threads", "1"]);
    let two = ran("two", &["--threads", "2", "--film"]);
    assert_eq!(results(&one), results(&two));
    let films = std::fs::read_dir(two.join("films")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages = films.filter(|path| path.extension().is_some_and(|ending| ending == "html"));
    let page = std::fs::read_to_string(pages.next().unwrap()).unwrap();
    assert!(page.contains(
        "\"bed\":[[0.0,0.0],[0.8,0.0],[1.6,0.05],[1.6,0.25],[1.8,0.25],[1.8,-0.05],[2.3,-0.05]"
    ));
    let seen = ran("three", &["--vtk", "0.2"]);
    let mut names = Vec::new();
    let mut folders = vec![seen];
    while let Some(next) = folders.pop() {
        for entry in std::fs::read_dir(next).unwrap().map(|entry| entry.unwrap().path()) {
            match entry.is_dir() {
                true => folders.push(entry),
                false => names.push(entry.file_name().unwrap().to_str().unwrap().to_owned()),
            }
        }
    }
    assert!(names.iter().any(|name| name == "behind_00000.vtu"), "{names:?}");
}

#[test]
fn what_cannot_lie_behind_a_wall_is_told() {
    let crest = "crest_freeboard_m = 0.1\ncrest_width_m = 0.2\n";
    let floor = format!("behind = \"floor\"\n{crest}");
    let basin = format!("behind = \"basin\"\n{crest}floor_length_m = 1\n");
    for (keys, numerics, told) in [
        (
            "behind = \"sea\"\n".to_owned(),
            "",
            "scene.behind = \"sea\": must be one of nothing, outflow, floor, basin",
        ),
        (floor.clone(), "", "scene.floor_length_m: is needed"),
        (
            format!("behind = \"outflow\"\n{crest}floor_length_m = 1\n"),
            "",
            "scene.floor_length_m = 1: belongs to behind = \"floor\" or \"basin\"",
        ),
        (
            format!("{floor}floor_length_m = 1\nbasin_level_m = 0.1\n"),
            "",
            "scene.basin_level_m = 0.1: belongs to behind = \"basin\"",
        ),
        (format!("{floor}floor_length_m = 0\n"), "", "scene.floor_length_m = 0: must be"),
        (
            format!("{floor}floor_length_m = 0.1\n"),
            "",
            "scene.floor_length_m = 0.1: must be 0.2 m or more",
        ),
        (
            "behind = \"floor\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.15\nfloor_length_m = 1\n"
                .to_owned(),
            "",
            "scene.crest_width_m = 0.15: must be 0.2 m or more, two of the kernel's support radii",
        ),
        (
            format!("{floor}floor_length_m = 1\nfloor_height_m = 0.25\n"),
            "",
            "scene.floor_height_m = 0.25: must be",
        ),
        (
            format!("{floor}floor_length_m = 1\nfloor_height_m = -1\n"),
            "",
            "scene.floor_height_m = -1: must be",
        ),
        (format!("{basin}basin_level_m = 0.3\n"), "", "scene.basin_level_m = 0.3: must be"),
        (format!("{basin}basin_level_m = 0.05\n"), "", "scene.basin_level_m = 0.05: must be"),
        (format!("{basin}wall_angle_deg = 120\n"), "", "is for an upright wall"),
        (basin.clone(), "scheme = \"isph\"\n", "scene.behind = \"basin\": is for scheme"),
        (basin, "stop_when_settled = true\n", "is not for stop_when_settled"),
    ] {
        let text = format!(
            "name = \"no\"\n[scene]\n{keys}[numerics]\nparticle_spacing_m = 0.02\n{numerics}"
        );
        expect_refused(&text, told);
    }
}
