//! The table at the end of a sweep, and the state of its cases.

use std::collections::BTreeSet;
use std::path::Path;

use super::job::{Done, Job};
use super::lost_bars;
use super::output::{duration, with_marks};
use super::table::Table;
use crate::keys::{self, Shared};
use crate::math::lists::counts;
use crate::math::name::name_of;
use crate::math::words::counted;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, ENERGY_GAP, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, FORCE_MAX, OVERTOPPING_VOLUME,
    RUNUP_MAX, STATUS,
};
use crate::quantities::{Bars, Case, Column, coarse_spacings, heading, named};
use crate::report::{as_typed_to, digits_apart};
use crate::results::CaseRecord;
use crate::simulation::kinds_of_doubt;

/// How many rows are shown without `-v`.
const ROWS: usize = 30;
/// The greatest width of a row, characters.
const WIDTH: usize = 80;
/// Columns besides swept keys and status. Each is shown if some case has a value.
const SHOWN: [&Column; 7] = [
    &FORCE_MAX,
    &RUNUP_MAX,
    &DISPLACEMENT_MAX,
    &OVERTOPPING_VOLUME,
    &FIRST_FORCE_MAX,
    &FIRST_RUNUP_MAX,
    &ENERGY_GAP,
];
/// The columns that are dropped first if there is not room for all.
const GIVEN_UP: [&Column; 6] = [
    &ENERGY_GAP,
    &FIRST_RUNUP_MAX,
    &FIRST_FORCE_MAX,
    &RUNUP_MAX,
    &OVERTOPPING_VOLUME,
    &DISPLACEMENT_MAX,
];

/// The meaning of `*` beside a load.
pub(super) const STOPPED: &str =
    "* the wall hit its stop afterwards; no maximum counts the load of that hit";

/// What the maxima are maxima of: in all scenes, and for waves at walls.
const MAXIMA: &str = "max: over the whole run";
const FIRST: &str = "; first, here or in summary.csv: over the first impact";

/// The words on the cases, and where the report is.
pub(super) fn text(job: &Job, done: &Done, report: &Path, all: bool) -> String {
    of_cases(job, done, all) + &reported(report)
}

/// Where the report is.
pub(super) fn reported(report: &Path) -> String {
    format!("report: {}\n", keys::named(report))
}

/// A row per case, for `all` or the first few, and the lines below the table.
pub(super) fn of_cases(job: &Job, done: &Done, all: bool) -> String {
    let rows = if all { usize::MAX } else { ROWS };
    let mut text = table(job, done, rows);
    let total = done.records().count();
    if total > rows {
        text.push_str(&format!("... and {} more in summary.csv (-v shows all)\n", total - rows));
    }
    let has_first = |record: &CaseRecord| {
        let told = record.reported(&job.study.cases[record.index].config, Bars::default());
        FIRST_FORCE_MAX.is_told(&told)
    };
    let first = if done.records().any(has_first) { FIRST } else { "" };
    text.push_str(&format!("{MAXIMA}{first}\n"));
    if text.contains('≥') {
        text.push_str("≥: the wall was still moving at the end, a lower bound\n");
    }
    if done.records().take(rows).any(hits_stop) {
        text.push_str(&format!("{STOPPED}\n"));
    }
    text.push_str(&fared(done, total));
    text.push_str(&doubts(done));
    text.push_str(&coarse(&done.coarse(job)));
    text.push_str(&lost_bars::of_study(&job.study, done.records(), done.directory.records()));
    text
}

/// The table of the first cases, with as many columns as there is room for.
fn table<'a>(job: &'a Job, done: &'a Done, rows: usize) -> String {
    let told = |record: &'a CaseRecord| {
        let case = &job.study.cases[record.index];
        let bars = job.study.error_bars(record.index, done.directory.records());
        (record, record.reported(&case.config, bars))
    };
    let cases: Vec<_> = done.records().take(rows).map(told).collect();
    let has = |column: &&Column| cases.iter().any(|(_, case)| column.is_told(case));
    let mut shown: Vec<_> = SHOWN.into_iter().filter(has).collect();
    let mut given_up = GIVEN_UP.into_iter();
    loop {
        let text = render(job, &cases, &shown);
        let fits = text.lines().all(|line| line.chars().count() <= WIDTH);
        let Some(least) = given_up.next().filter(|_| !fits) else { return text };
        shown.retain(|column| *column != least);
    }
}

/// A record with the same record as the columns see it.
type Told<'a> = (&'a CaseRecord, Case<'a>);

fn render(job: &Job, cases: &[Told<'_>], shown: &[&Column]) -> String {
    let swept_keys = &job.study.keys;
    let symbol = |key: &String| named(key).map_or_else(|| heading(key), Column::heading);
    let headings = shown.iter().copied().chain([&STATUS]).map(Column::heading);
    let mut table = Table::new(swept_keys.iter().map(symbol).chain(headings));
    let of_record = |record: &CaseRecord| &job.study.cases[record.index].assignments;
    let digits: Vec<_> = (0..swept_keys.len())
        .map(|key| {
            let value = |record| of_record(record)[key].as_deref().and_then(keys::number);
            digits_apart(cases.iter().filter_map(|(record, _)| value(record)))
        })
        .collect();
    let any_stops = cases.iter().any(|(record, _)| hits_stop(record));
    for (record, case) in cases {
        let mark = match hits_stop(record) {
            true => " *",
            false if any_stops => "  ", // numbers stand below numbers
            false => "",
        };
        let mut cells: Vec<String> = of_record(record).iter().zip(&digits).map(swept).collect();
        cells.extend(shown.iter().map(|column| {
            let mark = if *column == &FORCE_MAX { mark } else { "" };
            number(column, case) + mark
        }));
        cells.push(status(record));
        table.row(cells);
    }
    table.render()
}

/// Whether the wall of a case comes back onto its stop.
fn hits_stop(record: &CaseRecord) -> bool {
    record.outcome.as_ref().and_then(|outcome| outcome.stops).is_some_and(|stops| stops > 0)
}

/// The value of a swept key with so many digits.
fn swept((value, digits): (&Option<Shared<toml::Value>>, &usize)) -> String {
    match value.as_deref() {
        Some(toml::Value::String(text)) => text.clone(),
        Some(value) => keys::number(value)
            .map_or_else(|| value.to_string(), |number| as_typed_to(number, *digits)),
        None => "-".to_owned(),
    }
}

/// A number with its error bar, and a sign before it if it is a lower bound.
fn number(column: &Column, case: &Case<'_>) -> String {
    let Some(value) = column.number(case).filter(|_| column.is_told(case)) else {
        return "-".to_owned();
    };
    let bar = column.error(case).map(|bar| column.told_value(bar));
    with_marks(column.told_value(value), bar, column.is_bound(case))
}

fn status(record: &CaseRecord) -> String {
    match &record.outcome {
        Some(outcome) if outcome.doubtful_reason.is_some() => "doubtful".to_owned(),
        Some(_) => "ok".to_owned(),
        None => record.failure.map_or_else(|| "failed".to_owned(), name_of),
    }
}

/// How many cases are well, how long they took, and the time that trunks saved.
fn fared(done: &Done, total: usize) -> String {
    let failed = done.failed();
    let are = if total == 1 { "is" } else { "are" };
    let mut text = format!("\n{} of {} {are} well", total - failed, counted(total, "case"));
    if failed > 0 {
        text.push_str(&format!(
            ", {failed} failed (seawall status tells why, --retry-failed runs again what failed)"
        ));
    }
    if let Some(wall_time) = done.wall_time_s {
        text.push_str(&format!("; {}", duration(wall_time)));
    }
    if done.film_time_s > 0.0 {
        text.push_str(&format!("; films {}", duration(done.film_time_s)));
    }
    if done.savings.trunks > 0 && done.savings.steps_from_rest > 0 {
        let computed = done.savings.steps_computed as f64;
        let saved = 100.0 * (1.0 - computed / done.savings.steps_from_rest as f64);
        text.push_str(&format!("; shared trunks saved {saved:.0} % of the steps"));
    }
    text + "\n"
}

/// How many cases are doubtful, and why.
fn doubts(done: &Done) -> String {
    let doubtful = done.doubtful();
    if doubtful == 0 {
        return String::new();
    }
    let of_case = |doubt| kinds_of_doubt(doubt).collect::<BTreeSet<_>>();
    let kinds = counts(done.doubts().flat_map(of_case));
    let kinds: Vec<_> = kinds.iter().map(|(kind, cases)| format!("{kind} {cases}")).collect();
    let (is, its) = if doubtful == 1 { ("is", "its history") } else { ("are", "their histories") };
    format!(
        "{} {is} doubtful (doubtful_reason in summary.csv)\n  {}; look at {its} first\n",
        counted(doubtful, "finished case"),
        kinds.join(", ")
    )
}

/// How many cases have coarse particles, and what follows from that.
fn coarse(told: &[String]) -> String {
    let Some(why) = coarse_spacings(told.iter().map(String::as_str)) else { return String::new() };
    let have = if told.len() == 1 { "has" } else { "have" };
    let (cases, why) = (counted(told.len(), "finished case"), why.replace("; ", ";\n  "));
    format!("{cases} {have} coarse particles (coarse_spacing in summary.csv)\n  {why}\n")
}
