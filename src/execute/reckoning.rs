//! The work of a plan that is done and left, in particle-steps.
//!
//! The end of a trunk is only known when it is reached; until then it is an estimate. A longer
//! trunk leaves its branches less work, and a shorter one leaves them more. So the sum of all work
//! changes on the way.

use std::collections::HashMap;

use crate::schedule::Work;
use crate::study::Plan;

/// The work of a plan.
#[derive(Debug)]
pub(super) struct Reckoning<'a> {
    plan: &'a Plan,
    trunks: Vec<Stretch>,
    /// Which cases have ended.
    over: Vec<bool>,
    done: i128,
    left: i128,
    /// The work done in pieces that are not yet finished, and its sum.
    under_way: HashMap<Work, i128>,
    sum: i128,
}

/// A trunk that may still run.
#[derive(Debug)]
struct Stretch {
    /// Particle-steps to its end, as far as known.
    reach: i128,
    is_over: bool,
    /// Number of branches that have not ended.
    branches: i128,
}

impl Reckoning<'_> {
    /// All work of a plan is left.
    pub fn new(plan: &Plan) -> Reckoning<'_> {
        let trunks = plan.trunks.iter().map(|trunk| Stretch {
            reach: trunk.cost.into(),
            is_over: false,
            branches: trunk.branches.len() as i128,
        });
        let trunks: Vec<_> = trunks.collect();
        let from_rest: i128 = plan.cases.iter().map(|case| i128::from(case.cost)).sum();
        let shared: i128 = trunks.iter().map(|trunk| (trunk.branches - 1) * trunk.reach).sum();
        Reckoning {
            plan,
            trunks,
            over: vec![false; plan.cases.len()],
            done: 0,
            left: from_rest - shared,
            under_way: HashMap::new(),
            sum: 0,
        }
    }

    /// A trunk has ended at this share of the way to the end of its cases. `None` if it failed, so
    /// that they run from rest.
    pub fn trunk(&mut self, trunk: usize, share: Option<f64>) {
        self.aim(trunk, share.map_or(0, |share| part(share, self.whole(trunk))));
        self.trunks[trunk].is_over = true;
        self.count(Work::Trunk(trunk), self.trunks[trunk].reach);
    }

    /// A case has ended.
    pub fn case(&mut self, case: usize) {
        let own = i128::from(self.plan.cases[case].cost) - self.reach(case);
        if let Some(trunk) = self.plan.cases[case].trunk {
            self.trunks[trunk].branches -= 1;
        }
        self.over[case] = true;
        self.count(Work::Case(case), own);
    }

    /// The present work, with its progress on the way from rest to the end of its case. Reports of
    /// ranks may be late: work that has ended does not count again.
    pub fn look(&mut self, pieces: impl IntoIterator<Item = (Work, f64)>) {
        self.under_way.clear();
        for (work, share) in pieces {
            let done = match work {
                Work::Trunk(trunk) if !self.trunks[trunk].is_over => {
                    let done = part(share, self.whole(trunk));
                    self.aim(trunk, done.max(self.trunks[trunk].reach));
                    done
                }
                Work::Case(case) if !self.over[case] => {
                    part(share, self.plan.cases[case].cost) - self.reach(case)
                }
                _ => continue,
            };
            self.under_way.insert(work, done.max(0));
        }
        self.sum = self.under_way.values().sum();
    }

    /// The work done, and the work left.
    pub fn done_and_left(&self) -> [f64; 2] {
        [self.done + self.sum, (self.left - self.sum).max(0)].map(|cost| cost as f64)
    }

    /// A piece of this size has ended.
    fn count(&mut self, work: Work, own: i128) {
        self.done += own;
        self.left -= own;
        self.sum -= self.under_way.remove(&work).unwrap_or(0);
    }

    /// A trunk ends here, so each of its branches has this much less work.
    fn aim(&mut self, trunk: usize, reach: i128) {
        let stretch = &mut self.trunks[trunk];
        self.left += (reach - stretch.reach) * (1 - stretch.branches);
        stretch.reach = reach;
    }

    /// The part of a case that its trunk computes.
    fn reach(&self, case: usize) -> i128 {
        self.plan.cases[case].trunk.map_or(0, |trunk| self.trunks[trunk].reach)
    }

    /// From rest to the end of a trunk's cases.
    fn whole(&self, trunk: usize) -> u64 {
        let first = self.plan.trunks[trunk].branches.first();
        first.map_or(0, |&case| self.plan.cases[case].cost)
    }
}

fn part(share: f64, whole: u64) -> i128 {
    (share.clamp(0.0, 1.0) * whole as f64) as i128
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Cost;
    use crate::study::{Study, SweepFile};

    /// Three branches of one wave, of 1000 particle-steps from rest. `trunk_share` is the expected
    /// share of the trunk.
    fn plan(trunk_share: f64) -> Plan {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n\
                    [grid]\nspring_stiffness_n_per_m = [1, 2, 3]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let cost = Cost { particles: 1, steps: 1000, trunk_share, memory_bytes: 1 };
        Plan::new(&study, true, |_| cost, |_| true)
    }

    /// A run that ends soon after its wall may move was once expected to be nearly all trunk. So
    /// all seemed done after the trunk, though more than half of the work was left.
    #[test]
    fn a_trunk_that_ends_sooner_leaves_its_branches_more() {
        let plan = plan(0.99);
        let mut all = Reckoning::new(&plan);
        assert_eq!(all.done_and_left(), [0.0, 1020.0]);
        all.look([(Work::Trunk(0), 0.5)]);
        assert_eq!(all.done_and_left(), [500.0, 520.0]);
        all.trunk(0, Some(0.75));
        assert_eq!(all.done_and_left(), [750.0, 750.0]);
        all.look([(Work::Case(0), 0.85), (Work::Case(1), 0.0)]);
        assert_eq!(all.done_and_left(), [850.0, 650.0]);
        (0..3).for_each(|case| all.case(case));
        assert_eq!(all.done_and_left(), [1500.0, 0.0]);
    }

    #[test]
    fn a_trunk_that_goes_farther_leaves_them_less() {
        let plan = plan(0.5);
        let mut all = Reckoning::new(&plan);
        assert_eq!(all.done_and_left(), [0.0, 2000.0]);
        all.look([(Work::Trunk(0), 0.75)]);
        assert_eq!(all.done_and_left(), [750.0, 750.0]);
        all.trunk(0, Some(0.75));
        assert_eq!(all.done_and_left(), [750.0, 750.0]);
    }

    /// Until the next report a trunk that had just ended once counted twice. If it was nearly all
    /// of the work, the bar stood at its end from then on.
    #[test]
    fn what_is_over_is_under_way_no_more() {
        let plan = plan(0.5);
        let mut all = Reckoning::new(&plan);
        let late = [(Work::Trunk(0), 0.4)];
        all.look(late);
        all.trunk(0, Some(0.5));
        assert_eq!(all.done_and_left(), [500.0, 1500.0]);
        all.look(late);
        assert_eq!(all.done_and_left(), [500.0, 1500.0]);
    }

    #[test]
    fn where_a_trunk_fails_its_cases_run_from_rest() {
        let plan = plan(0.5);
        let mut all = Reckoning::new(&plan);
        all.trunk(0, None);
        all.case(0);
        assert_eq!(all.done_and_left(), [1000.0, 2000.0]);
    }
}
