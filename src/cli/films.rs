//! `sweep --film`: chooses cases of a study, and films them once the results are there.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::failure::BadInput;
use super::film::{self, Set, Shot};
use super::highlights::{self, Highlight, highlights};
use super::job::Done;
use super::output::{Output, duration};
use super::picked_case;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS};
use crate::disk::names::{FILMS, REASONS};
use crate::execute::Interrupt;
use crate::film::Colour;
use crate::keys;
use crate::math::words::{counted, in_words};
use crate::results::Derived;
use crate::simulation::Resources;
use crate::study::{Case, Study};

/// Cases that took longer than this are filmed only if they are named, seconds.
const LONGEST_S: f64 = 60.0;

/// Checks the choice of films before anything runs. Returns the places of named cases in the study.
pub(super) fn check(words: &[String], study: &Study) -> Result<Places, BadInput> {
    let cases = words.iter().filter(|word| !matches!(word.as_str(), "auto" | "none"));
    cases.map(|word| Ok((word.clone(), named(study, word)?.index))).collect()
}

/// The place in a study of the case that a word names.
pub(super) type Places = BTreeMap<String, usize>;

fn named<'a>(study: &'a Study, word: &str) -> Result<&'a Case, BadInput> {
    let case = picked_case::the_case(study, &[word.to_owned()]);
    let case = case.and_then(|case| film::demand_small(case).map(|()| case));
    case.map_err(|error| BadInput(format!("--film {word}: {error}")))
}

/// The films of a directory, with those of earlier calls.
pub(super) fn pages(directory: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(directory.join(FILMS)).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut pages: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|it| it == "html") && path.is_file())
        .collect();
    pages.sort();
    pages
}

/// Films cases one after the other by running them again. No film costs a result: what cannot be
/// filmed is reported. Words that name no case any more stand for the case at their place. Returns
/// the films' exit code, and the seconds that they took.
pub(super) fn make(
    words: &[String],
    places: &Places,
    study: &Study,
    done: &Done,
    threads: Option<u16>,
    interrupt: &Interrupt,
    output: &Output,
) -> anyhow::Result<(u8, f64)> {
    let start = Instant::now();
    let set = Set {
        study,
        records: done.directory.records(),
        directory: done.directory.path(),
        colour: Colour::Pressure,
        resources: Resources { simd: done.directory.simd(), threads: film::threads(threads) },
        interrupt,
    };
    let highlights = match words.iter().any(|word| word == "auto") {
        true => highlights(study, set.records),
        false => Vec::new(),
    };
    let cases = wanted(words, places, &highlights, &set, output)?;
    let mut code = SUCCESS;
    let filmed_any = !cases.is_empty();
    if filmed_any {
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
    let filmed = highlights.iter().filter(|one| set.page(&study.cases[one.index]).is_file());
    let reasons = set.directory.join(REASONS);
    if let Err(error) = highlights::tell(filmed, study, set.directory) {
        let (file, why) = (keys::named(&reasons), in_words(&error));
        output.note(format_args!(
            "warning: {file}: {why}; the report cannot say why cases were filmed"
        ));
    } else if !highlights.is_empty() {
        Derived::renew(set.directory, &[reasons])?;
    }
    Ok((code, if filmed_any { start.elapsed().as_secs_f64() } else { 0.0 }))
}

/// The cases to film. Those of `auto` must be short and have no film yet, unless it is damaged.
fn wanted<'a>(
    words: &[String],
    places: &Places,
    highlights: &[Highlight],
    set: &Set<'a>,
    output: &Output,
) -> Result<Vec<&'a Case>, BadInput> {
    let mut cases: Vec<&Case> = Vec::new();
    for word in words {
        match word.as_str() {
            "none" => {}
            "auto" => cases.extend(highlights.iter().filter_map(|one| {
                let case = &set.study.cases[one.index];
                let seconds = set.records[one.index].as_ref().map_or(0.0, |at| at.wall_time_s);
                if seconds > LONGEST_S {
                    output.note(format_args!(
                        "case {} took {}: not filmed unless --film names it",
                        case.id,
                        duration(seconds)
                    ));
                }
                let fits = seconds <= LONGEST_S && film::demand_small(case).is_ok();
                let there = set.page(case).exists();
                let damaged = there && Derived::is_damaged(set.directory, &set.files(case));
                if damaged {
                    output.note(format_args!("the film of case {} is damaged", case.id));
                }
                (fits && (damaged || !there)).then_some(case)
            })),
            word => cases.push(match (named(set.study, word), places.get(word)) {
                (Err(_), Some(&place)) => &set.study.cases[place],
                (case, _) => case?,
            }),
        }
    }
    let mut seen = BTreeSet::new();
    cases.retain(|case| seen.insert(case.index));
    Ok(cases)
}
