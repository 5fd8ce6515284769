//! `sweep --max-error`: telling what numerics were chosen, and whether they kept to the aim.

use std::collections::BTreeMap;

use serde_json::json;

use super::execute::Done;
use super::output::{Output, short};
use crate::accuracy::{Choices, MaxError};
use crate::results::counted;
use crate::study::Study;

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

/// The study with the numerics that are expected to do, and why, told.
pub(super) fn first(aim: &MaxError, study: &Study, output: &Output) -> Study {
    let choices = aim.first(study);
    let mut told: BTreeMap<String, usize> = BTreeMap::new();
    for choice in choices.values() {
        let doubt = if choice.meets { "the cheapest expected to do" } else { "the best known" };
        let line = format!(
            "{}: {doubt}, {} % of force and displacement in {} s of {}",
            choice.method,
            short(choice.expected_percent),
            short(choice.cost_s),
            choice.because
        );
        *told.entry(line).or_default() += 1;
    }
    for (line, cases) in told {
        output.note(format_args!("{} with {line}", counted(cases, "case")));
    }
    with(study, &choices).aiming_at(aim.percent())
}

/// The study with finer spacings where the bars are too wide; `None` where nothing is to be done.
pub(super) fn refine(aim: &MaxError, study: &Study, done: &Done, output: &Output) -> Option<Study> {
    let finer = aim.finer(study, done.directory.runs());
    if finer.is_empty() {
        return None;
    }
    let (percent, cases) = (aim.percent(), counted(finer.len(), "case"));
    output.note(format_args!("bars wider than {percent} % in {cases}: once more, finer"));
    Some(with(study, &finer))
}

fn with(study: &Study, choices: &Choices) -> Study {
    study.with_choices(|index| choices.get(&index).map(|choice| choice.config.clone()))
}

/// Writes `max_error.csv` and tells how many cases kept to the aim.
pub(super) fn report(
    aim: &MaxError,
    study: &Study,
    done: &Done,
) -> anyhow::Result<(String, serde_json::Value)> {
    let verified = aim.verify(study, done.directory.runs());
    std::fs::write(done.directory.path().join("max_error.csv"), aim.csv(study, &verified)?)?;
    let met = verified.iter().filter(|case| case.met).count();
    let (percent, cases) = (aim.percent(), counted(study.cases.len(), "case"));
    let told = format!(
        "bars of force and displacement within {percent} %: {met} of {cases} (max_error.csv)\n"
    );
    Ok((told, json!({ "max_error_percent": percent, "met": met })))
}
