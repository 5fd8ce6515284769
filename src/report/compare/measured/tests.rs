use super::*;
use crate::report::fixture;

const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn line(points: &[(f64, f64)]) -> Series {
    let (name, unit) = ("G1".to_owned(), "m".to_owned());
    Series { name, unit, points: points.to_vec(), ..Series::default() }
}

/// Computed: a ramp of 1 m/s. Measured: the same, 0.1 m higher, with a peak between two times.
#[test]
fn a_record_is_held_at_its_own_times() {
    let computed = line(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
    let measured = line(&[(-1.0, 9.0), (0.5, 0.6), (1.5, 1.6), (1.75, 1.85), (7.0, 9.0)]);
    let held = Beside::of([&measured, &computed], ALWAYS).unwrap();
    assert_eq!(held.times(), [0.5, 1.75], "what only one has does not count");
    assert!((held.rms - 0.1).abs() < 1e-12, "{}", held.rms);
    assert_eq!(held.highest(), [(1.75, 1.85), (2.0, 2.0)]);
    assert!((held.off_percent().unwrap() - 100.0 * 0.15 / 1.85).abs() < 1e-12);
    assert!((held.rms_percent().unwrap() - 100.0 * 0.1 / 1.25).abs() < 1e-9);
    assert_eq!(held.axis.0, "level, m");
    let early = Beside::of([&measured, &computed], [0.0, 1.0]).unwrap();
    assert!((early.rms - 0.1).abs() < 1e-12);
    assert_eq!((early.times(), early.highest()), ([0.5, 0.5], [(0.5, 0.6), (1.0, 1.0)]));
}

/// The story: where a gauge had failed around its crest, the next one was held against the
/// computed crest, as 50 % too high.
#[test]
fn what_was_computed_in_a_gap_does_not_count() {
    let at = |step: i32| f64::from(step) / 10.0;
    let crest = |step: i32| if step == 15 { 9.0 } else { at(step) };
    let computed: Vec<_> = (0..=30).map(|step| (at(step), crest(step))).collect();
    let seen = |step: &i32| !(11..20).contains(step);
    let measured: Vec<_> = (0..=30).filter(seen).map(|step| (at(step), at(step))).collect();
    let held = Beside::of([&line(&measured), &line(&computed)], ALWAYS).unwrap();
    assert_eq!(held.highest(), [(3.0, 3.0), (3.0, 3.0)]);
    assert_eq!((held.gaps.count(), held.gaps.longest()), (1, Some([1.0, 2.0])));
    assert_eq!(held.gaps.pieces(&held.computed).count(), 2, "the line breaks");
    // A gap in the case: what was measured there does not count.
    let held = Beside::of([&line(&computed), &line(&measured)], ALWAYS).unwrap();
    assert_eq!(held.highest(), [(3.0, 3.0), (3.0, 3.0)]);
    assert!(held.rms < 1e-12, "{}", held.rms);
    let told = Beside::of([&line(&measured), &line(&computed)], [1.1, 1.9]).unwrap_err();
    assert!(told.contains("no value from 1.1 to 1.9 s"), "{told}");
}

#[test]
fn what_has_nothing_in_common_is_told() {
    let computed = line(&[(0.0, 0.0), (1.0, 1.0)]);
    let told = |points: &[(f64, f64)]| Beside::of([&line(points), &computed], ALWAYS).unwrap_err();
    assert!(
        told(&[(3.0, 1.0), (4.0, 1.0)]).contains("from 3 to 4 s, those of the case from 0 to 1 s")
    );
    assert!(told(&[(0.1, 1.0), (0.5, 1.0), (0.2, 1.0)]).contains("goes back from 0.5 to 0.2"));
    assert!(told(&[]).contains("no number"));
    let (directory, data) = fixture::read(fixture::dam_breaks(1));
    let record = directory.path().join("measured.csv");
    std::fs::write(&record, "time_s,P7\n0,1\n").unwrap();
    let told = hold(&data, "case-0000", (&record, ALWAYS)).unwrap_err().to_string();
    assert!(told.contains("measured.csv: has no column") && told.contains("P1, front"), "{told}");
    std::fs::write(&record, "time_s,P7,P1\n0,1,5\n").unwrap();
    let held = hold(&data, "case-0000", (&record, ALWAYS)).unwrap();
    assert_eq!((held.columns.len(), &held.left_out[..]), (1, &["P7".to_owned()][..]));
}
