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

#[test]
fn every_bad_file_is_told() {
    let bad = [
        ("name = \"a\"\n[gird]\nx = [1]", "gird: unknown key; did you mean grid?"),
        ("[grid]\nx = [1]", "name: is required"),
        ("name = \"a\"\n[grid]\n", "grid: holds no key"),
        (
            "name = \"a\"\nparticle_spacing_m = 0.02",
            "particle_spacing_m: unknown key; did you mean numerics.particle_spacing_m?",
        ),
        (
            "name = \"a\"\nwave_height_ratio = 0.2",
            "wave_height_ratio: unknown key; did you mean scene.wave_height_ratio?",
        ),
        (
            "name = \"a\"\ncolour = 1",
            "colour: unknown key; must be one of name, scene, numerics, probe, accuracy, limits, grid",
        ),
        // A shipped matrix was refused for unknown keys: nothing said whose file it is.
        ("name = \"a\"\n[[case]]\nname = \"b\"", "case: is of a matrix: `seawall accuracy FILE`"),
        (
            "name = \"H\u{f6}he\"",
            "name = \"H\u{f6}he\": must be a word of the letters a to z and A to Z",
        ),
        ("name = \"a b\"", "name = \"a b\": must be a word"),
        ("name = \"..\"", "name = \"..\": must be a word"),
        ("name = \"a\"\n[probe]\nname = \"P\"", "probe = "),
        ("name = \"a\"\n[accuracy]\nmax_error = 2", "accuracy.max_error: unknown key"),
        (
            "name = \"a\"\n[accuracy]\nmax_error_percent = 0",
            "accuracy.max_error_percent = 0: must be a finite number above 0",
        ),
        ("name = \"a\"\n[limits]\nstep = 2", "limits.step: unknown key; did you mean steps?"),
        ("name = \"a\"\n[limits]\nsteps = 0", "limits.steps = 0: must be a whole number from 1"),
        ("name = \"a\"\nscene = 3", "scene = 3: must be a table"),
        ("name = \"a\"\n[grid\n", "line 2: "),
        ("name = \"a\"\nname = \"b\"", "line 2: duplicate key"),
        (
            "name = \"a\"\n[numerics]\nparticle_spacing_m = 1cm",
            "line 3: particle_spacing_m = 1cm: write 0.01, without quotes: the unit, m, is in",
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
