//! The physics, as who does the work.

use super::apart::Apart;
use super::runner::Runner;
use crate::film::Filming;
use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, Monitor, Resources, Stopped, TrunkResult, run_case, run_trunk,
};

/// The physics.
#[derive(Debug, Clone)]
pub struct SphRunner {
    /// The instruction set agreed on by all ranks, and a case's threads.
    pub resources: Resources,
    /// Whether and how cases are filmed.
    pub film: Option<Filming>,
}

impl Runner for SphRunner {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        run_trunk(config, self.resources, monitor)
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        let run = |monitor: &dyn Monitor| run_case(config, checkpoint, self.resources, monitor);
        match &self.film {
            None => run(monitor),
            Some(film) => film.shoot(config, monitor, run),
        }
    }

    fn apart(&self) -> Option<Box<dyn Runner>> {
        self.film.is_none().then(|| Box::new(Apart(self.resources)) as Box<dyn Runner>)
    }
}
