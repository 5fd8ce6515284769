use super::super::made_up::made_up;
use super::super::trial::{self, study};
use super::*;

#[test]
fn a_result_that_is_no_number_is_a_failure() {
    let study = study("0.2");
    let case = &study.cases[0];
    let mut result = made_up(&case.config);
    assert!(trial::record(&study, case).is_ok());
    result.outcome.measured_wave_height_ratio = Some(f64::NAN);
    let record = CaseRecord::new(&study, case, &Ok(result.clone()), 1.0, "here");
    assert_eq!(record.failure, Some(FailureKind::NotANumber));
    result.outcome.measured_wave_height_ratio = None;
    let (tiny, largest) = (f64::MIN_POSITIVE / 3.0, f64::MAX);
    for number in [0.1, -0.0, tiny, largest, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let with = |set: &dyn Fn(&mut CaseResult)| {
            let mut result = result.clone();
            set(&mut result);
            CaseRecord::new(&study, case, &Ok(result), 1.0, "here").is_ok()
        };
        let fine = [
            with(&|result| result.outcome.force_max.value = number),
            with(&|result| result.energy.kinetic = number),
            with(&|result| result.readings = vec![NamedReading::new("", number, "")]),
        ];
        assert_eq!(fine, [number.is_finite(); 3], "{number}");
    }
}

#[test]
fn what_is_held_makes_the_same_table_and_owns_next_to_nothing() {
    let study = study("0.2");
    let case = &study.cases[0];
    let whole = trial::record(&study, case);
    let line = serde_json::to_string(&whole).unwrap();
    let held = serde_json::from_str::<HeldLine>(&line).unwrap().split(0).0;
    assert!(held.values.is_empty() && held.files.is_empty());
    assert!(held.host.is_empty() && held.phases.is_empty());
    let table = |record| super::super::summary::row(&study, &[], case, &record).unwrap();
    assert_eq!(table(held), table(whole));
    let bytes = std::mem::size_of::<CaseRecord>();
    assert!(bytes <= 900, "{bytes} bytes for each case");
}

#[test]
fn reasons_have_no_line_breaks() {
    assert_eq!(one_line("a\r\nb\tc\u{1b}"), "a b c");
}
