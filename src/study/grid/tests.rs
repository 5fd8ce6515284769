use super::*;
use crate::scene::belongs;

fn cases(text: &str) -> Result<Vec<Case>, ConfigError> {
    expand(&SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).unwrap())
}

#[test]
fn the_last_axis_runs_fastest() {
    let cases =
        cases("[grid]\nwave_height_ratio = [0.2, 0.3]\nparticle_spacing_m = [0.01, 0.02, 0.04]")
            .unwrap();
    let spacings: Vec<_> =
        cases.iter().map(|case| case.config.numerics.particle_spacing_m).collect();
    assert_eq!(spacings, [0.01, 0.02, 0.04, 0.01, 0.02, 0.04]);
    assert_eq!(cases[3].index, 3);
    assert_eq!(cases[3].assignments[0], Some(Value::Float(0.3).into()));
}

#[test]
fn fixed_walls_among_movable_ones_stand_once() {
    let cases = cases(
        "[scene]\nseawall_mass_kg_per_m = 50\n\
         [grid]\nwall = [\"fixed\", \"movable\"]\nspring_stiffness_n_per_m = [1, 10, 100]",
    )
    .unwrap();
    assert_eq!(cases.len(), 1 + 3);
    assert_eq!(cases[0].assignments, [Some(Value::String("fixed".into()).into()), None]);
    assert_eq!(cases[1].index, 1);
}

#[test]
fn every_wall_and_every_paddle_takes_its_own_keys() {
    let walls = cases(
        "[scene]\nseawall_mass_kg_per_m = 50\nspring_stiffness_n_per_m = 1\n\
         static_friction = 0.6\nkinetic_friction = 0.5\nsubmerged_weight_n_per_m = 300\n\
         [grid]\nwall = [\"fixed\", \"movable\", \"caisson\"]\nthreshold_ratio = [1.1, 1.2]",
    );
    assert_eq!(walls.unwrap().len(), 2 + 2 + 1);
    let paddles = cases(
        "[scene]\nend_time_s = 1\n\
         [grid]\npaddle = [\"solitary\", \"wave-train\"]\nwave_period_s = [0.9, 1]",
    );
    assert_eq!(paddles.unwrap().len(), 1 + 2);
}

/// More bad grids are in `tests/bad_inputs`.
#[test]
fn every_bad_grid_is_told_with_its_key() {
    let spring =
        format!("grid.spring_stiffness_n_per_m = 1: {}", belongs("spring_stiffness_n_per_m"));
    let bad = [
        (
            "[grid]\nparticle_spacing_m = [0.02, 1e-5]",
            "grid.particle_spacing_m = 0.00001: would cut 0.5 m² of water into 5,000,000,000",
        ),
        ("[grid]\nspring_stiffness_n_per_m = [1]", &spring),
        (
            "[numerics]\nkernel = \"gaussian\"\n[grid]\nkernel = [\"gaussian\"]",
            "numerics.kernel = \"gaussian\": stands in [numerics] and in [grid]",
        ),
        (
            "[grid]\nwave_height_ratio = { from = 0.1, to = 0.7, points = 1001 }\n\
             artificial_viscosity = { from = 0, to = 1, points = 1000 }",
            "grid = 1001 x 1000: must have at most 1000000 cases",
        ),
    ];
    for (text, message) in bad {
        let told = cases(text).unwrap_err().to_string();
        assert!(told.starts_with(message), "{told:?} should start with {message:?}");
    }
}

/// What stands in the first column of a grid.
fn first_values(text: &str) -> Result<Vec<Value>, ConfigError> {
    let first = |case: &Case| case.assignments[0].as_deref().cloned().unwrap();
    Ok(cases(text)?.iter().map(first).collect())
}

#[test]
fn a_range_of_a_whole_key_has_whole_numbers() {
    let cells = |range: &str| {
        first_values(&format!("[scene]\nkind = \"taylor-green\"\n[grid]\ncells = {{ {range} }}"))
    };
    let even = cells("from = 1, to = 7, points = 4").unwrap();
    assert_eq!(even, [1, 3, 5, 7].map(Value::Integer));
    let doubled = cells("from = 2, to = 16, points = 4, spacing = \"log\"").unwrap();
    assert_eq!(doubled, [2, 4, 8, 16].map(Value::Integer));
    let told = cells("from = 1, to = 4, points = 3").unwrap_err().to_string();
    assert!(told.starts_with("grid.cells = 2.5: must be a whole number"), "{told}");
    // Where any number will do, they stay what they were.
    let depths = "[scene]\ntank_length_m = 9\n[grid]\nstill_water_depth_m = { from = 1, to = 2, points = 2 }";
    assert_eq!(first_values(depths).unwrap(), [1.0, 2.0].map(Value::Float));
}

/// The story: three runs of one recorded stroke were told as waves of 0.1, 0.2 and 0.4 h.
#[test]
fn the_height_of_a_recorded_wave_cannot_be_swept() {
    let scene = "[scene]\npaddle = \"recorded-stroke\"\nend_time_s = 3\n\
                 recorded_stroke = \"sweeps/scenes/recorded_stroke.csv\"\n";
    let told = cases(&format!("{scene}[grid]\nwave_height_ratio = [0.1, 0.2]")).unwrap_err();
    assert!(told.to_string().starts_with("grid.wave_height_ratio: changes no wave"), "{told}");
    assert_eq!(cases(&format!("{scene}[grid]\nwave_gauge_m = [1.0, 1.5]")).unwrap().len(), 2);
}
