//! How high waves run up beaches.

use crate::beds::{computed, computed_at};

/// R of a wave of H/h = 0.06 in ten rows of water, on a beach from 4 m on that ends at a length in metres and 0.3 m high.
/// The run ends so many seconds after the paddle's stroke.
fn runup_on_beach(length: &str, seconds: &str) -> f64 {
    let bed = format!("[[0, 0], [4, 0], [{length}, 0.3]]");
    runup_with(&format!("tank_length_m = {length}"), &bed, seconds)
}

fn runup_with(keys: &str, bed: &str, seconds: &str) -> f64 {
    let scene = format!(
        "{keys}\nstill_water_depth_m = 0.2\nwave_height_ratio = 0.06\nwave_gauge_m = 2\n\
         end_after_stroke_centre_s = {seconds}\nbed = {bed}"
    );
    computed(&scene, &[]).outcome.runup_max.value
}

/// R of a wave of H/h = 0.06 on 1:2 by the integral of linear theory for a plane beach (Synolakis 1987), ∫ Φ(k) 2/(J0 - i J1)
/// exp(-ikt) dk at 2k cot β. Before the water came to rest first, the edge sank by 16 mm, and R was 0.087.
#[test]
fn runup_on_a_steep_beach_is_that_of_linear_theory() {
    const EXACT: f64 = 0.1423;
    let runup = runup_on_beach("4.6", "4.5");
    println!("R {runup} h for {EXACT} h");
    assert!((-0.05..0.01).contains(&(runup / EXACT - 1.0)), "{runup}");
}

/// On gentler beaches the edge is read where the water is one spacing thick. That place rises less than the tip. By the same
/// integral, J0(2k √(x cot β)) in the numerator for the place x where still water is so thick, it rises by 0.1487 h at ten rows on 1:5;
/// the tip rises by 0.1995 h.
#[test]
fn water_one_spacing_thick_gets_as_high_as_by_linear_theory() {
    const EXACT: f64 = 0.1487;
    let runup = runup_on_beach("5.5", "5");
    println!("R {runup} h for {EXACT} h");
    assert!((runup / EXACT - 1.0).abs() < 0.04, "{runup}");
}

/// At a thickness that is given it is 0.1487 h where that is one spacing of ten rows. Half of it is a tongue whose particles
/// lie apart, which gets up to 0.1704 h.
#[test]
fn runup_is_told_at_the_thickness_that_is_asked_for() {
    for (thickness, exact) in [(0.02, 0.1487), (0.01, 0.1704)] {
        let keys = format!("tank_length_m = 5.5\nrunup_thickness_m = {thickness}");
        let runup = runup_with(&keys, "[[0, 0], [4, 0], [5.5, 0.3]]", "5");
        println!("R {runup} h for {exact} h, where water is {thickness} m thick");
        assert!((-0.08..0.05).contains(&(runup / exact - 1.0)), "{runup} for {exact}");
    }
}

/// Where a wave breaks the tongue is long. Read where it is one spacing thick, R was 0.44 h at ten rows and 0.53 h at fourteen.
#[test]
fn runup_at_a_thickness_does_not_hang_on_the_spacing() {
    let scene = "tank_length_m = 6\nbed = [[0, 0], [2, 0], [6, 0.4]]\nwave_gauge_m = 1\nwave_height_ratio = 0.3\n\
                 end_after_stroke_centre_s = 4\nrunup_thickness_m = 0.01";
    let [coarse, fine] =
        [10.0, 14.0].map(|rows| computed_at(0.2 / rows, scene, "", &[]).outcome.runup_max.value);
    println!("R {coarse} and {fine} h");
    assert!((coarse / fine - 1.0).abs() < 0.06, "{coarse} and {fine}");
}

/// The story: as the ridge before the wall ran dry, the runup fell from 0.6 to 0.1 h in one step, with water at the wall.
#[test]
fn runup_stays_at_the_wall_as_a_ridge_before_it_runs_dry() {
    let scene = "tank_length_m = 3.4\nstill_water_depth_m = 0.3\nwave_height_ratio = 0.4\nend_time_s = 3.3\n\
        bed = [[0, 0], [1, 0], [2.2, 0.34], [2.5, 0.31], [3.4, 0.31]]";
    let history = computed(scene, &[]).history;
    let falls = history.windows(2).map(|pair| pair[0].runup - pair[1].runup);
    let most = falls.fold(0.0, f64::max);
    let last = history.last().unwrap().runup;
    println!("{most} h in {} s, {last} h in the end", history[1].time_s);
    assert!(most < 0.2 && last > 0.3, "falls by {most} h at once, ends at {last} h");
}
