use super::*;
use crate::scene::belongs;

fn case(scene: &str, numerics: &str) -> Result<CaseConfig, ConfigError> {
    CaseConfig::from_tables(&scene.parse().unwrap(), &numerics.parse().unwrap())
}

#[test]
fn defaults_are_the_papers_tank() {
    let config = case("", "").unwrap();
    let scene = config.scene.seawall().unwrap();
    assert_eq!(scene.still_water_depth_m, 0.2);
    assert_eq!(config.numerics.particle_spacing_m, 0.01);
    assert_eq!(config.numerics.support_radius_ratio, 5.0);
    let others =
        ["kind = \"dam-break\"", "wall_angle_deg = 120", "wave_height_ratio = 0\nend_time_s = 1"];
    for scene in others {
        assert_eq!(case(scene, "").unwrap().numerics.support_radius_ratio, 4.0);
        let set = case(scene, "support_radius_ratio = 4.5").unwrap();
        assert_eq!(set.numerics.support_radius_ratio, 4.5);
    }
}

/// More bad values are in `tests/bad_inputs`, file by file.
#[test]
fn every_bad_value_is_told_with_its_key() {
    let caisson = "wall = \"caisson\"\nseawall_mass_kg_per_m = 60\nstatic_friction = 0.6\n\
                   submerged_weight_n_per_m = 300\n";
    let [spring, friction] = ["spring_stiffness_n_per_m", "static_friction"]
        .map(|key| format!(" = 1: {}", belongs(key)));
    let bad = [
        ("", "kinetic_friction: is needed where wall = \"caisson\""),
        ("kinetic_friction = 0.7", " = 0.7: must be a number from 0 to 0.6"),
        (
            "kinetic_friction = 0.5\nthreshold_ratio = 1.2",
            "threshold_ratio = 1.2: is not for a caisson: leave it out",
        ),
        ("kinetic_friction = 0.5\nspring_stiffness_n_per_m = 1", spring.as_str()),
        (
            "kinetic_friction = 0.5\nwall_angle_deg = 100",
            " = 100: a caisson is vertical: leave it out, or set scene.wall = \"fixed\"",
        ),
    ];
    for (scene, message) in bad {
        told(case(&format!("{caisson}{scene}"), ""), "scene.", message);
    }
    told(case("static_friction = 1", ""), "scene.static_friction = 1", &friction);
    let bad = [
        ("error_bars = { a = 1 }", " = { a = 1 }: must be one of none, pair, triple"),
        ("corrected_gradients = 1", " = 1: must be true or false"),
        ("scheme = \"isph\"\nslip = \"no\"", " = \"no\": belongs to scheme = \"wcsph\""),
        ("preset = \"isph\"\nscheme = \"wcsph\"", ": preset = \"isph\" is of scheme = \"isph\""),
    ];
    for (numerics, message) in bad {
        told(case("", numerics), "numerics.", message);
    }
}

/// A limit of 1e5 steps was once refused as not being a whole number.
#[test]
fn a_whole_number_may_have_a_point_or_an_exponent() {
    let read = |retries: &str| case("", &format!("retries = {retries}")).unwrap();
    assert_eq!(read("2.0"), read("2"));
    assert_eq!(read("0.2e1"), read("2"));
}

/// Where viscosity bounds the step, half the Courant number changed nothing.
#[test]
fn a_retry_takes_half_the_step_whatever_bounds_it() {
    let narrow = "artificial_viscosity = 1\nsupport_radius_ratio = 2\ncourant_number = 2.5";
    for numerics in
        ["", narrow, "time_step_s = 1e-5", "scheme = \"isph\"\nartificial_viscosity = 1"]
    {
        let case = case("", numerics).unwrap();
        let step = |case: &CaseConfig| case.scene.frame().time_step(&case.numerics);
        let halved = step(&case.with_time_step_scaled(0.5));
        assert_eq!(halved, 0.5 * step(&case), "{numerics}");
    }
}

fn told(case: Result<CaseConfig, ConfigError>, section: &str, message: &str) {
    let told = case.unwrap_err().to_string();
    assert!(told.starts_with(section) && told.ends_with(message), "{told:?}: {message:?}");
}

#[test]
fn a_key_added_later_is_stored_only_off_its_default() {
    let stored = |scene: &str| Table::try_from(case(scene, "").unwrap().scene).unwrap();
    assert!(!stored("paddle = \"solitary\"").contains_key("paddle"));
    let waves = stored("paddle = \"wave-train\"\nwave_period_s = 1\nend_time_s = 1");
    assert_eq!(waves["paddle"].as_str(), Some("wave-train"));
    assert_eq!(waves["wave_period_s"].as_float(), Some(1.0));
}

#[test]
fn a_trunk_forgets_what_the_wall_does() {
    let movable = "wall = \"movable\"\nspring_stiffness_n_per_m = 10\nseawall_mass_kg_per_m = 50";
    let a = case(movable, "").unwrap();
    let b = case("wall = \"fixed\"", "").unwrap();
    assert_eq!(a.trunk(), b.trunk());
}
