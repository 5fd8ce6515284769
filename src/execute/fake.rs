//! Made-up physics for tests of everything else: deterministic numbers in no time.

use std::time::{Duration, Instant};

use super::runner::Runner;
use crate::results::made_up;
use crate::scene::CaseConfig;
use crate::simulation::{CaseResult, Cost, Failure, FailureKind, Monitor, Stopped, TrunkResult};
use crate::study::CaseId;

/// A made-up cost: trunks take half of a case.
pub fn cost(_config: &CaseConfig) -> Cost {
    Cost { particles: 100, steps: 1000, trunk_share: 0.5, memory_bytes: 1 << 20 }
}

/// What a fake case does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It ends well.
    Well,
    /// It fails with a line break in its reason.
    Fails,
    /// It panics.
    Panics,
}

/// A runner whose numbers are a function of the case's id.
#[derive(Debug, Clone, Copy)]
pub struct FakeRunner {
    /// How long each case takes.
    pub delay: Duration,
    /// The fate of a case.
    pub fate: fn(&CaseConfig) -> Fate,
    /// Whether every trunk fails.
    pub trunks_fail: bool,
}

impl Default for FakeRunner {
    fn default() -> FakeRunner {
        FakeRunner { delay: Duration::ZERO, fate: |_| Fate::Well, trunks_fail: false }
    }
}

impl FakeRunner {
    fn wait(&self, monitor: &dyn Monitor) -> Result<(), Stopped> {
        let start = Instant::now();
        while start.elapsed() < self.delay {
            if monitor.cancelled() {
                return Err(Stopped::Interrupted);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    }
}

fn failure(detail: &str) -> Stopped {
    let detail = detail.to_owned();
    Stopped::Failed(Failure { kind: FailureKind::RunawaySpeed, time_s: 0.5, detail })
}

impl Runner for FakeRunner {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        self.wait(monitor)?;
        if self.trunks_fail {
            return Err(failure("a trunk"));
        }
        let checkpoint = CaseId::of(config).to_string().repeat(1000).into_bytes();
        Ok(TrunkResult { checkpoint, time_s: 1.0, steps: 500 })
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        self.wait(monitor)?;
        if let (Some(checkpoint), Some(trunk)) = (checkpoint, config.trunk()) {
            let expected = CaseId::of(&trunk).to_string();
            assert!(checkpoint.starts_with(expected.as_bytes()), "a checkpoint of another trunk");
        }
        match (self.fate)(config) {
            Fate::Well => Ok(made_up(config)),
            Fate::Fails => Err(failure("first line\nsecond line")),
            Fate::Panics => panic!("a fake panic"),
        }
    }
}
