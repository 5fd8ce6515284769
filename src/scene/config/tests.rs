use serde::de::DeserializeOwned;

use super::*;
use crate::boundary::BoundaryChoice;
use crate::kernel::KernelChoice;
use crate::keys::Shape;
use crate::scene::WallChoice;

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

#[test]
fn every_bad_value_is_told_with_its_key() {
    let (boundaries, kinds) = (one_of::<BoundaryChoice>(), one_of::<Kind>());
    let (walls, kernels) = (one_of::<WallChoice>(), one_of::<KernelChoice>());
    let spring = "spring_stiffness_n_per_m = 1\nseawall_mass_kg_per_m = 1";
    let bad = [
        ("still_water_dept_m = 1", ": unknown key; did you mean still_water_depth_m?"),
        ("wave_height_ratio = \"high\"", " = \"high\": must be a number"),
        ("wall = \"moveable\"", &format!(": {walls}; did you mean movable?")),
        ("kind = \"lake\"", &format!(" = \"lake\": {kinds}")),
        ("kind = \"dambreak\"", &format!(": {kinds}; did you mean dam-break?")),
        (
            "kind = \"hydrostatic\"\nseawall_mass_kg_per_m = 1",
            ": unknown key of kind = \"hydrostatic\"; kind = \"seawall\" has it",
        ),
        ("particle_spacing_m = 0.01", ": unknown key; did you mean numerics.particle_spacing_m?"),
        ("wave_height_ratio = 0", "scene.end_time_s: is needed where wave_height_ratio = 0"),
        (spring, "scene.spring_stiffness_n_per_m = 1: belongs to wall = \"movable\""),
        (
            "wall = \"movable\"",
            "scene.spring_stiffness_n_per_m: is needed where wall = \"movable\"",
        ),
        (
            &format!("wall = \"movable\"\nwall_angle_deg = 120\n{spring}"),
            "scene.wall_angle_deg = 120: a movable wall is vertical: leave it out, or set \
             scene.wall = \"fixed\"",
        ),
    ];
    for (scene, message) in bad {
        told(case(scene, ""), "scene.", message);
    }
    let caisson = "wall = \"caisson\"\nseawall_mass_kg_per_m = 60\nstatic_friction = 0.6\n\
                   submerged_weight_n_per_m = 300\n";
    let bad = [
        ("", "kinetic_friction: is needed where wall = \"caisson\""),
        ("kinetic_friction = 0.7", " = 0.7: must be a number from 0 to 0.6"),
        (
            "kinetic_friction = 0.5\nthreshold_ratio = 1.2",
            "threshold_ratio = 1.2: is not for a caisson: leave it out",
        ),
        (
            "kinetic_friction = 0.5\nspring_stiffness_n_per_m = 1",
            " = 1: belongs to wall = \"movable\"",
        ),
        (
            "kinetic_friction = 0.5\nwall_angle_deg = 100",
            " = 100: a caisson is vertical: leave it out, or set scene.wall = \"fixed\"",
        ),
    ];
    for (scene, message) in bad {
        told(case(&format!("{caisson}{scene}"), ""), "scene.", message);
    }
    let message = "scene.static_friction = 1: belongs to wall = \"caisson\"";
    told(case("static_friction = 1", ""), "scene.", message);
    let bad = [
        ("colour = 1", "numerics.colour: unknown key (`seawall explain` lists all)"),
        ("wave_height_ratio = 0.3", ": unknown key; did you mean scene.wave_height_ratio?"),
        ("preset = \"fast\"", " = \"fast\": must be one of default, huang2019, isph"),
        ("particle_spacing_m = -0.01", " = -0.01: must be a finite number above 0"),
        ("particle_spacing_m = nan", " = NaN: must be a finite number above 0"),
        ("kernel = 3", &format!(" = 3: {kernels}")),
        ("error_bars = { a = 1 }", " = { a = 1 }: must be one of none, pair, triple"),
        ("boundary = \"sdfi\"", &format!(" = \"sdfi\": {boundaries}; did you mean sfdi?")),
        ("boundary = \"brick\"", &format!(" = \"brick\": {boundaries}")),
        ("retries = -1", " = -1: must be a whole number, 0 or above"),
        ("retries = 1.5", " = 1.5: must be a whole number, 0 or above"),
        ("retries = 7", " = 7: must be a whole number from 0 to 6"),
        ("corrected_gradients = 1", " = 1: must be true or false"),
        ("laplacian = \"exact\"", " = \"exact\": belongs to scheme = \"isph\""),
        ("scheme = \"isph\"\nslip = \"no\"", " = \"no\": belongs to scheme = \"wcsph\""),
        ("preset = \"isph\"\nscheme = \"wcsph\"", ": preset = \"isph\" is of scheme = \"isph\""),
    ];
    for (numerics, message) in bad {
        told(case("", numerics), "numerics.", message);
    }
}

/// A limit of 1e5 steps was refused as no whole number.
#[test]
fn a_whole_number_may_have_a_point_or_an_exponent() {
    let read = |retries: &str| case("", &format!("retries = {retries}")).unwrap();
    assert_eq!(read("2.0"), read("2"));
    assert_eq!(read("0.2e1"), read("2"));
}

/// What a value is told that is none of the names of a choice.
fn one_of<T: DeserializeOwned>() -> String {
    let Shape::Names(names) = Shape::of::<T>() else { panic!("it has no names") };
    format!("must be one of {}", names.join(", "))
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
