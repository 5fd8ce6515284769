//! Loads on the wall through the command line: files of a case, and the size of a prototype.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{Desk, ended};

/// A softly sprung wall in a short, coarse tank.
const SCENE: &str = r#"
name = "soft"
[scene]
tank_length_m = 1.0
wave_gauge_m = 0.5
end_after_stroke_centre_s = 1.0
wall = "movable"
wave_height_ratio = 0.4
spring_stiffness_n_per_m = 2e4
seawall_mass_kg_per_m = 50
[numerics]
particle_spacing_m = 0.02
"#;

fn row(path: &Path) -> BTreeMap<String, String> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    header.iter().map(str::to_owned).zip(row.iter().map(str::to_owned)).collect()
}

fn number(row: &BTreeMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name}: {:?}", row[name]))
}

#[test]
fn loads_have_columns_files_and_the_size_of_a_prototype() {
    let desk = Desk::new(SCENE);
    desk.run(&[]);
    let summary = row(&desk.out.join("summary.csv"));
    let id = &summary["case_id"];
    let value = |name: &str| number(&summary, name);
    // The spring holds k X, over ½ρgh² = 196.2 N/m.
    let spring = 2e4 * 0.2 * value("displacement_max") / 196.2;
    assert!((value("spring_force_max") / spring - 1.0).abs() < 1e-12);
    assert_eq!(summary["spring_force_max_time_s"], summary["displacement_max_time_s"]);
    assert!(value("moment_max") >= value("first_moment_max"));
    assert!(value("first_impulse") > 0.0 && value("rise_time_s") > 0.05);
    let envelope = row(&desk.out.join(format!("envelopes/{id}.csv")));
    let pressure = number(&envelope, "pressure_max_pa");

    let told = ended(0, &["report", &desk.dir, "--froude-scale", "20"]).out;
    assert!(told.contains("at Froude scale 1:20: "), "{told}");
    let large = row(&desk.out.join("tables/prototype.csv"));
    assert_eq!(large["froude_scale"], "1:20");
    for (name, small) in [
        ("force_max_kn_per_m", 0.1962 * 400.0 * value("force_max")),
        ("moment_max_kn_m_per_m", 0.01308 * 8000.0 * value("moment_max")),
        ("rise_time_s", 20_f64.sqrt() * value("rise_time_s")),
        ("displacement_max_m", 4.0 * value("displacement_max")),
        ("pressure_max_kpa", 0.02 * pressure),
    ] {
        assert!((number(&large, name) / small - 1.0).abs() < 1e-5, "{name}: {large:?}");
    }
    let heights = row(&desk.out.join("tables/prototype_envelope.csv"));
    assert_eq!((heights["froude_scale"].as_str(), heights["height_m"].as_str()), ("1:20", "0.2"));
    let page = fs::read_to_string(desk.out.join("report.html")).unwrap();
    assert!(page.contains("At the size of the prototype, Froude scale 1:20"));
    assert!(desk.out.join("figures/pressure-envelope.svg").is_file());

    // Without a scale they go, and nothing else knows of one.
    ended(0, &["report", &desk.dir]);
    assert!(!desk.out.join("tables/prototype.csv").exists());
    assert!(!fs::read_to_string(desk.out.join("report.html")).unwrap().contains("Froude"));
    assert_eq!(row(&desk.out.join("summary.csv")), summary);
    for bad in ["0", "-3", "twenty", "nan"] {
        let told = ended(2, &["report", &desk.dir, &format!("--froude-scale={bad}")]).err;
        assert!(told.contains("must be a number from 1e-6 to 1e6"), "{told}");
    }
}
