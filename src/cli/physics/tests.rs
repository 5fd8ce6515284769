use super::*;
use crate::study::SweepFile;

fn value(text: &str, name: &str) -> Option<String> {
    let text = format!("name = \"a\"\n{text}");
    let lines = physics(&Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap());
    lines.into_iter().find(|line| line.name == name).map(|line| line.text(&text))
}

#[test]
fn what_is_on_is_told_and_only_that() {
    let some = |text: &str| Some(text.to_owned());
    for off in ["kinematic_viscosity_m2_per_s", "retries", "stop_when_settled", "probes"] {
        assert_eq!(value("", off), None, "{off}");
    }
    let on = "[numerics]\nkinematic_viscosity_m2_per_s = 1e-6\nretries = 2\n\
              stop_when_settled = true\nprecision = \"f32\"\n\
              [[probe]]\nname = \"P1\"\nkind = \"level\"\nx_m = 1";
    assert_eq!(value(on, "kinematic_viscosity_m2_per_s"), some("0.000001 m²/s"));
    assert_eq!(value(on, "retries"), some("2"));
    assert_eq!(value(on, "stop_when_settled"), some("yes"));
    assert_eq!(value(on, "precision"), some("f32"));
    assert_eq!(value(on, "probes"), some("P1"));
}

/// The story: the relaxation time of a beach was printed as `5.711372491708257 s`.
#[test]
fn a_derived_number_has_few_digits_and_a_written_one_all() {
    let bed = "[scene]\nbed = [[0, 0], [2.25, 0], [4, 0.35]]\ntank_length_m = 4\n";
    let told = |more: &str| value(&format!("{bed}{more}"), "relaxation_time_s").unwrap();
    assert_eq!(told(""), "5.711 s");
    let written = "[numerics]\nrelaxation_time_s = 5.711372491708257";
    assert_eq!(told(written), "5.711372491708257 s");
}

#[test]
fn a_scheme_and_a_wall_show_their_own_keys() {
    let some = |text: &str| Some(text.to_owned());
    let isph = "[numerics]\nscheme = \"isph\"";
    assert_eq!(value(isph, "laplacian"), some("exact"));
    assert_eq!(value("", "laplacian"), None);
    for other in ["boundary", "density_diffusion", "bulk_damping", "sound_speed_ratio"] {
        assert_eq!(value(isph, other), None, "{other}");
        assert!(value("", other).is_some(), "{other}");
    }
    let both = "[grid]\nscheme = [\"wcsph\", \"isph\"]";
    assert_eq!(value(both, "scheme"), some("wcsph, isph"));
    assert_eq!(value(both, "laplacian"), some("none, exact"));
    assert_eq!(value("[scene]\nkind = \"rotating-patch\"", "wall"), None);
    let movable = "[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                   spring_stiffness_n_per_m = 10";
    assert_eq!(value(movable, "wall_angle_deg"), None);
    assert_eq!(value(movable, "spring_stiffness_n_per_m"), some("10 N/m"));
    assert_eq!(value("", "wall_angle_deg"), some("90 °"));
    let many = "[grid]\nwave_height_ratio = { from = 0.1, to = 0.5, points = 9 }";
    let told = "0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, ... (9 values)";
    assert_eq!(value(many, "wave_height_ratio"), some(told));
}

/// The story: of a million cases a table of all keys was made, which took a third of the time.
#[test]
fn what_a_case_has_in_common_with_the_one_before_is_not_looked_at_again() {
    let movable = "[scene]\nseawall_mass_kg_per_m = 50\nspring_stiffness_n_per_m = 10\n";
    for text in [
        "[grid]\nwave_height_ratio = [0.1, 0.2, 0.3]\ntank_length_m = [2, 3]",
        "[grid]\nwall = [\"fixed\", \"movable\"]\nseawall_mass_kg_per_m = [50, 60]\n\
         spring_stiffness_n_per_m = [0, 1, 2]",
        "[grid]\nkernel = [\"wendland-c2\", \"gaussian\"]\nwave_height_ratio = [0.1, 0.2]",
        "[grid]\nartificial_viscosity = [0.0, 0.1]\nwall_angle_deg = [90, 80, 70]",
        "[grid]\nwave_height_ratio = [0.3, 0.8]\nend_after_stroke_centre_s = [2, 3, 60]",
        "[scene]\nend_time_s = 3\n[grid]\nwave_height_ratio = [0.0, 0.2, 0.0003, 0.1]",
        &format!(
            "{movable}wall = \"movable\"\n[grid]\nforce_coupling = [0.0, 0.5, 1.0]\n\
         still_water_depth_m = [0.2, 0.25]"
        ),
    ] {
        let text = format!("name = \"a\"\n{text}");
        let study = Study::new(&SweepFile::read(&text, &[]).unwrap()).unwrap();
        let keys = keys(&study);
        let of = |column: Column| (column.is_on, column.values);
        let at_once: Vec<_> = occurring(&keys, &study.cases).into_iter().map(of).collect();
        let mut apart: Vec<Column> = keys.iter().map(|_| Column::default()).collect();
        for case in study.cases.chunks(1).map(|case| occurring(&keys, case)) {
            for (column, more) in apart.iter_mut().zip(case) {
                column.is_on |= more.is_on;
                more.values.into_iter().for_each(|value| column.take(value));
            }
        }
        let apart: Vec<_> = apart.into_iter().map(of).collect();
        assert_eq!(at_once, apart, "{text}");
    }
}
