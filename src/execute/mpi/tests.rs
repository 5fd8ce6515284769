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

#[test]
fn an_mpi_library_is_called_by_its_name() {
    assert_eq!(name_of("Open MPI v4.1.4, package: Debian, ident: 4.1.4\0"), "Open MPI v4.1.4");
    assert_eq!(name_of("MPICH Version:      4.0.2\nMPICH Release date: 2022"), "MPICH");
}
