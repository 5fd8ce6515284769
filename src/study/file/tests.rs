use super::*;

#[test]
fn a_file_is_read_in_order() {
    let file = SweepFile::read(
        "name = \"a\"\n[grid]\nwave_height_ratio = [0.1]\nparticle_spacing_m = [0.02, 0.03]",
        &[],
    )
    .unwrap();
    let keys: Vec<_> = file.grid.iter().map(|axis| axis.key.as_str()).collect();
    assert_eq!(keys, ["wave_height_ratio", "particle_spacing_m"]);
}

/// More errors of bad files are in `tests/bad_inputs`.
#[test]
fn every_bad_file_is_told() {
    let bad = [
        // A shipped matrix was once refused only for unknown keys. The error did not say which
        // command takes it.
        ("name = \"a\"\n[[case]]\nname = \"b\"", "case: is for `seawall accuracy FILE`"),
        (
            "name = \"H\u{f6}he\"",
            "name = \"H\u{f6}he\": must be a word of the letters a to z and A to Z",
        ),
        (
            "name = \"a\"\n[grid]\nspring_stiffness_n_per_m = [10, 500 N/m]",
            "line 3: spring_stiffness_n_per_m = 500 N/m: write 500, without quotes",
        ),
    ];
    for (text, message) in bad {
        let told = SweepFile::read(text, &[]).unwrap_err().to_string();
        assert!(told.starts_with(message), "{told:?} should start with {message:?}");
    }
}
