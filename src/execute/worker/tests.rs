use std::sync::Mutex;

use super::*;
use crate::execute::fake::FakeRunner;
use crate::simulation::{CaseResult, Monitor};

#[derive(Default)]
struct Noting(Mutex<Vec<Option<Vec<u8>>>>);

impl Runner for Noting {
    fn trunk(&self, config: &CaseConfig, cancel: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        FakeRunner::default().trunk(config, cancel)
    }
    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        cancel: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        self.0.lock().unwrap().push(checkpoint.map(<[u8]>::to_vec));
        FakeRunner::default().case(config, None, cancel)
    }
}

/// Two branches of a trunk of rank 0 on rank 1. The second is ordered before the checkpoint is
/// there, when the coordinator already takes rank 1 for a holder. Returns the starts of the
/// branches.
fn starts(answer: Option<Vec<u8>>) -> Vec<Option<Vec<u8>>> {
    let noting = Noting::default();
    with_worker(1, 1, &noting, None, |worker| {
        let empty = toml::Table::new();
        let config = CaseConfig::from_tables(&empty, &empty).unwrap();
        let mut order = |case, holder| {
            let config = Posted::from(&config);
            let from = Some(Held { trunk: 7, holder });
            let (work, limits) = (Work::Case(case), Limits::default());
            let apart = false;
            let files = None;
            worker.take(Order::Run { work, config, from, apart, limits, files })
        };
        assert_eq!(order(0, 0), Some(Held { trunk: 7, holder: 0 }));
        assert_eq!(order(1, 1), None);
        worker.arrive(7, answer);
        for _ in 0..2 {
            assert!(worker.poll(Duration::from_secs(60)).is_some());
        }
    })
    .unwrap();
    noting.0.into_inner().unwrap()
}

#[test]
fn branches_wait_for_a_checkpoint_that_is_on_its_way() {
    let bytes = vec![1, 2, 3];
    assert_eq!(starts(Some(bytes.clone())), [Some(bytes.clone()), Some(bytes)]);
    // The other rank had none, so they start from rest.
    assert_eq!(starts(None), [None, None]);
}
