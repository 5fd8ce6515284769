//! The time that a study still takes, by what its finished runs took.

use std::collections::BTreeMap;

use crate::results::Fared;
use crate::simulation::cost;
use crate::study::{Plan, PlannedCase, Study};

/// Seconds for the runs that are left, cases and companions. They cost particle-steps, as a sweep's own progress counts
/// them: a companion costs less than its case. `ended` are the runs that are done, by their places in the study. At most
/// `places` of the others run at once.
pub(super) fn of_study(
    study: &Study,
    ended: &BTreeMap<usize, Fared>,
    places: usize,
) -> Option<f64> {
    let plan = Plan::new(study, true, cost, |_| true);
    let has_ended = |run: &PlannedCase| ended.contains_key(&run.index);
    // The time of a run does not have that of its trunk.
    let own =
        |run: &PlannedCase| (if run.trunk.is_some() { run.branch_cost } else { run.cost }) as f64;
    let (done, left): (Vec<PlannedCase>, Vec<_>) =
        plan.cases.iter().partition(|run| has_ended(run));
    // A trunk is done if one of its branches is.
    let ahead = plan
        .trunks
        .iter()
        .filter(|trunk| !trunk.branches.iter().any(|&place| has_ended(&plan.cases[place])));
    let work_left = left.iter().map(own).chain(ahead.map(|trunk| trunk.cost as f64)).sum();
    time(spent(ended), done.iter().map(own).sum(), work_left, places.min(left.len()))
}

/// The same if each of the runs that are left takes the mean time of those that are done.
pub(super) fn by_number(ended: &BTreeMap<usize, Fared>, left: usize, places: usize) -> Option<f64> {
    time(spent(ended), ended.len() as f64, left as f64, places.min(left))
}

/// The time of runs together, seconds.
pub(super) fn spent(ended: &BTreeMap<usize, Fared>) -> f64 {
    ended.values().map(|run| run.wall_time_s).sum()
}

/// The time for what is left, at the speed of what is done; `None` if nothing is.
fn time(spent_s: f64, done: f64, left: f64, at_once: usize) -> Option<f64> {
    (done > 0.0).then(|| spent_s / done * left / at_once.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::SweepFile;

    fn study(text: &str) -> Study {
        Study::new(&SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).unwrap()).unwrap()
    }

    /// The first runs of a study, of as many seconds each.
    fn ended(study: &Study, seconds: &[f64]) -> BTreeMap<usize, Fared> {
        let run = |(case, &wall_time_s): (&crate::study::Case, &f64)| {
            let (values, reason) = Default::default();
            let fared = Fared {
                index: case.index,
                id: case.id,
                values,
                failure: None,
                reason,
                wall_time_s,
            };
            (case.index, fared)
        };
        study.runs().zip(seconds).map(run).collect()
    }

    /// The story: with both cases done and three of four companions left there were 0 s to go.
    #[test]
    fn companions_count_by_their_work() {
        let study =
            study("[numerics]\nerror_bars = \"triple\"\n[grid]\nwave_height_ratio = [0.2, 0.3]");
        assert_eq!(study.run_count(), 6);
        let to_go = |seconds: &[f64], places| of_study(&study, &ended(&study, seconds), places);
        assert_eq!(to_go(&[], 1), None);
        // Twice the spacing costs about an eighth, √2 times the spacing about a third.
        let three = to_go(&[100.0, 100.0, 33.0], 1).unwrap();
        assert!((40.0..80.0).contains(&three), "{three}");
        assert_eq!(to_go(&[100.0, 100.0, 33.0], 3), Some(three / 3.0));
        assert_eq!(to_go(&[100.0, 100.0, 33.0], 64), Some(three / 3.0), "three run at once");
        let one = to_go(&[100.0, 100.0, 33.0, 12.0, 33.0], 8).unwrap();
        assert!((6.0..18.0).contains(&one), "{one}");
        assert_eq!(to_go(&[1.0; 6], 2), Some(0.0));
        let ended = ended(&study, &[100.0, 100.0, 40.0]);
        assert_eq!(by_number(&ended, 3, 1), Some(240.0), "where the study cannot be made again");
    }

    /// A trunk counts once, until a branch of it is done.
    #[test]
    fn trunks_are_ahead_until_a_branch_has_ended() {
        let springs = "[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\n\
                       wave_height_ratio = [0.3, 0.5]\nspring_stiffness_n_per_m = [1, 2]";
        let study = study(springs);
        let plan = Plan::new(&study, true, cost, |_| true);
        assert_eq!(plan.trunks.len(), 2);
        let per = 10.0 / plan.cases[0].branch_cost as f64;
        let left = plan.cases[1..].iter().map(|run| run.branch_cost as f64).sum::<f64>();
        let told = of_study(&study, &ended(&study, &[10.0]), 1).unwrap();
        let expected = per * (left + plan.trunks[1].cost as f64);
        assert!((told - expected).abs() < 1e-9 * expected, "{told} {expected}");
    }
}
