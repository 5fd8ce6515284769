use super::*;

/// Whether a limit with these words is told.
fn told(scene: &str, numerics: &str, words: &str) -> bool {
    limits(&CaseConfig::of(scene, numerics)).iter().any(|limit| limit.contains(words))
}

/// The story: still water of `huang2019` with another boundary grew restless, and "3.3 % off" was told. Steep waves at
/// walls of 72 degrees passed without a word, and so did high ones over a crest. Steps of 1 ms were called too long:
/// only another key was looked at.
#[test]
fn what_was_measured_of_presets_walls_crests_and_steps_is_told() {
    let still = |numerics: &str| {
        let still = "kind = \"hydrostatic\"\nend_time_s = 5";
        ["3.3 %", "grows restless"].map(|words| told(still, numerics, words))
    };
    let normalized = "boundary = \"normalized\"";
    let source = format!("preset = \"huang2019\"\n{normalized}");
    assert_eq!(still(&source), [false, true]);
    assert_eq!(still(&format!("{source}\nghost_gravity = \"in-sum\"")), [false, false]);
    assert_eq!(still(&format!("{normalized}\nghost_gravity = \"at-mirror\"")), [true, false]);
    let leaning = |angle: f64, wave: f64| {
        let wall = format!("wall_angle_deg = {angle}\nwave_height_ratio = {wave}");
        told(&wall, "", "1.78, 1.92 and 2.14 h")
    };
    let at_72 = [0.5, 0.55, 0.65].map(|wave| leaning(72.0, wave));
    assert_eq!(at_72, [false, true, true]);
    assert_eq!([60.0, 80.0, 85.0].map(|angle| leaning(angle, 0.65)), [false, true, false]);
    let crest = |wave: f64, spacing: f64| {
        let crest =
            "tank_length_m = 2\nbehind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = 0.1";
        let numerics = format!("particle_spacing_m = {spacing}");
        told(&format!("{crest}\nwave_height_ratio = {wave}"), &numerics, "M* up to 4.2 %")
    };
    assert_eq!(
        [(0.5, 0.016), (0.65, 0.016), (0.65, 0.01)].map(|(h, d)| crest(h, d)),
        [false, true, false]
    );
    let steps = |own: &str| {
        let numerics = format!("scheme = \"isph\"\nlaplacian = \"schwaiger\"\n{own}");
        told("", &numerics, "leaves divergence")
    };
    let short = ["gravity_courant_number = 0.035", "time_step_s = 0.0009"];
    assert_eq!(short.map(steps), [false; 2]);
    assert_eq!(["", "time_step_s = 0.002"].map(steps), [true; 2]);
}

/// The story: a crest half a spacing over still water was taken without a word, and the water moved by itself.
#[test]
fn a_crest_near_the_still_water_is_told() {
    let near = |freeboard: f64| {
        let scene = format!(
            "tank_length_m = 2\nbehind = \"outflow\"\ncrest_freeboard_m = {freeboard}\ncrest_width_m = 0.2"
        );
        told(&scene, "particle_spacing_m = 0.02", "one and a half particle spacings")
    };
    assert_eq!([0.01, 0.029, 0.03, 0.1].map(near), [true, true, false, false]);
}

/// The story: with narrow supports incompressible water was off at steep waves, and the run said that forces hold. Bars that
/// were set for the other scheme were shown without a word, and so were those of narrow supports.
#[test]
fn what_bars_and_readings_were_not_set_for_is_told() {
    let isph = "scheme = \"isph\"";
    let breaks_up = |scene: &str, own: &str| told(scene, &format!("{isph}{own}"), "breaks up");
    let narrow = "\nsupport_radius_ratio = 4.0";
    let scenes = ["wave_height_ratio = 0.5", "wave_height_ratio = 0.3"];
    assert_eq!(scenes.map(|scene| breaks_up(scene, narrow)), [true, false]);
    assert!(
        !breaks_up(scenes[0], "") && !breaks_up("wave_height_ratio = 0.5\nwall_angle_deg = 60", "")
    );
    let bars = format!("{isph}\nerror_bars = \"pair\"");
    let narrow_bars = [isph, &bars, "error_bars = \"pair\""];
    assert_eq!(
        narrow_bars.map(|numerics| told("wave_height_ratio = 0.5", numerics, "are too narrow")),
        [false, true, false]
    );
    let support = |wave: f64, support: f64| {
        let numerics = format!("support_radius_ratio = {support}");
        told(&format!("wave_height_ratio = {wave}"), &numerics, "support_radius_ratio below 5")
    };
    assert_eq!(
        [(0.5, 4.0), (0.5, 5.0), (0.2, 4.0)].map(|(h, wide)| support(h, wide)),
        [true, false, false]
    );
    assert!(!told("wave_height_ratio = 0.5", "", "support_radius_ratio below 5"));
    let leaning = "wave_height_ratio = 0.5\nwall_angle_deg = 60";
    assert!(!told(leaning, "", "support_radius_ratio below 5"));
}

/// The story: at a narrow crest "error_bars = "pair" tells of each" stood beside a warning that there will be none.
#[test]
fn error_bars_are_proposed_where_a_companion_can_run() {
    let told = |width: f64| {
        let scene = format!(
            "tank_length_m = 2\nbehind = \"outflow\"\ncrest_freeboard_m = 0.1\ncrest_width_m = {width}"
        );
        let config = CaseConfig::of(&scene, "particle_spacing_m = 0.012");
        let told = limits(&config).into_iter().filter(|limit| limit.starts_with("a crest that"));
        let told: Vec<_> = told.collect();
        assert_eq!(told.len(), 1, "{told:?}");
        told[0].rsplit_once("; ").unwrap().1
    };
    assert_eq!(told(0.2), "error_bars = \"pair\" tells of each how far it may be off");
    assert_eq!(told(0.07), "error bars need a smaller particle_spacing_m here");
}
