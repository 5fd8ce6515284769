//! `sweep --film`: which cases of a study are filmed, and filming them once the results are there.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::execute::Done;
use super::failure::BadInput;
use super::film::{self, Set, Shot};
use super::output::{Output, duration};
use super::pick;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS};
use crate::execute::Interrupt;
use crate::film::Colour;
use crate::results::{CaseRecord, counted};
use crate::simulation::{Outcome, Resources};
use crate::study::{Case, Study};

/// A case that took longer than this is filmed only where it is named, seconds.
const LONGEST_S: f64 = 60.0;

/// Checks what is to be filmed before anything runs.
pub(super) fn check(words: &[String], study: &Study) -> Result<(), BadInput> {
    let cases = words.iter().filter(|word| !matches!(word.as_str(), "auto" | "none"));
    cases.map(String::as_str).try_for_each(|word| named(study, word).map(|_| ()))
}

fn named<'a>(study: &'a Study, word: &str) -> Result<&'a Case, BadInput> {
    let words: Vec<_> = word.split(',').map(str::to_owned).collect();
    let case = pick::the_case(study, &words);
    let case = case.and_then(|case| film::demand_small(case).map(|()| case));
    case.map_err(|error| BadInput(format!("--film {word}: {error}")))
}

/// The films of a directory, those of earlier calls among them.
pub(super) fn pages(directory: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(directory.join("films")).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut pages: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|ending| ending == "html")).collect();
    pages.sort();
    pages
}

/// Runs the cases again that are to be filmed, one after the other. No film costs a result: what cannot
/// be filmed is told. The exit code is what the films ask for.
pub(super) fn make(
    words: &[String],
    study: &Study,
    done: &Done,
    threads: Option<u16>,
    interrupt: &Interrupt,
    output: &Output,
) -> Result<u8, BadInput> {
    let set = Set {
        study,
        records: done.directory.runs(),
        directory: done.directory.path(),
        colour: Colour::Pressure,
        resources: Resources { simd: done.directory.simd(), threads: film::threads(threads) },
        interrupt,
    };
    let cases = wanted(words, &set, output)?;
    let mut code = SUCCESS;
    if !cases.is_empty() {
        output.note(format_args!("filming {}", counted(cases.len(), "case")));
    }
    for case in cases {
        let shot = set.shoot(case);
        match &shot {
            Ok(Shot::Differs(_)) => code = code.max(CASES_FAILED),
            Ok(Shot::Filmed(_) | Shot::NotFilmed(_)) => {}
            Ok(Shot::Interrupted) => {
                output.note("interrupted: films are missing; the same command makes them");
                code = INTERRUPTED;
                break;
            }
            Err(error) => output.note(format_args!("warning: case {}: {error:#}", case.id)),
        }
        shot.iter().for_each(|shot| shot.tell(case, output));
    }
    Ok(code)
}

/// What is asked for; what is worth a look has no second film, and takes no long time.
fn wanted<'a>(words: &[String], set: &Set<'a>, output: &Output) -> Result<Vec<&'a Case>, BadInput> {
    let mut cases: Vec<&Case> = Vec::new();
    for word in words {
        match word.as_str() {
            "none" => {}
            "auto" => {
                cases.extend(worth_a_look(set.study, set.records).into_iter().filter_map(|index| {
                    let case = &set.study.cases[index];
                    let seconds = set.records[index].as_ref().map_or(0.0, |at| at.wall_time_s);
                    if seconds > LONGEST_S {
                        output.note(format_args!(
                            "case {} took {}: not filmed unless --film names it",
                            case.id,
                            duration(seconds)
                        ));
                    }
                    let fits = seconds <= LONGEST_S && film::demand_small(case).is_ok();
                    (fits && !set.page(case).exists()).then_some(case)
                }))
            }
            word => cases.push(named(set.study, word)?),
        }
    }
    let mut seen = BTreeSet::new();
    cases.retain(|case| seen.insert(case.index));
    Ok(cases)
}

/// The cases of a study that are worth a look first: that of the largest force, of the highest runup,
/// of the softest wall that turns within the run, and the most doubtful one.
fn worth_a_look(study: &Study, records: &[Option<CaseRecord>]) -> Vec<usize> {
    let cases = records[..study.cases.len()].iter().flatten();
    let well = || cases.clone().filter_map(|record| Some((record.index, record.outcome.as_ref()?)));
    let best = |score: &dyn Fn(usize, &Outcome) -> Option<f64>| {
        let scores = well().filter_map(|(index, outcome)| Some((score(index, outcome)?, index)));
        scores.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index)
    };
    let stiffness =
        |index: usize| study.cases[index].config.scene.seawall()?.spring_stiffness_n_per_m;
    let reasons = |told: &String| told.split("; ").count() as f64;
    let mut chosen: Vec<usize> = [
        best(&|_, outcome| Some(outcome.force_max.value)),
        best(&|_, outcome| Some(outcome.runup_max.value)),
        best(&|index, outcome| {
            let turned = outcome.displacement_truncated == Some(false)
                && outcome.displacement_max.is_some_and(|maximum| maximum.value > 0.0);
            stiffness(index).filter(|_| turned).map(|stiffness| -stiffness)
        }),
        best(&|_, outcome| outcome.doubtful_reason.as_ref().map(reasons)),
    ]
    .into_iter()
    .flatten()
    .collect();
    let mut seen = BTreeSet::new();
    chosen.retain(|&index| seen.insert(index));
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::made_up;
    use crate::study::SweepFile;

    #[test]
    fn a_case_that_is_worth_a_look_in_two_ways_is_filmed_once() {
        let text = "name = \"a\"\n[scene]\nwall = \"movable\"\nseawall_mass_kg_per_m = 50\n[grid]\n\
            wave_height_ratio = [0.3, 0.5]\nspring_stiffness_n_per_m = [10, 21544.3469003188]";
        let study = Study::new(&SweepFile::read(text, &[]).unwrap()).unwrap();
        let record = |case: &Case, doubtful: bool| {
            let mut result = made_up(&case.config);
            let outcome = &mut result.outcome;
            outcome.force_max.value = [1.0, 3.0, 2.0, 1.0][case.index];
            outcome.runup_max.value = [1.0, 3.0, 2.0, 1.0][case.index];
            outcome.displacement_truncated = Some(case.index == 0);
            outcome.doubtful_reason = doubtful.then(|| "made up".to_owned());
            Some(CaseRecord::new(&study, case, &Ok(result), 1.0, "here"))
        };
        let records: Vec<_> =
            study.cases.iter().map(|case| record(case, case.index == 3)).collect();
        assert_eq!(worth_a_look(&study, &records), [1, 2, 3]);
        let records: Vec<_> = study.cases.iter().map(|case| record(case, false)).collect();
        assert_eq!(worth_a_look(&study, &records), [1, 2]);
        assert_eq!(worth_a_look(&study, &[None, None, None, None]), [0; 0]);
    }
}
