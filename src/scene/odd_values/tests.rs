use super::*;

fn words(config: &CaseConfig) -> Vec<String> {
    odd_values(config).iter().map(ToString::to_string).collect()
}

fn odd(scene: &str) -> Vec<String> {
    words(&CaseConfig::of(scene, ""))
}

/// With a particle spacing of 10 mm, and a probe.
fn odd_with(scene: &str, probe: &str) -> Vec<String> {
    let probe = format!("name = \"P\"\n{probe}").parse().unwrap();
    let numerics = "particle_spacing_m = 0.01".parse().unwrap();
    words(&CaseConfig::with_probes(&scene.parse().unwrap(), &numerics, &[probe]).unwrap())
}

#[test]
fn what_is_usual_is_not_told() {
    let movable = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1";
    for scene in [
        "",
        "still_water_depth_m = 0.5",
        "water_density_kg_per_m3 = 1025",
        "gravity_m_per_s2 = 9.8",
        "history_interval_s = 0.001",
        "threshold_ratio = 0.5",
        &format!("{movable}\nthreshold_ratio = 1"),
        "wall = \"movable\"\nspring_stiffness_n_per_m = 0\nseawall_mass_kg_per_m = 50\nwave_height_ratio = 0.6",
        &format!("{movable}\nforce_coupling = 0\nend_time_s = 9"),
        "wall = \"movable\"\nspring_stiffness_n_per_m = 0\nseawall_mass_kg_per_m = 50\nend_time_s = 6\nthreshold_ratio = 3.5",
        "kind = \"hydrostatic\"\ntank_length_m = 0.3",
        "tank_length_m = 3\nend_after_stroke_centre_s = 1.7",
        "kind = \"rotating-patch\"",
        "wave_gauge_m = 0.38",
        "wave_height_ratio = 0.05\nwave_gauge_m = 0.9",
        "wave_gauge_m = 0.01\nwave_height_ratio = 0\nend_time_s = 1",
        "paddle = \"wave-train\"\nwave_period_s = 1\nwave_height_ratio = 0.1\nend_time_s = 5\nwave_gauge_m = 0.1",
    ] {
        assert_eq!(odd(scene), [""; 0], "{scene}");
    }
}

#[test]
fn slips_are_told_with_key_and_value() {
    let movable = "wall = \"movable\"\nspring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1";
    for (scene, told) in [
        ("still_water_depth_m = 0.51", "scene.still_water_depth_m = 0.51: the tank, tank_length"),
        (
            "wall = \"movable\"\nspring_stiffness_n_per_m = 0\nseawall_mass_kg_per_m = 50\nend_time_s = 6",
            "scene.spring_stiffness_n_per_m = 0: so soft a spring may let the wall go some 18 h; a run fails as",
        ),
        ("tank_length_m = 7", "scene.tank_length_m = 7: the run ends at 3."),
        ("water_density_kg_per_m3 = 1", "scene.water_density_kg_per_m3 = 1: this is no water"),
        ("gravity_m_per_s2 = 981", "scene.gravity_m_per_s2 = 981: this is no place on earth"),
        ("history_interval_s = 1e-9", "scene.history_interval_s = 0.000000001: is much shorter"),
        ("history_interval_s = 100", "scene.history_interval_s = 100: is as long as the run, 3."),
        (
            "paddle = \"wave-train\"\nwave_period_s = 0.3\nend_time_s = 15",
            "scene.wave_period_s = 0.3: waves of wave_height_ratio = 0.5 would be 0.712 of",
        ),
        (
            "wave_height_ratio = 0.05\nend_after_stroke_centre_s = 9",
            "scene.wave_gauge_m = 1.5: the gauge stands so near to the wall that what is sent back adds up to 8 %",
        ),
        (
            "wave_gauge_m = 0.37",
            "scene.wave_gauge_m = 0.37: the paddle goes 0.326 m into the tank, and a gauge nearer than 0.3763 m reads",
        ),
        (
            "bed = [[0, 0], [0.6, 0], [2, 0.28], [2.5, 0.28]]\nwave_gauge_m = 1.7",
            "scene.wave_gauge_m = 1.7: the gauge stands on a beach that is 0.220 m high",
        ),
        (
            "paddle = \"wave-train\"\nwave_period_s = 1\nwave_height_ratio = 0.1\nend_time_s = 5\nwave_gauge_m = 0.05",
            "scene.wave_gauge_m = 0.05: the paddle goes 0.0",
        ),
        (
            &format!("{movable}\nthreshold_ratio = 0.5"),
            "scene.threshold_ratio = 0.5: still water alone presses with 1",
        ),
    ] {
        let all = odd(scene);
        assert!(all.len() == 1 && all[0].starts_with(told), "{all:?}");
    }
    let early = |scene| odd(&format!("tank_length_m = 7\n{scene}")).remove(0);
    let told = ["with end_after_stroke_centre_s = 8.0 the", "with end_time_s = 8.8 the"];
    let told = told.map(|seen| format!("{seen} run shows what it does there"));
    for (scene, told) in ["", "end_time_s = 2.5"].into_iter().zip(told) {
        assert!(early(scene).ends_with(&told), "{} {told}", early(scene));
    }
    assert!(odd("end_time_s = 1e-308")[1].starts_with("scene.end_time_s = 1e-308: "));
}

/// A probe whose height was measured from the wall's foot once read 0 Pa all the time.
#[test]
fn a_probe_under_the_bed_is_told() {
    let scene = "bed = [[0, 0], [1, 0], [2, 0.1], [2.5, 0.1]]";
    let told = |probe: &str| odd_with(scene, &format!("kind = \"pressure\"\n{probe}"));
    for sound in
        ["wall = \"left\"\ny_m = 0.01", "wall = \"right\"\ny_m = 0.1", "x_m = 1.5\ny_m = 0.06"]
    {
        assert_eq!(told(sound), [""; 0], "{sound}");
    }
    let low = told("wall = \"right\"\ny_m = 0.09");
    assert!(
        low.len() == 1
            && low[0].starts_with("probe.y_m = 0.09: P stands under the bed, which is 0.1000")
    );
    assert_eq!(told("x_m = 1.5\ny_m = 0.04").len(), 1);
}

/// A gauge behind the end of the tank once read a level of 0 m all the time.
#[test]
fn a_probe_outside_the_tank_is_told() {
    let told = |scene: &str, x: f64| odd_with(scene, &format!("kind = \"level\"\nx_m = {x}"));
    let outside = told("", 2.6);
    let text = "probe.x_m = 2.6: P stands outside the tank, which ends at 2.5000 m";
    assert!(outside.len() == 1 && outside[0].starts_with(text), "{outside:?}");
    let basin =
        "behind = \"basin\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.2\nfloor_length_m = 0.5";
    let sliding = "wall = \"caisson\"\nseawall_mass_kg_per_m = 50\nsubmerged_weight_n_per_m = 200\n\
                   static_friction = 0.5\nkinetic_friction = 0.4";
    let outflow = "behind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.2";
    let leaning = "wall_angle_deg = 120";
    for (scene, x) in [("", 2.5), (basin, 3.1), (sliding, 2.6), (leaning, 2.6), (outflow, 2.8)] {
        let all = told(scene, x);
        assert!(all.iter().all(|told| !told.contains("outside")), "{scene}: {all:?}");
    }
    assert_eq!(told(basin, 3.3).len(), 1);
}

/// Probes inside a wall, under its crest, and gauges that the paddle passed once read 0 without a
/// warning.
#[test]
fn a_probe_in_a_wall_or_in_the_paddles_way_is_told() {
    let outflow = "behind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.2";
    let floor = "behind = \"floor\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.2\nfloor_length_m = 0.5\n\
                 floor_height_m = 0.1";
    let at = |x: f64, y: f64| format!("kind = \"pressure\"\nx_m = {x}\ny_m = {y}");
    for (scene, x, y) in
        [("", 2.4, 0.1), (outflow, 2.5, 0.1), (outflow, 2.6, 0.3), (floor, 2.8, 0.1)]
    {
        assert_eq!(odd_with(scene, &at(x, y)), [""; 0], "{scene} {x} {y}");
    }
    let inside = "probe.y_m = 0.29: P stands inside the wall, which is 0.3000 m high from 2.5000 to 2.7000 m";
    assert!(odd_with(outflow, &at(2.6, 0.29))[0].starts_with(inside));
    assert!(odd_with(floor, &at(2.8, 0.09))[0].contains("or under the floor behind it"));
    // The story: a probe in the wall above its crest read 0 for the whole run.
    let in_wall = |y: f64| format!("kind = \"pressure\"\nwall = \"right\"\ny_m = {y}");
    assert_eq!(odd_with(outflow, &in_wall(0.3)), [""; 0]);
    let above = "probe.y_m = 0.31: P stands above the wall's crest, which is 0.3000 m high, and reads no pressure on the wall";
    assert!(odd_with(outflow, &in_wall(0.31))[0].starts_with(above));
    let level = |x: f64| format!("kind = \"level\"\nx_m = {x}");
    assert_eq!(odd_with("", &level(0.33)), [""; 0]);
    let passed = "probe.x_m = 0.32: P stands where the paddle goes, up to 0.326 m into the tank";
    assert!(odd_with("", &level(0.32))[0].starts_with(passed));
}

/// The story: a train in a tank of 12 m ran for 5 s and never reached its wall. Nothing was said, and
/// the wall had felt still water alone.
#[test]
fn a_train_that_ends_before_the_wall_is_told() {
    let train = |length: f64, end: f64| {
        odd(&format!(
            "tank_length_m = {length}\npaddle = \"wave-train\"\nwave_period_s = 1\nwave_height_ratio = 0.1\n\
             end_time_s = {end}"
        ))
    };
    assert_eq!(train(2.5, 5.0), [""; 0]);
    let told = train(12.0, 5.0);
    let starts = "scene.tank_length_m = 12: the run ends at 5.000 s, before the train can be at the wall, at 13.";
    assert!(told.len() == 1 && told[0].starts_with(starts), "{told:?}");
    assert!(told[0].contains("; with end_time_s = 2"), "{told:?}");
    assert_eq!(train(12.0, 15.0), [""; 0]);
}

/// A file with a stroke, and the scene that plays it for so many seconds.
fn played(points: &str, end: f64) -> (tempfile::TempDir, String) {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("stroke.csv");
    std::fs::write(&path, format!("time_s,stroke_m\n{points}")).unwrap();
    let scene = format!(
        "paddle = \"recorded-stroke\"\nrecorded_stroke = {:?}\nwave_height_ratio = 0.1\nend_time_s = {end}",
        path.to_str().unwrap()
    );
    (root, scene)
}

/// The story: a record that is quiet at first ended before its wave was at the wall, without a word.
#[test]
fn a_record_that_ends_before_the_wall_is_told() {
    let quiet = "0,0\n1,0\n2,0\n2.2,0.008\n2.4,0.035\n2.6,0.065\n2.8,0.09\n3,0.1\n";
    let (_root, scene) = played(quiet, 4.0);
    let told = odd(&scene);
    let starts = "scene.tank_length_m = 2.5: the run ends at 4.000 s, before the wave can be at the wall, at 4.0";
    assert!(told.len() == 1 && told[0].starts_with(starts), "{told:?}");
    let (_root, scene) = played(quiet, 5.0);
    assert_eq!(odd(&scene), [""; 0]);
}

/// The story: a volume of all the water was warned of as dry, and so was a gauge at a paddle that
/// only draws back. What such a volume does miss was not told.
#[test]
fn a_volume_misses_what_follows_the_paddle_back_and_nothing_else() {
    let volume = "kind = \"volume\"\nx_m = 0";
    assert_eq!(odd_with("", volume), [""; 0]);
    assert_eq!(odd_with("", &volume.replace("= 0", "= 0.1")), [""; 0]);
    assert!(
        odd_with("", "kind = \"discharge\"\nx_m = 0")[0].contains("stands where the paddle goes")
    );
    let (_root, scene) = played("0,0\n1,-0.1\n2,0\n", 5.0);
    assert_eq!(odd_with(&scene, "kind = \"level\"\nx_m = 0"), [""; 0]);
    let missed = "probe.x_m = 0: P counts water from x = 0 on, and the paddle goes up to 0.100 m back from there";
    let told = odd_with(&scene, volume);
    assert!(told.len() == 1 && told[0].starts_with(missed), "{told:?}");
    assert_eq!(odd_with(&scene, &volume.replace("= 0", "= 0.1")), [""; 0]);
}

/// The story: a gauge under a wall that leans over the water read its face all the time.
#[test]
fn a_gauge_under_a_wall_is_told() {
    let told = |kind: &str, x: f64| {
        odd_with("wall_angle_deg = 60", &format!("kind = \"{kind}\"\nx_m = {x}"))
    };
    let under =
        "probe.x_m = 2.4: P stands under the wall, which leans over the water: from 2.385 m on";
    for kind in ["level", "elevation"] {
        assert_eq!(told(kind, 2.38), [""; 0], "{kind}");
        let told = told(kind, 2.4);
        assert!(told.len() == 1 && told[0].starts_with(under), "{told:?}");
    }
    assert_eq!(told("volume", 2.4), [""; 0]);
    assert_eq!(odd_with("wall_angle_deg = 110", "kind = \"level\"\nx_m = 2.49"), [""; 0]);
}

/// The story: a column as long as its tank, still water between walls, began as if it were released. Nothing pressed the
/// wall before it, and F* was 1.5 in the first instants.
#[test]
fn a_column_that_fills_its_tank_cannot_be_released() {
    let told = |scene: &str| odd(&format!("kind = \"dam-break\"\n{scene}"));
    let full = "column_length_m = 1\ntank_length_m = 1\ninitial_density";
    assert_eq!(told("column_length_m = 1\ntank_length_m = 1"), [""; 0]);
    assert_eq!(told(&format!("{full} = \"hydrostatic\"")), [""; 0]);
    assert_eq!(told("initial_density = \"dam-break\""), [""; 0]);
    let odd = told(&format!("{full} = \"dam-break\""));
    let text = "scene.initial_density = \"dam-break\": the column fills its tank";
    assert!(odd.len() == 1 && odd[0].starts_with(text), "{odd:?}");
}
