use super::*;
use crate::quantities::summary::{
    DISPLACEMENT_ERROR, DISPLACEMENT_MAX, DISPLACEMENT_TRUNCATED, FIRST_FORCE_MAX, FORCE_ERROR,
    FORCE_MAX, OVERTOPPING_VOLUME, SEAWALL_MASS, WAVE_HEIGHT_RATIO,
};
use crate::report::row::Row;

fn pair_of(rows: [&Row; 2]) -> Pair {
    pair_in(0.2, rows)
}

fn pair_in(depth: f64, rows: [&Row; 2]) -> Pair {
    let [a, b] = rows.map(|row| Side { row, case: None, depth: Some(depth) });
    Pair::of(&a, &b)
}

fn pair(a: f64, b: f64, bar: Option<f64>) -> Pair {
    let row = |force: f64| {
        let row = Row::default().with(&WAVE_HEIGHT_RATIO, 0.3).with(&FIRST_FORCE_MAX, force);
        bar.into_iter().fold(row, |row, bar| row.with(&FORCE_ERROR, bar))
    };
    pair_of([&row(a), &row(b)])
}

#[test]
fn differences_are_judged_by_both_bars() {
    let one = pair(2.0, 2.1, Some(0.06));
    let force = one.differences[0].unwrap();
    assert!((force.absolute() - 0.1).abs() < 1e-12);
    assert!((force.percent().unwrap() - 5.0).abs() < 1e-9);
    assert_eq!(force.is_within(), Some(true));
    assert_eq!(pair(2.0, 2.1, Some(0.04)).differences[0].unwrap().is_within(), Some(false));
    assert_eq!(pair(2.0, 2.1, None).differences[0].unwrap().is_within(), None);
    assert_eq!(one.differences[2], None, "no displacement");
}

/// The story: a study without bars was said to differ by more than "both error bars together".
#[test]
fn a_case_without_a_bar_is_held_against_the_other_bar_alone() {
    let row = || Row::default().with(&FIRST_FORCE_MAX, 2.0);
    let rows = [row().with(&FORCE_ERROR, 0.1), row()];
    let of = |a: usize, b: usize| pair_of([&rows[a], &rows[b]]).differences[0].unwrap();
    assert_eq!([of(0, 1), of(0, 0), of(1, 1)].map(|one| one.has_one_bar()), [true, false, false]);
    assert_eq!(of(0, 1).bar(), Some(0.1));
}

/// The story: a short run gave X* ≥ 0.35, and the 0.89 of a longer run was called 153 % off.
#[test]
fn a_lower_bound_short_of_the_other_value_tells_no_difference() {
    let row = |displacement: f64, bound: bool| {
        let row = Row::default().with(&DISPLACEMENT_MAX, displacement);
        row.with(&DISPLACEMENT_ERROR, 0.01).with(&DISPLACEMENT_TRUNCATED, bound)
    };
    let told = |a: Row, b: Row| {
        let one = pair_of([&a, &b]).differences[2].unwrap();
        (one.size().map(f64::round), one.is_within())
    };
    assert_eq!(told(row(0.2, true), row(0.3, false)), (None, None));
    assert_eq!(told(row(0.3, false), row(0.2, true)), (None, None));
    assert_eq!(told(row(0.3, true), row(0.2, false)), (Some(-33.0), Some(false)));
    assert_eq!(told(row(0.2, true), row(0.3, true)), (Some(50.0), Some(false)));
}

/// The story: a caisson was compared with a fixed wall, and the words were "at m = 60000 kg/m".
#[test]
fn what_differs_stands_in_the_words_twice() {
    let row = || Row::default().with(&WAVE_HEIGHT_RATIO, 0.3);
    let words = |a: Row, b: Row| pair_of([&a, &b]).words;
    let heavy = || row().with(&SEAWALL_MASS, 60000);
    assert_eq!(words(heavy(), row()), "H/h = 0.3, m = 60000 | - kg/m");
    assert_eq!(words(heavy(), heavy().with(&SEAWALL_MASS, 50)), "H/h = 0.3, m = 60000 | 50 kg/m");
    assert_eq!(words(heavy(), heavy()), "H/h = 0.3, m = 60000 kg/m");
}

/// The story: the third wave of a train was compared with the fourth, found with finer particles.
#[test]
fn regular_waves_are_compared_by_their_whole_runs() {
    let mut row = Row::default().with(&FIRST_FORCE_MAX, 1.16).with(&FORCE_MAX, 1.3);
    row.regular = true;
    assert_eq!(pair_of([&row; 2]).differences[0].unwrap().values, [1.3, 1.3]);
}

#[test]
fn a_tally_names_its_worst_pair() {
    let pairs = [pair(2.0, 2.0, None), pair(2.0, 1.0, Some(0.1)), pair(2.0, 2.02, Some(0.1))];
    let tally = Pair::tally(&pairs, 0).unwrap();
    assert_eq!((tally.count, tally.worst, tally.worst_pair), (3, 50.0, 1));
    assert!((tally.median - 1.0).abs() < 1e-9);
    assert_eq!((tally.with_bars, tally.within), (2, 1));
    assert_eq!(Pair::tally(&pairs, 2), None);
}

/// The story: volumes over a crest were not compared, and maxima of regular waves stood under "first F*".
#[test]
fn volumes_are_compared_and_maxima_that_stand_in_have_their_own_name() {
    let row = |volume: f64, regular: bool| {
        let row = Row::default().with(&FIRST_FORCE_MAX, 2.0).with(&FORCE_MAX, 3.0);
        let mut row = row.with(&OVERTOPPING_VOLUME, volume);
        row.regular = regular;
        row
    };
    let of = |regular: bool| pair_of([&row(0.004, regular), &row(0.005, regular)]);
    let volume = of(false).differences[3].unwrap();
    assert!((volume.percent().unwrap() - 25.0).abs() < 1e-9, "{volume:?}");
    let none = pair_of([&row(1e-6, false), &row(0.0, false)]).differences[3].unwrap();
    assert_eq!((none.percent(), none.values), (None, [1e-6, 0.0]));
    // The story: in water of 0.05 m a volume of 0.003 h² counted as nothing.
    let shallow = pair_in(0.05, [&row(8e-6, false), &row(1e-5, false)]).differences[3].unwrap();
    assert!((shallow.percent().unwrap() - 25.0).abs() < 1e-9, "{shallow:?}");
    let named = |pairs: Vec<Pair>| {
        crate::report::compare::Comparison { pairs, ..Default::default() }.column(0).name
    };
    assert_eq!(named(vec![of(true)]), "force_max");
    assert_eq!(named(vec![of(true), of(false)]), "first_force_max");
    assert_eq!(named(Vec::new()), "first_force_max");
}
