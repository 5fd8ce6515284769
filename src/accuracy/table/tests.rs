use super::*;
use crate::pairs::Precision;

fn config(wave: f64) -> CaseConfig {
    CaseConfig::of(&format!("wave_height_ratio = {wave:?}"), "")
}

fn table() -> AccuracyTable {
    let text = r#"
name = "a"
[[case]]
name = "low"
about = ""
scene = { wave_height_ratio = 0.2 }
[[case]]
name = "high"
about = ""
scene = { wave_height_ratio = 0.6 }
[[method]]
name = "coarse"
numerics = { particle_spacing_m = 0.02 }
[[method]]
name = "fine"
numerics = { particle_spacing_m = 0.01 }
[[method]]
name = "other"
numerics = { particle_spacing_m = 0.04, precision = "f32" }
[[method]]
name = "lucky"
numerics = { particle_spacing_m = 0.04, boundary = "dummy" }
"#;
    let rows = "case,method,force_error_percent,displacement_error_percent,cpu_time_s\n\
                low,coarse,-1.0,,1\nlow,fine,0.5,,8\nhigh,coarse,3.0,,1\nhigh,fine,1.5,,8\n\
                low,other,0.0,,0.5\nhigh,other,9.0,,0.5\nlow,lucky,0.0,,0.1\nhigh,lucky,0.0,,0.1\nall,fine,,,9\n";
    AccuracyTable::read(&Matrix::read(text).unwrap(), rows)
}

#[test]
fn the_cheapest_method_that_is_good_enough_is_chosen() {
    let spacing = |choice: &Choice| choice.config.numerics.particle_spacing_m;
    let swept = ["precision".to_owned()];
    let choose = |wave, percent, swept: &[String]| {
        table().choose(&config(wave), percent, 1.0, swept).unwrap()
    };
    let low = choose(0.2, 2.0, &[]);
    assert!(low.method == "other" && low.config.numerics.precision == Precision::F32 && low.meets);
    let low = choose(0.2, 2.0, &swept);
    assert!((spacing(&low) - 0.02).abs() < 1e-12 && low.meets, "what is swept stays");
    let between = choose(0.4, 2.0, &[]);
    assert!((spacing(&between) - 0.01).abs() < 1e-12);
    assert_eq!((between.expected_percent, &*between.because), (1.5, "low, high"));
    assert!(!choose(0.6, 1.0, &[]).meets);
    let finer = table().choose(&config(0.2), 2.0, 0.06, &[]).unwrap();
    assert!((spacing(&finer) - 0.01).abs() < 1e-12);
    let mut own = config(0.2);
    own.numerics.precision = Precision::F32;
    assert_eq!(table().choose(&own, 2.0, 1.0, &[]).unwrap().method, "coarse");
    assert_eq!(differences(&low.config), "particle_spacing_m = 0.02");
}

#[test]
fn the_stored_table_has_methods_for_every_wave() {
    for wave in [0.1, 0.2, 0.4, 0.6, 0.8] {
        let choice = AccuracyTable::stored().choose(&config(wave), 20.0, 1.0, &[]).unwrap();
        assert!(choice.meets && choice.cost_s > 0.0, "{choice:?}");
    }
}
