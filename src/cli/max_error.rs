//! `sweep --max-error`: reports the chosen numerics, and whether they reach the aim.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde_json::json;

use super::cost::{estimated_time, time_of_all};
use super::failure::BadInput;
use super::job::Done;
use super::output::{Output, short};
use crate::accuracy::{Choice, Choices, MaxError, Missed, Verified};
use crate::disk;
use crate::disk::names::MAX_ERROR;
use crate::math::lists::counts;
use crate::math::words::counted;
use crate::results::finished;
use crate::simulation::cost;
use crate::study::{Plan, Study};

/// Reads the argument of `--max-error`.
pub(super) fn percent(text: &str) -> Result<f64, String> {
    let allowed = "a percentage above 0, as a number alone: 2 stands for 2 %";
    let number = text.trim_end_matches(['%', ' ']);
    match number.parse::<f64>().ok().filter(|percent| percent.is_finite() && *percent > 0.0) {
        Some(percent) if number == text => Ok(percent),
        Some(percent) => Err(format!("write {percent}: it is {allowed}")),
        None => Err(format!("must be {allowed}")),
    }
}

/// The error that is aimed at, from the command line or else from the file.
pub(super) fn aim(asked: Option<f64>, study: &Study) -> Result<Option<MaxError>, BadInput> {
    let Some(percent) = asked.or(study.max_error_percent) else { return Ok(None) };
    if study.refine.is_some() {
        let reason = "cannot stand beside grid.refine: give one of the two";
        return Err(BadInput(format!("--max-error {percent}: {reason}")));
    }
    MaxError::new(percent, study).map(Some).map_err(BadInput)
}

/// The study as `sweep` begins it: with chosen numerics, if an error is aimed at.
pub(super) fn chosen(asked: Option<f64>, study: Study, output: &Output) -> Result<Study, BadInput> {
    Ok(match aim(asked, &study)? {
        Some(aim) => first(&aim, &study, output),
        None => study,
    })
}

/// Seconds on this machine's cores for a study with chosen numerics, in the worst case: all bars
/// are too wide until nothing finer is known.
pub(super) fn longest(percent: f64, study: &Study) -> Result<f64, BadInput> {
    let aim = MaxError::new(percent, study).map_err(BadInput)?;
    let mut seconds = time_of_all(study).0;
    let mut choices = aim.all_finer(study);
    let mut study = with(study, &choices);
    while !choices.is_empty() {
        let companions = choices.keys().flat_map(|&case| &study.companions_of[case]);
        let again: BTreeSet<_> = choices.keys().chain(companions).copied().collect();
        let plan = Plan::new(&study, true, cost, |run| again.contains(&run));
        seconds += estimated_time(&study, &plan).0;
        choices = aim.all_finer(&study);
        study = with(&study, &choices);
    }
    Ok(seconds)
}

/// The words of `check` for a study with chosen numerics.
pub(super) fn ahead(percent: f64) -> String {
    format!(
        "{percent} %: these are the numerics that `sweep` begins with; cases whose error bars come out wider, or \
         that are doubtful or fail, run again, finer"
    )
}

/// The study with the numerics that are expected to suffice. Reports them and why.
pub(super) fn first(aim: &MaxError, study: &Study, output: &Output) -> Study {
    let choices = aim.first(study);
    for (line, cases) in counts(choices.values().map(|choice| reason(choice, aim.percent()))) {
        output.note(format_args!("{}: {line}", counted(cases, "case")));
    }
    let chosen = with(study, &choices).aiming_at(aim.percent());
    if let Some((floor, cases)) = aim.floor(&chosen) {
        output.note(format_args!(
            "warning: --max-error {}: {} cannot have error bars narrower than {} %, however fine the \
             particles: readings scatter by that much between spacings, and by the sound in the water; \
             these run once",
            aim.percent(),
            counted(cases, "case"),
            short(floor)
        ));
    }
    chosen
}

/// The study as an earlier run left it, with its later choices; else as `sweep` begins it.
pub(super) fn begun(
    aim: &MaxError,
    study: &Study,
    out: &Path,
    fresh: bool,
    output: &Output,
) -> Study {
    let first = first(aim, study, output);
    let here = || stored(aim.percent(), study, out).ok();
    Some(out).filter(|_| !fresh).and_then(|_| here()).unwrap_or(first)
}

/// Why a case gets its numerics.
fn reason(choice: &Choice, percent: f64) -> String {
    let hope = if choice.meets {
        format!("the cheapest that is expected to be within {percent} %")
    } else {
        format!("the most accurate that is known, though not expected to be within {percent} %")
    };
    format!(
        "particles {} m apart (method {:?} of sweeps/accuracy.toml), {hope}: force and displacement were \
         {} % off in {}, which took {} s",
        short(choice.config.numerics.particle_spacing_m),
        choice.method,
        short(choice.expected_percent),
        choice.because,
        short(choice.cost_s)
    )
}

/// The study with finer spacings where bars are too wide; `None` where nothing is to do.
pub(super) fn refine(aim: &MaxError, study: &Study, done: &Done, output: &Output) -> Option<Study> {
    let finer = aim.finer(study, done.directory.records());
    if finer.is_empty() {
        return None;
    }
    let verified = aim.verify(study, done.directory.records()).into_iter();
    let again: Vec<_> = verified.filter(|case| finer.contains_key(&case.index)).collect();
    let (percent, why) = (aim.percent(), why(&missed(&again)));
    output.note(format_args!(
        "not within {percent} %: {why}; these run once more with finer particles"
    ));
    Some(with(study, &finer))
}

/// The study of a finished or stopped sweep, from its journal: with the numerics chosen first, or
/// finer ones if their runs have begun.
pub(super) fn stored(percent: f64, study: &Study, directory: &Path) -> anyhow::Result<Study> {
    let aim = MaxError::new(percent, study).map_err(BadInput)?;
    let mut chosen = with(study, &aim.first(study)).aiming_at(percent);
    loop {
        let records = finished(directory, &chosen)?;
        let choices = aim.finer(&chosen, &records);
        let finer = with(&chosen, &choices);
        let begun = finished(directory, &finer)?;
        if choices.keys().all(|&index| begun[index].is_none()) {
            return Ok(chosen);
        }
        chosen = finer;
    }
}

/// What a sweep does next in a stored study: its own cases or, once they are done, finer ones.
pub(super) fn next(percent: f64, study: Study, directory: &Path) -> anyhow::Result<Study> {
    let records = finished(directory, &study)?;
    if records.iter().any(Option::is_none) {
        return Ok(study);
    }
    let aim = MaxError::new(percent, &study).map_err(BadInput)?;
    Ok(with(&study, &aim.finer(&study, &records)))
}

fn with(study: &Study, choices: &Choices) -> Study {
    study.with_choices(|index| choices.get(&index).map(|choice| choice.config.clone()))
}

/// How many cases miss the aim, by reason.
fn missed(verified: &[Verified]) -> BTreeMap<Missed, usize> {
    counts(verified.iter().filter_map(|case| case.missed))
}

/// The reasons in words.
fn why(missed: &BTreeMap<Missed, usize>) -> String {
    let told = |(missed, cases): (&Missed, &usize)| {
        let cases = counted(*cases, "case");
        match missed {
            Missed::Failed => format!("{cases} failed"),
            Missed::Doubtful => format!("{cases} doubtful"),
            Missed::WithoutBars => format!("{cases} without error bars"),
            Missed::Wide => format!("{cases} with wider error bars"),
        }
    };
    missed.iter().map(told).collect::<Vec<_>>().join(", ")
}

/// Writes `max_error.csv` and reports how many cases reach the aim.
pub(super) fn report(
    aim: &MaxError,
    study: &Study,
    done: &Done,
) -> anyhow::Result<(String, serde_json::Value)> {
    let verified = aim.verify(study, done.directory.records());
    disk::put(&done.directory.path().join(MAX_ERROR), aim.csv(study, &verified))?;
    let met = verified.iter().filter(|case| case.missed.is_none()).count();
    let (percent, cases) = (aim.percent(), counted(study.cases.len(), "case"));
    let widest = verified.iter().filter_map(|case| case.bar_percent).max_by(f64::total_cmp);
    let widest_told = widest.map(|bar| format!("; the widest bar is {} %", short(bar)));
    let floor = aim.floor(study).map(|(floor, _)| floor);
    let floor_told = floor.map(|floor| format!("; none can be narrower than {} %", short(floor)));
    let missed = missed(&verified);
    let missed_told =
        (!missed.is_empty()).then(|| format!("not within {percent} %: {}\n", why(&missed)));
    let told = format!(
        "force and displacement are within {percent} % by their error bars in {met} of {cases} \
         (max_error.csv){}{}\n{}",
        widest_told.unwrap_or_default(),
        floor_told.unwrap_or_default(),
        missed_told.unwrap_or_default()
    );
    let value = json!({
        "max_error_percent": percent,
        "met": met,
        "missed": missed,
        "widest_bar_percent": widest,
        "narrowest_possible_bar_percent": floor,
    });
    Ok((told, value))
}
