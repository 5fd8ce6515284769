use super::*;
use crate::quantities::summary::{FIRST_FORCE_MAX, STATUS};

fn wall(wave: f64, spring: Option<(f64, f64)>, force: f64) -> Row {
    let row = Row::default().with(&STATUS, "ok").with(&WAVE_HEIGHT_RATIO, wave);
    let row = row.with(&FIRST_FORCE_MAX, force);
    spring
        .into_iter()
        .fold(row, |row, (k, m)| row.with(&SPRING_STIFFNESS, k).with(&SEAWALL_MASS, m))
}

fn said(rows: &[Row]) -> Option<String> {
    half(&Loaded { rows: rows.to_vec(), ..Loaded::default() })
}

/// Three stiffnesses and three masses; light and soft walls halve the force of the larger wave.
fn walls() -> Vec<Row> {
    let soft = |k: f64, m: f64| if k * m <= 5000.0 { 1.9 } else { 2.5 };
    let mut rows = Vec::new();
    for m in [50.0, 100.0, 500.0] {
        rows.extend([10.0, 100.0].map(|k| wall(0.5, Some((k, m)), soft(k, m))));
        rows.push(wall(0.5, Some((1e5, m)), 4.0));
        rows.push(wall(0.2, Some((10.0, m)), 1.5));
        rows.push(wall(0.2, Some((1e5, m)), 1.8));
    }
    rows
}

#[test]
fn masses_of_the_same_stiffnesses_are_told_together() {
    let told = "Compared with the stiffest wall at H/h = 0.5, k = 100000 N/m, m = 500 kg/m (F* = 4), \
                the force is halved by k up to 100 N/m with m = 50 kg/m; k = 10 N/m with m = 100 \
                and 500 kg/m. At H/h = 0.2 no wall halves it.";
    assert_eq!(said(&walls()).unwrap(), told);
}

#[test]
fn a_fixed_wall_is_what_others_are_compared_with() {
    let mut rows = walls();
    rows.push(wall(0.5, None, 3.6));
    let told = said(&rows).unwrap();
    let none = "No other wall halves the force on the fixed wall at H/h = 0.5";
    let lowest = "The lowest force is 53 % of it, at H/h = 0.5, k = 10 N/m";
    assert!(told.starts_with(none) && told.contains(lowest), "{told}");
}

#[test]
fn many_walls_are_counted() {
    let mut rows = vec![wall(0.5, Some((1e5, 50.0)), 4.0)];
    for index in 0..200 {
        let force = if index % 3 == 0 { 1.5 } else { 2.5 };
        rows.push(wall(0.5, Some((10.0 + f64::from(index), 50.0)), force));
    }
    let told = "the force is halved by 67 of 201 walls; the stiffest of them is that at H/h = 0.5, \
                k = 208 N/m, m = 50 kg/m.";
    assert!(said(&rows).unwrap().ends_with(told), "{:?}", said(&rows));
}

#[test]
fn other_comparisons_without_a_halved_force_are_told_in_words() {
    let walls = |variant: &str, soft: f64| {
        let mut rows = [(10.0, soft), (1e5, 4.0)].map(|(k, f)| wall(0.5, Some((k, 50.0)), f));
        rows.iter_mut().for_each(|row| row.variant = variant.into());
        rows
    };
    let study = |a, b| said(&[walls("a", a), walls("b", b), walls("c", b)].concat()).unwrap();
    let none = " In 2 other combinations of wave and settings no wall halves it";
    assert!(study(3.0, 3.0).ends_with(&format!("{none} either.")));
    assert!(study(1.0, 3.0).ends_with(&format!("{none}.")));
}

/// The story: beside springs a caisson was written as "k =  N/m with m = 20 kg/m".
#[test]
fn a_caisson_that_halves_the_force_is_told_as_one() {
    let caisson = || {
        let row = Row::default().with(&STATUS, "ok").with(&WAVE_HEIGHT_RATIO, 0.5);
        row.with(&SEAWALL_MASS, 20).with(&FIRST_FORCE_MAX, 1.25)
    };
    let mut rows = vec![wall(0.5, None, 3.0), wall(0.5, Some((5000.0, 20.0)), 2.9), caisson()];
    let held = "Compared with the fixed wall at H/h = 0.5 (F* = 3), the force is halved by";
    assert_eq!(said(&rows).unwrap(), format!("{held} a caisson of m = 20 kg/m."));
    rows.push(wall(0.5, Some((10.0, 20.0)), 1.4));
    let both = "k = 10 N/m with m = 20 kg/m; a caisson of m = 20 kg/m.";
    assert_eq!(said(&rows).unwrap(), format!("{held} {both}"));
}

/// The story: no wall moved, and the lowest force was "100 % of it", at the very same wall.
#[test]
fn walls_under_the_same_force_have_no_lowest() {
    for soft in [2.0, 1.9999999] {
        let walls = [(10.0, soft), (1e5, 2.0)].map(|(k, f)| wall(0.5, Some((k, 50.0)), f));
        let told = said(&walls).unwrap();
        assert!(told.ends_with("m = 50 kg/m (F* = 2)."), "{told}");
    }
}

/// The story: "No other wall halves the force ... At H/h = 0.2 some wall halves it, too."
#[test]
fn a_lower_wave_that_alone_is_halved_is_not_told_as_a_further_one() {
    let walls = [(0.5, 10.0, 3.0), (0.5, 1e5, 4.0), (0.2, 10.0, 1.0), (0.2, 1e5, 2.5)];
    let told = said(&walls.map(|(wave, k, f)| wall(wave, Some((k, 50.0)), f))).unwrap();
    assert!(told.ends_with(" At H/h = 0.2 some wall halves it."), "{told}");
}

#[test]
fn one_stiffness_is_compared_with_nothing() {
    assert_eq!(said(&[50.0, 100.0].map(|m| wall(0.5, Some((10.0, m)), 2.0))), None);
    assert_eq!(said(&[]), None);
}
