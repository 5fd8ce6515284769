use super::*;
use crate::execute::fake::FakeRunner;
use crate::math::simd::SimdPath;
use crate::simulation::Unwatched;

#[test]
fn a_child_gives_the_same_bits() {
    let scene = "kind = \"hydrostatic\"".parse().unwrap();
    let config = CaseConfig::from_tables(&scene, &toml::Table::new()).unwrap();
    let resources = Resources { simd: SimdPath::Portable, threads: 1 };
    let (limits, checkpoint, keep) = (Limits::default(), None, None);
    let posted = Posted::from(&config);
    let task = Task { trunk: false, config: posted, checkpoint, resources, keep, limits };
    let mut answer = Vec::new();
    let task = postcard::to_stdvec(&task).unwrap();
    serve(&task[..], &mut answer, |_, _| FakeRunner::default()).unwrap();
    let answer: Result<CaseResult, Stopped> = postcard::from_bytes(&answer).unwrap();
    assert_eq!(answer, FakeRunner::default().case(&config, None, &Unwatched));
}
