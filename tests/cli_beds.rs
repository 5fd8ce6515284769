//! Studies that sweep beds and flags: their cases are picked and told by values that are no numbers.

mod common;

use common::{expect_code, run, write_file};

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
    let root = tempfile::tempdir().unwrap();
    let (file, out) = (write_file(root.path(), BEDS), root.path().join("out"));
    let out = out.to_str().unwrap();
    expect_code(&run(&["sweep", file.to_str().unwrap(), "--out", out, "--film", "none"]), 0);
    // As the file writes a bed, or as tables do.
    for bed in ["[[0,0],[0.9,0],[1.2,0.04]]", "[[0, 0], [0.9, 0], [1.2, 0.04]]"] {
        let shown = run(&["show", out, &format!("bed={bed}"), "corrected_gradients=true"]);
        expect_code(&shown, 0);
    }
    let none = run(&["show", out, "bed=[[0,0],[0.9,0],[1.2,0.05]]", "corrected_gradients=true"]);
    expect_code(&none, 2);

    let told = run(&["compare", out, out]);
    expect_code(&told, 0);
    let told = String::from_utf8(told.stdout).unwrap();
    let bed = "bed = [[0, 0], [0.9, 0], [1.2, 0.02]], corrected_gradients = true";
    assert!(told.contains(bed), "{told}");
    assert!(told.contains("all at H/h = 0.5\n"), "no part of a bed: {told}");
}
