//! Columns that mean nothing for a case.

use std::fs;

use crate::common::{Desk, ended};

/// Regular waves at a wall, coarse and short.
const TRAIN: &str = "name = \"few\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\npaddle = \"wave-train\"\n\
                     wave_period_s = 1\nend_time_s = 3.5\n[numerics]\nparticle_spacing_m = 0.025\n\
                     error_bars = \"pair\"\n[grid]\nwave_height_ratio = [0.25, 0.3]\n";

/// The story: a train, of which every wave comes onto what the ones before have left, had a first impact in every
/// table.
#[test]
fn of_regular_waves_no_first_impact_is_told() {
    let desk = Desk::new(TRAIN);
    let told = desk.sweep(&["--film", "none"]).out;
    assert!(told.contains("F* max") && !told.contains("first"), "{told}");
    let ids = crate::common::column(&desk.out, "case_id");
    assert!(
        crate::common::column(&desk.out, "first_force_max").iter().any(|cell| !cell.is_empty())
    );
    let shown = ended(0, &["show", &desk.dir, &ids[0]]).out;
    let word = |word: &str| shown.lines().any(|line| line.trim_start().starts_with(word));
    assert!(word("F* max") && !word("first") && !word("rise time"), "{shown}");
    let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
    for column in ["first_force_max", "first_impulse", "rise_time_s"] {
        assert!(!page.contains(&format!("data-column=\"{column}\"")), "{column}");
    }
    assert!(page.contains("data-column=\"force_max\""));
    let table = fs::read_to_string(desk.out.join("tables/summary.csv")).unwrap();
    let at = table.lines().next().unwrap().split(',').position(|name| name == "first_force_max");
    let first = table.lines().skip(1).map(|line| line.split(',').nth(at.unwrap()).unwrap());
    assert!(first.clone().count() == 2 && first.into_iter().all(str::is_empty), "{table}");
}

/// The story: a recorded stroke was called `H/h = 0.5`, the default of a key that nobody had set.
#[test]
fn a_recorded_stroke_is_not_called_by_a_height_that_nobody_asked_for() {
    let stroke = "time_s,stroke_m\n0,0\n0.2,0.02\n0.4,0.08\n0.6,0.1\n0.8,0.1\n";
    let scene = "name = \"record\"\n[scene]\ntank_length_m = 1.2\nwave_gauge_m = 0.6\nend_time_s = 1.5\n\
                 paddle = \"recorded-stroke\"\nwall = \"movable\"\nspring_stiffness_n_per_m = 1000\n\
                 [numerics]\nparticle_spacing_m = 0.03\n[grid]\nseawall_mass_kg_per_m = [50, 100]\n";
    let desk = Desk::new("");
    let path = desk.path().join("stroke.csv");
    fs::write(&path, stroke).unwrap();
    let page = |more: &str| {
        let named = format!("[scene]\n{more}recorded_stroke = {:?}\n", path.to_str().unwrap());
        desk.write(&scene.replace("[scene]\n", &named));
        desk.sweep(&["--film", "none", "--fresh"]);
        let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
        // Comments of the script have their own example.
        page.lines().filter(|line| !line.starts_with("//")).collect::<String>()
    };
    let unasked = page("");
    assert!(unasked.contains("m = 50 kg/m") && !unasked.contains("H/h = "), "{unasked}");
    assert!(!unasked.contains("data-column=\"wave_height_ratio\""));
    assert!(page("wave_height_ratio = 0.4\n").contains("H/h = 0.4"));
}
