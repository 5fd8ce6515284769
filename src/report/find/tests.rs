use super::*;
use crate::quantities::Column;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, DISPLACEMENT_TRUNCATED, FORCE_MAX, FORCE_MAX_ERROR, OVERTOPPING_VOLUME,
    RUNUP_MAX, STATUS,
};
use crate::report::row::Row;
use crate::report::study::Key;

/// A study over one key, its rows made by a function of the key's value.
fn study(name: &str, grid: &str, values: &[f64], row: impl Fn(f64) -> Row) -> Loaded {
    let file = format!("name = \"a\"\n[grid]\n{name} = {grid}");
    let rows = values.iter().map(|value| row(*value).with(&STATUS, "ok")).collect();
    let keys = vec![Key::new(name, values.iter().map(f64::to_string))];
    Loaded { rows, keys, ..Loaded::default() }.made_from(&file, &[])
}

const MASS: &str = "seawall_mass_kg_per_m";
const STIFFNESS: &str = "spring_stiffness_n_per_m";

fn ids(data: &Loaded, text: &str) -> Vec<usize> {
    find(text, data).unwrap().rows(Verdict::Met).collect()
}

fn with(column: &'static Column, f: impl Fn(f64) -> f64) -> impl Fn(f64) -> Row {
    move |x| Row::default().with(column, f(x))
}

#[test]
fn every_operator_picks_its_cases() {
    let data = study(MASS, "[]", &[1.0, 2.0, 3.0], with(&FORCE_MAX, |x| x));
    assert_eq!(ids(&data, "force_max < 2"), [0]);
    assert_eq!(ids(&data, "force_max<=2"), [0, 1]);
    assert_eq!(ids(&data, "force_max > 2"), [2]);
    assert_eq!(ids(&data, "force_max >= 2"), [1, 2]);
    assert_eq!(ids(&data, "force_max = 2.0004"), [1], "to four digits");
    assert!(ids(&data, "force_max == 2.01").is_empty());
    assert_eq!(ids(&data, "force_max > 1 AND seawall_mass_kg_per_m < 2.5"), [1]);
    assert_eq!(ids(&data, "F* > 1 and m < 2.5"), [1], "by the symbols of tables");
    let told = find("F* max > 1 and m < 2×10⁰", &data).unwrap().condition.to_string();
    assert_eq!(told, "force_max > 1 and seawall_mass_kg_per_m < 2");
}

/// The story: sums over no water were not exactly 0, and a boundary was drawn through their noise.
#[test]
fn no_water_goes_over_where_sums_leave_a_little() {
    let over = |wave: f64| if wave < 0.35 { 1e-14 * (wave - 0.25) } else { 0.002 };
    let waves = study("wave_height_ratio", "[]", &[0.2, 0.3, 0.4], with(&OVERTOPPING_VOLUME, over));
    assert_eq!(ids(&waves, "V over > 0"), [2]);
    assert_eq!(ids(&waves, "overtopping_volume_m2 = 0"), [0, 1]);
}

/// The story: `displacement_truncated = 1` was told to hold words, though it is a flag.
#[test]
fn flags_are_true_or_false_or_1_or_0() {
    let row = |x: f64| Row::default().with(&DISPLACEMENT_TRUNCATED, x > 1.5).with(&FORCE_MAX, x);
    let data = study(MASS, "[]", &[1.0, 2.0, 3.0], row);
    assert_eq!(ids(&data, "displacement_truncated = true"), [1, 2]);
    assert_eq!(ids(&data, "displacement_truncated = 1 and F* max < 2.5"), [1]);
    assert_eq!(ids(&data, "displacement_truncated = false"), [0]);
    assert!(find("force_max = true", &data).unwrap_err().contains("one finite number"));
}

#[test]
fn bad_conditions_are_told() {
    let data = study(MASS, "[]", &[1.0, 2.0], with(&FORCE_MAX, |x| x));
    let bad = [
        ("force_mx < 2", "force_mx: no column of numbers has this name; did you mean force_max?"),
        ("colour < 2", "colour: no column of numbers has this name (`seawall explain` lists all)"),
        ("F_max < 2", "F_max: no column of numbers has this name; did you mean force_max?"),
        ("force < 2", "force: no column of numbers has this name; did you mean force_max?"),
        ("k* < 2", "k*: no column of numbers has this name; did you mean log10_k_star?"),
        ("status < 2", "status: holds words; a condition needs a column of numbers"),
        ("force_max 2", "\"force_max 2\": holds none of <, <=, >, >= and =; write COLUMN < NUMBER"),
        ("force_max < 2 kN", "\"force_max < 2 kN\": \"2 kN\" is no limit: the limit must be one"),
        ("force_max < nan", "\"force_max < nan\": \"nan\" is no limit"),
        ("2 < force_max", "\"2 < force_max\": \"force_max\" is no limit"),
        ("force_max < 2 and", "\"\": a comparison is missing"),
        ("", "\"\": a comparison is missing"),
        ("< 2", "\"< 2\": names no column"),
    ];
    for (text, message) in bad {
        let told = find(text, &data).unwrap_err();
        assert!(told.starts_with(message), "{told:?} should start with {message:?}");
    }
}

#[test]
fn boundaries_of_smooth_curves_lie_within_their_range() {
    let places: Vec<f64> = (0..9).map(|i| 10_f64.powf(f64::from(i) * 0.5)).collect();
    let curves: [fn(f64) -> f64; 3] =
        [|s| libm::tanh(s - 2.1), |s| libm::exp(0.5 * s), |s| 3.0 - 0.3 * s - 0.1 * s * s * s];
    for curve in curves {
        let value = |x: f64| curve(libm::log10(x));
        let range = "{ from = 1, to = 1e4, points = 9, spacing = \"log\" }";
        let data = study(STIFFNESS, range, &places, with(&FORCE_MAX, value));
        for exact in [0.61_f64, 1.25, 2.2, 2.75, 3.4] {
            let limit = curve(exact);
            let found = find(&format!("force_max < {limit}"), &data).unwrap();
            let [one] = &found.boundaries[..] else { panic!("{:?}", found.boundaries) };
            let exact = 10_f64.powf(exact);
            let [low, high] = one.between;
            assert_eq!(one.basis, Basis::Bend);
            assert!(low <= exact && exact <= high, "{exact} not in {low} to {high}");
            assert!(libm::log10(high / low) < 0.25, "{low} to {high} is of no use");
        }
    }
}

#[test]
fn a_straight_line_is_crossed_where_it_is_and_no_further() {
    let data = study(MASS, "[1, 2, 4, 5]", &[1.0, 2.0, 4.0, 5.0], with(&FORCE_MAX, |x| 3.0 * x));
    let found = find("force_max > 7.5", &data).unwrap();
    let [one] = &found.boundaries[..] else { panic!("{:?}", found.boundaries) };
    assert!(one.met_above && one.at == Some(2.5) && one.between == [2.5, 2.5], "{one:?}");
}

/// Two grids of a curve that rises within two decades, as forces over the stiffness do.
#[test]
fn ranges_hold_where_a_grid_barely_shows_the_curve() {
    let curve = |s: f64| 2.0 + libm::tanh(2.0 * (s - 2.9));
    for points in [4_u8, 7] {
        let step = 6.0 / f64::from(points - 1);
        let places: Vec<f64> = (0..points).map(|i| libm::pow(10.0, step * f64::from(i))).collect();
        let range = format!("{{ from = 1, to = 1e6, points = {points}, spacing = \"log\" }}");
        let value = |x: f64| curve(libm::log10(x));
        let data = study(STIFFNESS, &range, &places, with(&FORCE_MAX, value));
        for exact in [2.1, 2.4, 2.8, 3.1, 3.6] {
            let found = find(&format!("force_max < {}", curve(exact)), &data).unwrap();
            let [low, high] = found.boundaries[0].between.map(libm::log10);
            assert!(low <= exact && exact <= high, "{points}: {exact} not in {low} to {high}");
        }
    }
    // Three points on a straight line, which may belong to such a curve.
    let data = study(MASS, "[1, 2, 3]", &[1.0, 2.0, 3.0], with(&FORCE_MAX, |x| x));
    let [low, high] = find("force_max < 1.5", &data).unwrap().boundaries[0].between;
    assert!(low < 1.3 && high > 1.7, "{low} to {high}");
}

#[test]
fn error_bars_widen_the_range_by_what_they_are_worth() {
    let row = |x: f64| with(&FORCE_MAX, |x| 2.0 * x)(x).with(&FORCE_MAX_ERROR, 0.3);
    let data = study(MASS, "[1, 2, 3, 4]", &[1.0, 2.0, 3.0, 4.0], row);
    let found = find("force_max < 4.5", &data).unwrap();
    let one = &found.boundaries[0];
    assert!((one.between[0] - 2.1).abs() < 1e-12 && (one.between[1] - 2.4).abs() < 1e-12);
    assert!(!found.condition.is_near(1));
    assert!(find("force_max < 4.2", &data).unwrap().condition.is_near(1), "by 0.2 only");
    let near = &find("force_max < 4.2", &data).unwrap().boundaries[0];
    assert!(near.between[0] < 2.0, "the second case may be on either side: {near:?}");
}

#[test]
fn a_lower_bound_short_of_the_limit_proves_nothing() {
    let row =
        |x: f64| with(&DISPLACEMENT_MAX, |x| 4.0 - x)(x).with(&DISPLACEMENT_TRUNCATED, x < 1.5);
    let data = study(MASS, "[1, 2, 3]", &[1.0, 2.0, 3.0], row);
    let verdicts = |text: &str| find(text, &data).unwrap().verdicts;
    use Verdict::{Met, NotMet, Unknown};
    assert_eq!(verdicts("displacement_max < 2.5"), [NotMet, Met, Met]);
    assert_eq!(verdicts("displacement_max < 3.5"), [Unknown, Met, Met], "3 is a bound");
    assert_eq!(verdicts("displacement_max > 2.5"), [Met, NotMet, NotMet]);
    assert_eq!(verdicts("displacement_max > 3.5"), [Unknown, NotMet, NotMet]);
    assert_eq!(verdicts("displacement_max = 3.5"), [Unknown, NotMet, NotMet]);
    assert_eq!(verdicts("displacement_max = 2"), [NotMet, Met, NotMet]);
    let found = find("displacement_max < 3.5", &data).unwrap();
    assert_eq!(found.why(0), "a lower bound, short of the limit");
    let open = &found.boundaries[0];
    assert!(open.met_above && open.at.is_none() && open.basis == Basis::Gap, "{open:?}");
    let beyond = &find("displacement_max < 2.5", &data).unwrap().boundaries[0];
    assert_eq!((beyond.at, beyond.basis, beyond.between), (None, Basis::LowerBound, [1.0, 2.0]));
}

/// The range came from interpolation, and the point where the wall gave way lay outside it.
#[test]
fn a_wall_that_gives_way_does_so_somewhere_between_two_cases() {
    let places = [1.0, 2.0, 3.0, 4.0];
    let row = with(&DISPLACEMENT_MAX, |x| if x > 2.9 { 0.5 * x - 1.4 } else { 0.0 });
    let data = study(MASS, "[1, 2, 3, 4]", &places, row);
    for (limit, basis, between) in [
        ("displacement_max > 0", Basis::Start, [2.0, 3.0]),
        ("displacement_max > 0.05", Basis::Start, [2.0, 3.0]),
        ("displacement_max > 0.3", Basis::Bend, [3.0, 4.0]),
    ] {
        let [one] = &find(limit, &data).unwrap().boundaries[..] else { panic!("{limit}") };
        assert!(one.met_above && one.basis == basis, "{one:?}");
        assert!(between[0] <= one.between[0] && one.between[1] <= between[1], "{one:?}");
        assert_eq!(one.at.is_none(), basis == Basis::Start);
    }
}

#[test]
fn failed_and_missing_cases_leave_a_gap() {
    let mut data = study(MASS, "[1, 2, 3, 4]", &[1.0, 2.0, 3.0, 4.0], with(&FORCE_MAX, |x| x));
    data.rows[1] = Row::default().with(&STATUS, "failed");
    let found = find("force_max < 2.5 and runup_max < 1", &data).unwrap();
    assert_eq!(found.why(1), "failed");
    assert_eq!(found.why(0), "has no such value");
    assert_eq!(found.verdicts[3], Verdict::NotMet, "whatever its runup");
    let found = find("force_max < 2.5", &data).unwrap();
    let one = &found.boundaries[0];
    assert_eq!((one.at, one.basis, one.between), (None, Basis::Gap, [1.0, 3.0]));
    assert!(!one.met_above);
}

/// The story: a case that had failed was listed among those that meet a condition on a swept key.
#[test]
fn a_failed_case_meets_no_condition_on_its_own_keys() {
    let mut data = study(MASS, "[1, 2, 3]", &[1.0, 2.0, 3.0], with(&FORCE_MAX, |x| x));
    data.rows[1] = Row::default().with(&STATUS, "failed");
    let found = find("seawall_mass_kg_per_m <= 2", &data).unwrap();
    assert_eq!(found.verdicts, [Verdict::Met, Verdict::Unknown, Verdict::NotMet]);
    assert_eq!(found.why(1), "failed");
}

#[test]
fn two_conditions_leave_a_strip_even_between_cases_that_miss_it() {
    let row = |x: f64| with(&FORCE_MAX, |x| x)(x).with(&RUNUP_MAX, 10.0 - x);
    let data = study(MASS, "[0, 10]", &[0.0, 10.0], row);
    let found = find("force_max > 4 and runup_max > 3.5", &data).unwrap();
    assert!(found.verdicts.iter().all(|verdict| *verdict == Verdict::NotMet));
    let ends: Vec<_> = found.boundaries.iter().map(|one| (one.met_above, one.at)).collect();
    assert_eq!(ends, [(true, Some(4.0)), (false, Some(6.5))]);
    assert!(find("force_max > 7 and runup_max > 3.5", &data).unwrap().boundaries.is_empty());
    let basis = found.boundaries[0].basis;
    assert_eq!((basis, found.boundaries[0].between), (Basis::TwoCases, [0.0, 10.0]));
}

#[test]
fn a_limit_on_the_axis_itself_is_where_it_is() {
    let data = study(STIFFNESS, "[1, 10, 1000]", &[1.0, 10.0, 1e3], with(&FORCE_MAX, |x| x));
    let one = &find("spring_stiffness_n_per_m < 50", &data).unwrap().boundaries[0];
    assert_eq!((one.at, one.basis, one.between), (Some(50.0), Basis::Exact, [50.0; 2]));
    for points in ["spring_stiffness_n_per_m = 10", "force_max = 10"] {
        assert!(find(points, &data).unwrap().boundaries.is_empty(), "{points}");
    }
}
