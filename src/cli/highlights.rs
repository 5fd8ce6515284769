//! The cases of a study that are most worth a look, and why.

use std::path::Path;

use crate::disk;
use crate::disk::names::{HIGHEST_RUNUP, LARGEST_FORCE, REASONS};
use crate::math::comma::csv;
use crate::results::CaseRecord;
use crate::simulation::Outcome;
use crate::study::Study;

/// The reasons that make a case worth a look.
const CRITERIA: [Criterion; 4] = [
    (LARGEST_FORCE, |_, outcome| Some(outcome.force_max.value)),
    (HIGHEST_RUNUP, |_, outcome| Some(outcome.runup_max.value)),
    ("softest wall that turns", |stiffness, outcome| {
        let turned = outcome.displacement_truncated == Some(false)
            && outcome.displacement_max.is_some_and(|maximum| maximum.value > 0.0);
        stiffness.filter(|_| turned).map(|stiffness| -stiffness)
    }),
    ("most reasons for doubt", |_, outcome| {
        let reasons = outcome.doubtful_reason.as_ref()?;
        Some(reasons.split("; ").count() as f64)
    }),
];

/// A criterion's name, and a case's score from its spring's stiffness and its outcome.
type Criterion = (&'static str, fn(Option<f64>, &Outcome) -> Option<f64>);

/// A case that is worth a look.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Highlight {
    /// The case's index in its study.
    pub(super) index: usize,
    /// Why, in words.
    pub(super) reason: String,
}

/// The best case by each criterion. If that case is there already, the criterion brings its best
/// case that is not there yet.
pub(super) fn highlights(study: &Study, records: &[Option<CaseRecord>]) -> Vec<Highlight> {
    let cases = records[..study.cases.len()].iter().flatten();
    let well: Vec<_> =
        cases.filter_map(|record| Some((record.index, record.outcome.as_ref()?))).collect();
    let stiffness =
        |index: usize| study.cases[index].config.scene.seawall()?.spring_stiffness_n_per_m;
    let best = |(_, score): &Criterion, taken: &[Highlight]| {
        let free = well.iter().filter(|(index, _)| taken.iter().all(|one| one.index != *index));
        let scores =
            free.filter_map(|&(index, outcome)| Some((score(stiffness(index), outcome)?, index)));
        scores.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index)
    };
    let mut found: Vec<Highlight> = Vec::new();
    let mut spare = Vec::new();
    for criterion in &CRITERIA {
        let Some(index) = best(criterion, &[]) else { continue };
        match found.iter_mut().find(|one| one.index == index) {
            Some(one) => {
                one.reason = format!("{}, {}", one.reason, criterion.0);
                spare.push(criterion);
            }
            None => found.push(Highlight { index, reason: criterion.0.to_owned() }),
        }
    }
    for criterion in spare {
        let Some(index) = best(criterion, &found) else { continue };
        found.push(Highlight { index, reason: format!("next {}", criterion.0) });
    }
    found
}

/// Writes for the report why cases were filmed, in place of earlier reasons; nothing if none was.
pub(super) fn tell<'a>(
    filmed: impl Iterator<Item = &'a Highlight>,
    study: &Study,
    directory: &Path,
) -> std::io::Result<()> {
    let row = |one: &Highlight| [study.cases[one.index].id.to_string(), one.reason.clone()];
    let mut rows = vec![["case_id", "reason"].map(str::to_owned)];
    rows.extend(filmed.map(row));
    if rows.len() == 1 {
        return Ok(());
    }
    disk::put(&directory.join(REASONS), csv(rows))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::picked_case::tests::study;
    use crate::results::made_up;
    use crate::study::Case;

    /// Records with these forces, these runups, and these numbers of reasons for doubt.
    fn records(
        study: &Study,
        forces: [f64; 4],
        runups: [f64; 4],
        turned: [bool; 4],
        doubts: [usize; 4],
    ) -> Vec<Option<CaseRecord>> {
        let record = |case: &Case| {
            let mut result = made_up(&case.config);
            let outcome = &mut result.outcome;
            outcome.force_max.value = forces[case.index];
            outcome.runup_max.value = runups[case.index];
            outcome.displacement_truncated = Some(!turned[case.index]);
            let doubts = vec!["made up"; doubts[case.index]];
            outcome.doubtful_reason = (!doubts.is_empty()).then(|| doubts.join("; "));
            Some(CaseRecord::new(study, case, &Ok(result), 1.0, "here"))
        };
        study.cases.iter().map(record).collect()
    }

    fn told(study: &Study, records: &[Option<CaseRecord>]) -> Vec<(usize, String)> {
        highlights(study, records).into_iter().map(|one| (one.index, one.reason)).collect()
    }

    #[test]
    fn each_criterion_has_its_best_case() {
        let study = study();
        let rising = [1.0, 2.0, 3.0, 4.0];
        let records =
            records(&study, rising, [1.0, 4.0, 3.0, 2.0], [true, true, false, true], [0, 0, 1, 0]);
        let expected = [
            (3, "largest force"),
            (1, "highest runup"),
            (0, "softest wall that turns"),
            (2, "most reasons for doubt"),
        ];
        assert_eq!(told(&study, &records), expected.map(|(at, why)| (at, why.to_owned())));
        assert_eq!(told(&study, &[None, None, None, None]), []);
    }

    #[test]
    fn where_criteria_coincide_the_next_best_case_comes_in() {
        // All four fell on one or two cases of a large study: there were only two films.
        let study = study();
        let rising = [1.0, 2.0, 3.0, 4.0];
        let records = records(&study, rising, rising, [false, false, false, true], [0, 1, 0, 3]);
        let best = "largest force, highest runup, softest wall that turns, most reasons for doubt";
        let expected = [(3, best), (2, "next highest runup"), (1, "next most reasons for doubt")];
        assert_eq!(told(&study, &records), expected.map(|(at, why)| (at, why.to_owned())));
    }
}
