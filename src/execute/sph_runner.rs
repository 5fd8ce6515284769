//! The physics as a runner.

use super::apart::Apart;
use super::keeping::Keeping;
use super::runner::Runner;
use crate::film::Filming;
use crate::results::Checkpoint;
use crate::scene::CaseConfig;
use crate::simulation::{
    CaseResult, Monitor, Resources, Stopped, TrunkResult, run_case, run_trunk,
};
use crate::study::CaseId;

/// The physics.
#[derive(Debug, Clone)]
pub struct SphRunner {
    /// The instruction set common to all ranks, and a case's threads.
    pub resources: Resources,
    /// The case to film, and how. Its companions for error bars are not filmed.
    pub film: Option<(CaseId, Filming)>,
    /// Where checkpoints of long cases are stored, if anywhere. Filmed cases have none.
    pub keep: Option<Keeping>,
}

impl Runner for SphRunner {
    fn trunk(&self, config: &CaseConfig, monitor: &dyn Monitor) -> Result<TrunkResult, Stopped> {
        let run = |monitor: &dyn Monitor| run_trunk(config, self.resources, monitor);
        let Some(keep) = &self.keep else { return run(monitor) };
        let id = CaseId::of(config);
        let checkpoint = Checkpoint::of_trunk(&keep.directory, id, self.resources.simd);
        keep.during(checkpoint, monitor, run)
    }

    fn case(
        &self,
        config: &CaseConfig,
        checkpoint: Option<&[u8]>,
        monitor: &dyn Monitor,
    ) -> Result<CaseResult, Stopped> {
        let run = |monitor: &dyn Monitor| run_case(config, checkpoint, self.resources, monitor);
        let id = CaseId::of(config);
        match (&self.film, &self.keep) {
            (Some((filmed, film)), _) if *filmed == id => {
                let (result, written) = film.shoot(config, monitor, run)?;
                if let Err(error) = written {
                    eprintln!("warning: case {id}: not filmed: {error}");
                }
                Ok(result)
            }
            (_, None) => run(monitor),
            (_, Some(keep)) => {
                let simd = self.resources.simd;
                keep.during(Checkpoint::of_case(&keep.directory, id, simd), monitor, run)
            }
        }
    }

    fn apart(&self) -> Option<Box<dyn Runner>> {
        let (resources, keep) = (self.resources, self.keep.clone());
        self.film.is_none().then(|| Box::new(Apart { resources, keep }) as Box<dyn Runner>)
    }
}
