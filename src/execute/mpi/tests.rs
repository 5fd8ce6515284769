use super::*;
use crate::execute::Report;

#[test]
fn results_cross_the_wire_bit_for_bit() {
    use crate::execute::fake::FakeRunner;
    use crate::execute::runner::Runner;
    let empty = toml::Table::new();
    let config = crate::scene::CaseConfig::from_tables(&empty, &empty).unwrap();
    let result = FakeRunner::default().case(&config, None, &crate::simulation::Unwatched).unwrap();
    let result = Ok(crate::results::Delivery::Whole(Box::new(result)));
    let report = Report::CaseDone { case: 3, result, wall_time_s: 0.1, cpu_time_s: Some(0.1) };
    let bytes = postcard::to_stdvec(&Message::Reports(vec![report.clone()])).unwrap();
    let Message::Reports(read) = postcard::from_bytes(&bytes).unwrap() else { panic!() };
    assert_eq!(read, [report]);
}
