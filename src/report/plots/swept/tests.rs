use super::*;
use crate::quantities::summary::{LOG10_K_STAR, RUNUP_MAX, SPRING_STIFFNESS};
use crate::report::fixture;

/// A sweep of masses at one stiffness, with the grid's keys in its manifest.
fn masses(stiffnesses: &[f64]) -> tempfile::TempDir {
    let directory = fixture::movable(&[0.3, 0.5], stiffnesses, &[50.0, 100.0, 250.0]);
    let keys = r#"{"keys": ["wave_height_ratio", "seawall_mass_kg_per_m"]}"#;
    std::fs::write(directory.path().join("manifest.json"), keys).unwrap();
    directory
}

#[test]
fn one_figure_takes_the_place_of_one_point_panels() {
    let (_directory, data) = fixture::read(masses(&[500.0]));
    let key = key(&data).unwrap();
    assert_eq!(key.name, "seawall_mass_kg_per_m");
    let figures = figures(&data, key);
    let names: Vec<_> = figures.iter().map(|figure| figure.name.as_str()).collect();
    assert_eq!(names, ["swept-seawall-mass-kg-per-m"]);
    assert!(figures[0].caption.contains("Force coupling s = 1."), "{}", figures[0].caption);
    for word in ["m, kg/m", "F / (½ρgh²)", "R / h", "X / h", "H/h = 0.3"] {
        assert!(figures[0].svg().contains(word), "{word}");
    }
    let all = super::super::all(&data).unwrap();
    assert!(!all.iter().any(|figure| figure.name.starts_with("response")));
}

#[test]
fn values_that_differ_little_or_are_long_have_figures_of_their_own() {
    let directory = fixture::movable(&[0.3], &[500.0], &[50.0, 100.0, 150.0, 200.0]);
    let (_directory, mut data) = fixture::read(directory);
    let masses = Key::new("seawall_mass_kg_per_m", ["50", "100", "50", "100"]);
    let bed = |last: u8| format!("[[0, 0], {}[9, 0.00{last}]]", "[1.25, 0.125], ".repeat(40));
    let beds = [bed(1), bed(1), bed(2), bed(2)];
    for (name, cells, ends) in [
        ("tank_length_m", ["2.50001", "2.50001", "2.50002", "2.50002"], ["2.50001", "2.50002"]),
        (BED, beds.each_ref().map(String::as_str), ["number-1", "number-2"]),
    ] {
        data.keys = vec![masses.clone(), Key::new(name, cells)];
        let figures = figures(&data, &masses);
        let stem = format!("swept-seawall-mass-kg-per-m-{}", name.replace('_', "-"));
        let names: Vec<_> = figures.iter().map(|figure| figure.name.clone()).collect();
        assert_eq!(names, ends.map(|end| format!("{stem}-{end}")));
    }
}

#[test]
fn beds_stand_by_their_slopes() {
    assert_eq!(beds::slope("[[0, 0], [1, 0], [3, 0.5]]"), Some(0.25));
    assert_eq!(beds::slope("[[0, 0], [2.5, 0]]"), Some(0.0));
    assert_eq!(beds::slope("[[0, 0], [2.5, 0], [2.5, 0.1]]"), None, "a step at the wall");
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.3], &[500.0], &[50.0, 100.0]));
    let cells = ["[[0, 0], [1, 0], [2, 0.1]]", "[[0, 0], [1, 0], [2, 0.05]]"];
    data.keys = vec![Key::new(BED, cells)];
    let figures = figures(&data, key(&data).unwrap());
    assert_eq!(figures.len(), 1);
    assert!(figures[0].svg().contains("mean slope of the bed"));
    let told = " F* counts by the depth at the wall, or by the still water's";
    assert!(figures[0].caption.contains(told), "depths differ: {}", figures[0].caption);
}

/// Sills that end at the paddle's level all have the mean slope 0: their study had no figure.
#[test]
fn sills_stand_by_their_heights() {
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.3], &[500.0], &[50.0, 100.0]));
    let cells = [
        "[[0, 0], [1, 0], [1.1, 0.05], [1.2, 0], [2, 0]]",
        "[[0, 0], [1, 0], [1.1, 0.1], [1.2, 0], [2, 0]]",
    ];
    data.keys = vec![Key::new(BED, cells)];
    let figures = figures(&data, key(&data).unwrap());
    assert_eq!(figures.len(), 1);
    assert!(figures[0].svg().contains("highest place of the bed, m"));
}

/// Only studies that swept the bed named the depth that scales F*. Over one bed, F* of 0, 95 and 5
/// in 0.12 to 0.28 m of water stood without it.
#[test]
fn a_sweep_over_a_bed_tells_by_which_depth_forces_count() {
    let (_directory, mut data) = fixture::read(fixture::movable(&[0.3], &[500.0], &[50.0, 100.0]));
    data.keys = vec![Key::new("still_water_depth_m", ["0.2", "0.3"])];
    let told = |data: &Loaded| {
        let figures = figures(data, key(data).unwrap());
        figures[0].caption.contains(" F* counts by the depth at the wall, or by the still")
    };
    assert!(!told(&data));
    let file = "[scene]\nbed = [[0, 0], [1, 0], [2.5, 0.1]]\n[numerics]\n[grid]\nstill_water_depth_m = [0.2, 0.3]\n";
    assert!(told(&data.made_from(file, &[])));
}

#[test]
fn two_stiffnesses_make_response_curves() {
    let directory = masses(&[10.0, 500.0]);
    assert_eq!(key(&Loaded::read(directory.path()).unwrap()), None);
}

#[test]
fn scenes_without_a_wave_have_one_curve() {
    let (_directory, data) = fixture::read(fixture::dam_breaks(5));
    let figures = figures(&data, key(&data).unwrap());
    assert_eq!(figures.len(), 1);
    assert!(figures[0].svg().contains("column height, m"));
    assert!(!figures[0].svg().contains("H/h"));
    assert!(!figures[0].caption.contains("wave height"));
    // A collapsing column has no first impact.
    let told = "runup of the whole run, against";
    assert!(figures[0].caption.contains(told), "{}", figures[0].caption);
}

/// The story: some regular waves had a first impact and others not, but one curve joined them.
#[test]
fn regular_waves_are_drawn_by_their_whole_runs() {
    let (_directory, mut data) = fixture::read(masses(&[500.0]));
    data.rows.iter_mut().for_each(|row| row.regular = true);
    let figures = figures(&data, key(&data).unwrap());
    assert!(figures[0].caption.contains("runup of the whole run, and"), "{}", figures[0].caption);
    let svg = figures[0].svg();
    let drawn = |column: &Column| svg.contains(&format!("\"{}\"", column.name));
    assert!(drawn(&FORCE_MAX) && drawn(&RUNUP_MAX) && !drawn(&FIRST_FORCE_MAX));
}

/// The story: caissons under several waves were in no figure of responses.
#[test]
fn caissons_stand_against_their_waves() {
    let directory = fixture::movable(&[0.3, 0.4, 0.5], &[500.0], &[50.0]);
    let (_directory, mut data) = fixture::read(directory);
    data.set_all(&SPRING_STIFFNESS, "").set_all(&LOG10_K_STAR, "");
    let figures = super::super::all(&data).unwrap();
    let own = figures.iter().find(|figure| figure.name == "caissons-against-wave").unwrap();
    for word in ["H/h", "F / (½ρgh²)", "R / h", "X / h", "m = 50 kg/m"] {
        assert!(own.svg().contains(word), "{word}");
    }
    assert!(own.caption.contains("largest displacement of the run, against the nominal wave"));
    // They are not drawn twice if another figure has them.
    let friction = Key::new("static_friction", ["0.4", "0.5", "0.6"]);
    assert!(caissons(&data, Some(&friction)).is_empty());
    data.rows.truncate(1);
    assert!(caissons(&data, None).is_empty(), "one wave makes no curve");
}
