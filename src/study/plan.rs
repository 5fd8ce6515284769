//! Trunks and branches: work that is computed once and shared.

use rayon::prelude::*;

use super::Study;
use super::case::CaseId;
use crate::keys::Recent;
use crate::math::lists::grouped;
use crate::scene::CaseConfig;
use crate::simulation::Cost;

/// A stretch shared by several cases.
#[derive(Debug, Clone)]
pub struct PlannedTrunk {
    /// What to run.
    pub config: CaseConfig,
    /// Particle-steps.
    pub cost: u64,
    /// The cases (places in [`Plan::cases`]) that branch from it.
    pub branches: Vec<usize>,
}

/// A case that has still to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlannedCase {
    /// Its place among the study's cases and companions.
    pub index: usize,
    /// Its trunk (a place in [`Plan::trunks`]), where it shares one.
    pub trunk: Option<usize>,
    /// Particle-steps of the whole case.
    pub cost: u64,
    /// Particle-steps after the trunk.
    pub branch_cost: u64,
}

/// The work that is left, and which of it is shared.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// Shared stretches.
    pub trunks: Vec<PlannedTrunk>,
    /// Cases in grid order, then companions.
    pub cases: Vec<PlannedCase>,
}

/// Number of cases that are planned at once.
const CHUNK: usize = 4096;

/// A case without its trunk, and the trunk that it may share. `known` are recent trunks: comparing
/// with them is faster than finding an id.
fn planned(
    study: &Study,
    index: usize,
    branching: bool,
    cost: &impl Fn(&CaseConfig) -> Cost,
    known: &mut Recent<(CaseConfig, CaseId)>,
) -> (PlannedCase, Option<CaseId>) {
    let config = &study.run(index).config;
    let estimate = cost(config);
    let whole = estimate.particles.saturating_mul(estimate.steps).max(1);
    let shared = (whole as f64 * estimate.trunk_share.clamp(0.0, 1.0)) as u64;
    let branch_cost = (whole - shared.min(whole)).max(1);
    let case = PlannedCase { index, trunk: None, cost: whole, branch_cost };
    let trunk = config.trunk().filter(|_| branching && shared > 0);
    let id = |trunk: CaseConfig| {
        known.find(|(known, _)| *known == trunk, || (trunk.clone(), CaseId::of(&trunk))).1
    };
    (case, trunk.map(id))
}

impl Plan {
    /// Plans the cases and companions of a study for which `wanted` holds. Costs are those of
    /// [`crate::simulation::cost`]. Trunks are made only with `branching`, and only if at least two
    /// of the cases share one.
    pub fn new(
        study: &Study,
        branching: bool,
        cost: impl Fn(&CaseConfig) -> Cost + Sync,
        wanted: impl Fn(usize) -> bool,
    ) -> Plan {
        let wanted: Vec<usize> = (0..study.run_count()).filter(|&index| wanted(index)).collect();
        let chunks = wanted.par_chunks(CHUNK).map(|indices| {
            let mut known = Recent::default();
            let case = |&index| planned(study, index, branching, &cost, &mut known);
            indices.iter().map(case).collect::<Vec<_>>()
        });
        let (cases, trunks): (_, Vec<_>) = chunks.collect::<Vec<_>>().into_iter().flatten().unzip();
        let mut plan = Plan { trunks: Vec::new(), cases };
        let shared = trunks.into_iter().enumerate();
        for branches in grouped(shared.filter_map(|(place, trunk)| Some((trunk?, place)))) {
            if branches.len() < 2 {
                continue;
            }
            let first = plan.cases[branches[0]];
            let Some(config) = study.run(first.index).config.trunk() else { continue };
            for &place in &branches {
                plan.cases[place].trunk = Some(plan.trunks.len());
            }
            let cost = (first.cost - first.branch_cost).max(1);
            plan.trunks.push(PlannedTrunk { config, cost, branches });
        }
        plan
    }

    /// Particle-steps to compute.
    pub fn total_cost(&self) -> u64 {
        let branched = |case: &PlannedCase| match case.trunk {
            Some(_) => case.branch_cost,
            None => case.cost,
        };
        let cases = self.cases.iter().map(branched).fold(0, u64::saturating_add);
        self.trunks.iter().map(|trunk| trunk.cost).fold(cases, u64::saturating_add)
    }

    /// Particle-steps if every case ran from rest.
    pub fn unbranched_cost(&self) -> u64 {
        self.cases.iter().map(|case| case.cost).fold(0, u64::saturating_add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::file::SweepFile;

    fn plan(branching: bool, wanted: impl Fn(usize) -> bool) -> Plan {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    [grid]\nwave_height_ratio = [0.2, 0.3]\nspring_stiffness_n_per_m = [1, 2, 3]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let cost = Cost { particles: 100, steps: 1000, trunk_share: 0.5, memory_bytes: 1 << 20 };
        Plan::new(&study, branching, |_| cost, wanted)
    }

    #[test]
    fn cases_of_one_wave_share_a_trunk() {
        let plan = plan(true, |_| true);
        assert_eq!(plan.trunks.len(), 2);
        assert_eq!(plan.trunks[1].branches, [3, 4, 5]);
        assert!(plan.total_cost() < plan.unbranched_cost());
    }

    #[test]
    fn a_lone_case_runs_from_rest() {
        let lone = plan(true, |index| index >= 2);
        assert_eq!(lone.trunks.len(), 1);
        assert_eq!(lone.cases[0].trunk, None);
        assert_eq!(lone.trunks[0].branches, [1, 2, 3]);
        assert!(plan(false, |_| true).trunks.is_empty());
    }
}
