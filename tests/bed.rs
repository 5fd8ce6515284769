//! Waves over beds that are not level, and what is refused.

use crate::beds::{computed, computed_with, gauges};
use crate::common::{Desk, ended, expect_refused, results};
use seawall::simulation::CaseResult;

/// A bed that ends level goes on behind the wall, where it is dry: no edge of the water, whose level at the wall
/// is that of the surface before it.
#[test]
fn runup_before_a_level_end_is_that_of_the_surface() {
    let springs = "wall = \"movable\"\nspring_stiffness_n_per_m = 1e5\nseawall_mass_kg_per_m = 50";
    for wall in ["", springs] {
        let scene = format!(
            "tank_length_m = 2.4\nstill_water_depth_m = 0.25\nwave_height_ratio = 0.2\nwave_gauge_m = 1\n\
             end_after_stroke_centre_s = 1.5\nbed = [[0, 0], [0.9, 0], [0.9, 0.1], [2.4, 0.1]]\n{wall}"
        );
        let wave = computed(&scene, &gauges(&[2.39]));
        let highest = wave.probes.as_ref().unwrap().values.iter().fold(0.0, |a: f64, b| a.max(*b));
        let runup = 0.25 * wave.outcome.runup_max.value;
        println!("runup {runup} m, surface before the wall {highest} m");
        assert!(highest > 0.1 && (runup / highest - 1.0).abs() < 0.1, "{runup} and {highest}");
    }
}

/// On a slope the water's edge is read low at rest, by a spacing or more. That was added where water stands at a wall or
/// lies on a level top, too. And before a wall that stands in water a ridge was taken for the edge whatever the wave.
#[test]
fn runup_behind_dry_ground_is_that_of_the_water_there() {
    for (bed, wave, wall) in [
        ("[[0, 0], [1.2, 0], [3, 0.21]]", 0.3, true),
        ("[[0, 0], [1.2, 0], [3, 0.19]]", 0.3, true),
        ("[[0, 0], [1.2, 0], [1.6, 0.22], [1.7, 0.22], [2.1, 0.05], [3, 0.05]]", 0.5, true),
        ("[[0, 0], [1.2, 0], [2.2, 0.25], [3, 0.25]]", 0.3, false),
    ] {
        let scene = format!(
            "tank_length_m = 3\nwave_height_ratio = {wave}\nwave_gauge_m = 1\nend_after_stroke_centre_s = 2.5\nbed = {bed}"
        );
        let case = computed(&scene, &gauges(&[2.999]));
        let highest = case.probes.unwrap().values.iter().fold(0.0, |a: f64, b| a.max(*b));
        let told = 0.2 * case.outcome.runup_max.value;
        let there = if wall { highest } else { 0.05 };
        println!("{bed}: {told} m, there {there} m");
        assert!((told - there).abs() < 0.005, "{bed}: {told} and {there}");
    }
}

/// A bed that is written out and level is the bed that needs no writing.
#[test]
fn a_level_bed_is_a_flat_tank() {
    let short = "tank_length_m = 1.6\nwave_gauge_m = 0.8\nend_after_stroke_centre_s = 1.2\n";
    let flat = computed(short, &[]);
    let level = computed(&format!("{short}bed = [[0, 0], [1, 0], [1.6, 0]]"), &[]);
    let maxima = |case: &CaseResult| {
        [case.outcome.force_max, case.outcome.runup_max].map(|extreme| extreme.value.to_bits())
    };
    assert_eq!(maxima(&flat), maxima(&level));
    assert!(!flat.history.is_empty() && flat.history == level.history);
}

/// A low sill far before a wall hardly matters, and it has a bed that gives back. Water that went along the bed with the
/// wall counted as running into it. It gathered at the wall's foot, and the wall went 1.229 h.
#[test]
fn a_wall_goes_as_far_over_a_bed_that_gives_back() {
    let travel = |bed: &str| {
        let scene = format!(
            "tank_length_m = 4\nstill_water_depth_m = 0.3\nwave_height_ratio = 0.25\nwave_gauge_m = 1\n\
             end_after_stroke_centre_s = 3.2\nwall = \"movable\"\nspring_stiffness_n_per_m = 500\n\
             seawall_mass_kg_per_m = 20\n{bed}"
        );
        let outcome = computed_with(&scene, "conservative_bed = true", &[]).outcome;
        (outcome.displacement_max.unwrap().value, outcome.energy_gap_percent)
    };
    let (level, _) = travel("");
    let (sill, gap) = travel("bed = [[0, 0], [1.5, 0], [1.6, 0.04], [1.7, 0], [4, 0]]");
    println!("X* {sill} with the sill, {level} without, energy gap {gap} %");
    assert!((sill / level - 1.0).abs() < 0.006 && gap.abs() < 0.4, "{sill} {level} {gap}");
}

/// Water that runs back over the edge of a step found up to 10 % of the paddle's work where the bed did not give back
/// what it did. From 12 √(gh) on, what stilled the water there fed it, and runs ended.
#[test]
fn water_that_runs_back_over_a_step_finds_no_energy() {
    let step = "tank_length_m = 2.5\nstill_water_depth_m = 0.2\nwave_height_ratio = 0.3\n\
                bed = [[0, 0], [1.5, 0], [1.5, 0.06], [2.5, 0.06]]";
    let forces = [8, 16].map(|sound| {
        let numerics = format!("sound_speed_ratio = {sound}");
        let wave = computed_with(step, &numerics, &[]).outcome;
        println!("c0 {sound}: {} %, {:?}", wave.energy_gap_percent, wave.force_max);
        assert!(wave.energy_gap_percent.abs() < 1.5, "{}", wave.energy_gap_percent);
        // The lattice settles on the bed: that gap goes as (Δx/h)², and takes nothing from the force.
        assert_eq!(wave.doubtful_reason, None);
        wave.force_max.value
    });
    assert!((forces[0] / forces[1] - 1.0).abs() < 0.02, "{forces:?}");
}

/// Over a step and before a wall that leans the volume of stirred water was not held, as it is in a tank that has neither.
/// The surface sank by 1.7, 2.5 and 5 mm between the second and the last ten seconds. Before the walls nothing told of it.
#[test]
fn water_stays_where_it_is_while_waves_come_back() {
    let step = "bed = [[0, 0], [0.6, 0], [0.6, 0.1], [1.2, 0.1]]";
    for tank in [step, "wall_angle_deg = 60", "wall_angle_deg = 120"] {
        let scene = format!(
            "tank_length_m = 1.2\nwave_gauge_m = 0.5\nwave_height_ratio = 0.2\nend_time_s = 40\n{tank}"
        );
        let case = computed(&scene, &gauges(&[0.6]));
        let level = |from: f64| {
            let during = case
                .probes
                .as_ref()
                .unwrap()
                .rows()
                .filter(|(time, _)| (from..from + 10.0).contains(time));
            let levels: Vec<f64> = during.map(|(_, row)| row[0]).collect();
            levels.iter().sum::<f64>() / levels.len() as f64
        };
        let sunk = level(10.0) - level(30.0);
        println!("{tank}: sunk by {sunk} m");
        assert!(sunk < 8e-4, "{tank}: sunk by {sunk} m");
    }
}

/// Depth h falls to h/2 over a slope; the time that a low wave takes is ∫ dx/√(g d).
#[test]
fn a_low_wave_takes_its_time_over_a_slope() {
    let scene = "tank_length_m = 6\nwave_height_ratio = 0.05\nend_time_s = 7.5\nwave_gauge_m = 1.5\n\
                 bed = [[0, 0], [1.5, 0], [4.5, 0.1], [6, 0.1]]";
    let places = [1.5, 4.5];
    let wave = computed(scene, &gauges(&places));
    let table = wave.probes.as_ref().unwrap();
    let crest = |column: usize| {
        // What the wall throws back comes later.
        let rows = table.rows().map(|(time, row)| (time, row[column]));
        rows.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    };
    let ([start, low], [end, high]) = ([0, 1].map(crest)).map(|(time, level)| [time, level]).into();
    let slope = 0.1 / 3.0;
    let exact = 2.0 * (0.2_f64.sqrt() - 0.1_f64.sqrt()) / (slope * 9.81_f64.sqrt());
    let faster = (1.0 + low / 0.2).sqrt();
    println!("{} s, {} s by the long-wave speed; {low} m to {high} m", end - start, exact / faster);
    assert!(((end - start) * faster / exact - 1.0).abs() < 0.06);
    // Between Green's law and a solitary wave that keeps its energy.
    assert!(high / low > 0.95 * 2.0_f64.powf(0.25) && high / low < 2.0, "{low} m, {high} m");
}

#[test]
fn threads_do_not_change_a_wave_on_a_beach() {
    let text = "name = \"beach\"\n[scene]\ntank_length_m = 2\nbed = [[0, 0], [1, 0], [2, 0.3]]\n\
                wave_gauge_m = 0.5\nend_time_s = 1.5\n[numerics]\nparticle_spacing_m = 0.025\n\
                boundary = \"normalized\"\n";
    let desk = Desk::new(text);
    let [one, two] = ["1", "2"].map(|threads| {
        let out = desk.path().join(threads);
        ended(0, &["run", &desk.file, "--out", out.to_str().unwrap(), "--threads", threads]);
        results(&out)
    });
    assert_eq!(one, two);
}

#[test]
fn json_has_the_runup_in_metres_and_a_recorded_clock_is_kept() {
    let root = tempfile::tempdir().unwrap();
    let stroke = root.path().join("stroke.csv");
    std::fs::write(&stroke, "time_s,stroke_m\n100,0\n100.5,0.1\n101,0.1\n").unwrap();
    let text = format!(
        "name = \"clock\"\n[scene]\ntank_length_m = 1.5\nwave_gauge_m = 0.5\npaddle = \"recorded-stroke\"\n\
         recorded_stroke = {stroke:?}\nwave_height_ratio = 0.3\nend_time_s = 101.5\n[numerics]\n\
         particle_spacing_m = 0.025\n[[probe]]\nname = \"high\"\nkind = \"elevation\"\nx_m = 1.2\n"
    );
    let desk = Desk::new(&text);
    let told = desk.run(&["--format", "json"]).json();
    let [ratio, metres] = [&told["outcome"]["runup_max"]["value"], &told["runup_max_m"]];
    assert!((ratio.as_f64().unwrap() * 0.2 - metres.as_f64().unwrap()).abs() < 1e-12);
    assert!(metres.as_f64().unwrap() > 0.02, "{metres}");
    let times: Vec<f64> = results(&desk.out)
        .iter()
        .filter(|(name, _)| name.starts_with("histories"))
        .flat_map(|(_, bytes)| {
            String::from_utf8(bytes.clone())
                .unwrap()
                .lines()
                .skip(1)
                .map(|line| line.split(',').next().unwrap().parse().unwrap())
                .collect::<Vec<f64>>()
        })
        .collect();
    let apart = times.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(times[0] == 100.0 && times.last().unwrap() >= &101.49 && apart < 0.02, "{times:?}");
}

#[test]
fn what_is_no_bed_is_told() {
    for (keys, told) in [
        ("bed = 3", "scene.bed = 3: must be a list of points [x, y]"),
        ("bed = [[0, 0]]", "must have two points [x, y] or more"),
        ("bed = [[0, 0], [2, 0], [1, 0.1]]", "goes back from x = 2 m to 1 m"),
        ("bed = [[0, 0], [2, 0.1]]\ntank_length_m = 2", "must be level as far as the paddle goes"),
        // Looked at once a period it never went anywhere.
        (
            "bed = [[0, 0], [0.06, 0], [2.5, 0.1]]\npaddle = \"wave-train\"\nwave_period_s = 1\n\
             wave_height_ratio = 0.3\nend_time_s = 200",
            "must be level as far as the paddle goes",
        ),
        (
            "bed = [[0, 0], [1, 0], [2, 0.1]]",
            "scene.tank_length_m = 2.5: must be 2, where the bed ends",
        ),
        (
            "bed = [[0, 0], [1, 0], [2, 0.1]]\ntank_length_m = 2\nwall_angle_deg = 60",
            "ends at an upright wall",
        ),
        (
            "bed = [[0, 0], [1, 0], [2, 0.1]]\ntank_length_m = 2\nwall = \"movable\"\n\
             spring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 10",
            "must end level and under still water where the wall moves",
        ),
        ("bed = [[0, 0], [1, 0], [2, -0.1]]\ntank_length_m = 2", "must be its lowest place"),
        (
            "bed = [[0, 0], [1, 0], [2, 0.1]]\ntank_length_m = 2\n[numerics]\nscheme = \"isph\"",
            "is for scheme = \"wcsph\": isph knows level beds alone",
        ),
    ] {
        expect_refused(&format!("name = \"bed\"\n[scene]\n{keys}\n"), told);
    }
}
