//! Studies that sweep beds and flags: their cases are picked and told by values that are no numbers.

use crate::common::{Desk, ended};

const BEDS: &str = r#"
name = "beds"
[scene]
tank_length_m = 1.2
wave_gauge_m = 0.5
end_after_stroke_centre_s = 0.6
[numerics]
particle_spacing_m = 0.04
[grid]
bed = [[[0, 0], [0.9, 0], [1.2, 0.02]], [[0, 0], [0.9, 0], [1.2, 0.04]]]
corrected_gradients = [true, false]
"#;

#[test]
fn beds_and_flags_pick_a_case_and_are_told_whole() {
    let desk = Desk::new(BEDS);
    ended(0, &["sweep", &desk.file, "--out", &desk.dir, "--film", "none"]);
    // As the file writes a bed, or as tables do.
    for bed in ["[[0,0],[0.9,0],[1.2,0.04]]", "[[0, 0], [0.9, 0], [1.2, 0.04]]"] {
        ended(0, &["show", &desk.dir, &format!("bed={bed}"), "corrected_gradients=true"]);
    }
    ended(2, &["show", &desk.dir, "bed=[[0,0],[0.9,0],[1.2,0.05]]", "corrected_gradients=true"]);

    let told = ended(0, &["compare", &desk.dir, &desk.dir]).out;
    let bed = "bed = [[0, 0], [0.9, 0], [1.2, 0.02]], corrected gradients = true";
    assert!(told.contains(bed), "{told}");
    assert!(told.contains("all at H/h = 0.5\n"), "no part of a bed: {told}");
    assert!(told.contains("R* of A") && !told.contains("X*"), "a fixed wall has none: {told}");
}

/// A cell of the table was wider than the program can write, and `check` ended in a panic.
#[test]
fn a_bed_of_many_points_is_listed_in_short() {
    let slope: Vec<_> = (0..3000_u32).map(|at| f64::from(at) * 1e-4).collect();
    let points: Vec<_> = slope.iter().map(|at| format!("[{}, {}]", 0.9 + at, 0.1 * at)).collect();
    let long = format!("[[0, 0], {}, [1.2, 0.03]]", points.join(", "));
    let desk = Desk::new(&BEDS.replacen("[[0, 0], [0.9, 0], [1.2, 0.02]]", &long, 1));
    let told = ended(0, &["check", &desk.file]).out;
    let mut rows = told.lines().take(5);
    assert!(rows.all(|row| row.len() < 300) && told.contains(" characters)"), "{told}");
}
