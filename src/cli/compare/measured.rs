//! `seawall compare DIR MEASURED.csv`: a case beside measurements.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::CompareArgs;
use super::files::save;
use crate::cli::failure::BadInput;
use crate::cli::output::{Output, json_path, json_paths, short};
use crate::cli::picked_case::the_case;
use crate::cli::stored::{demand_summary, file_and_study};
use crate::cli::table::Table;
use crate::keys::{hint, named};
use crate::math::decimal::significant;
use crate::math::words::counted;
use crate::quantities::summary::CASE_ID;
use crate::report::compare::{Beside, Held, figure_of_held, hold, slips, table_of_held};
use crate::report::load::Loaded;

pub(super) fn main(args: &CompareArgs, output: &Output) -> anyhow::Result<()> {
    let (directory, record) = (args.first.as_path(), args.second.as_path());
    demand_summary(directory)?;
    if !record.is_file() {
        return Err(BadInput::of(record, "no such file").into());
    }
    let data = Loaded::read(directory).map_err(|error| BadInput(error.to_string()))?;
    let case_id = case(&data, directory, &args.case)?;
    let held = hold(&data, &case_id, (record, between(&args.between)?))
        .map_err(|error| BadInput(error.to_string()))?;
    for column in &held.left_out {
        let near = hint(column, &held.known);
        output.note(format!(
            "{}: left out {column}: the case has no such column{near}",
            named(record)
        ));
    }
    let slips = slips(&data, &case_id, &held);
    slips.iter().for_each(|slip| output.note(format!("{}: {slip}", named(record))));
    let gaps = held.columns.iter().filter_map(gap);
    gaps.for_each(|gap| output.note(format!("{}: {gap}", named(record))));
    let files = args
        .out
        .as_ref()
        .map(|out| save(out, &table_of_held(&held).csv(), Some(&figure_of_held(&held, &case_id))));
    let files = files.transpose()?;
    let mut text = text([directory, record], &case_id, &held);
    for file in files.iter().flatten() {
        text.push_str(&format!("{}\n", named(file)));
    }
    output.result(
        &text,
        &output.value(|| value([directory, record], &case_id, (&held, &slips), files.as_deref())),
    )
}

/// How long a column or the case has no values, and where.
fn gap(column: &Beside) -> Option<String> {
    let [from, to] = column.gaps.longest()?.map(|time| significant(time, 6));
    let (all, seconds) = (column.gaps.count(), significant(column.gaps.seconds(), 4));
    let place = match all {
        1 => format!(", from {from} to {to} s"),
        _ => format!(" in {all} gaps, the longest from {from} to {to} s"),
    };
    Some(format!("{} has no values for {seconds} s{place}: nothing there counts", column.name))
}

/// The times that count.
fn between(times: &[f64]) -> Result<[f64; 2], BadInput> {
    match *times {
        [from, to] if from < to => Ok([from, to]),
        [from, to] => {
            Err(BadInput(format!("--between {from} {to}: the second time must be later")))
        }
        _ => Ok([f64::NEG_INFINITY, f64::INFINITY]),
    }
}

/// The id of the case: the only finished one, or the one that `--case` names.
fn case(data: &Loaded, directory: &Path, words: &[String]) -> anyhow::Result<String> {
    let finished: Vec<_> = data.finished().map(|row| row.text(&CASE_ID).to_owned()).collect();
    let id = match (&finished[..], words) {
        ([id], []) => return Ok(id.clone()),
        _ => the_case(&file_and_study(directory)?.1, words)
            .map_err(|error| BadInput(format!("--case: {error}")))?
            .id
            .to_string(),
    };
    if finished.contains(&id) {
        return Ok(id);
    }
    Err(BadInput::of(directory, format!("case {id} has not come to its end")).into())
}

fn text([directory, record]: [&Path; 2], case_id: &str, held: &Held) -> String {
    let columns = counted(held.columns.len(), "column");
    let heading =
        format!("{} and case {case_id} of {}: {columns}\n\n", named(record), named(directory));
    let heads = [
        "column",
        "unit",
        "from",
        "to, s",
        "measured max",
        "at, s",
        "computed",
        "off",
        "at, s",
        "rms",
        "of range",
    ];
    let mut table = Table::new(heads);
    let percent = |value: Option<f64>, plus: bool| match value {
        Some(value) if plus => format!("{value:+.1} %"),
        Some(value) => format!("{value:.1} %"),
        None => "-".to_owned(),
    };
    let time = |time: f64| format!("{time:.2}");
    for column in &held.columns {
        let [from, to] = column.times();
        let [measured, computed] = column.highest();
        let unit = if column.unit.is_empty() { "-" } else { &column.unit };
        table.row([
            column.name.clone(),
            unit.to_owned(),
            time(from),
            time(to),
            short(measured.1),
            time(measured.0),
            short(computed.1),
            percent(column.off_percent(), true),
            time(computed.0),
            short(column.rms),
            percent(column.rms_percent(), false),
        ]);
    }
    heading + &table.render()
}

fn value(
    [directory, record]: [&Path; 2],
    case_id: &str,
    (held, slips): (&Held, &[String]),
    files: Option<&[PathBuf]>,
) -> Value {
    let extreme = |(time, value): (f64, f64)| json!({ "value": value, "time_s": time });
    let column = |one: &Beside| {
        let ([high, computed_high], [low, computed_low]) = (one.highest(), one.lowest());
        json!({
            "column": one.name,
            "unit": one.unit,
            "from_s": one.times()[0],
            "to_s": one.times()[1],
            "measured_max": extreme(high),
            "computed_max": extreme(computed_high),
            "off_percent": one.off_percent(),
            "measured_min": extreme(low),
            "computed_min": extreme(computed_low),
            "rms": one.rms,
            "rms_percent": one.rms_percent(),
            "gaps_s": one.gaps.seconds(),
        })
    };
    json!({
        "directory": json_path(directory),
        "measured": json_path(record),
        "case_id": case_id,
        "columns": held.columns.iter().map(column).collect::<Vec<_>>(),
        "left_out": held.left_out,
        "slips": slips,
        "files": files.map(json_paths),
    })
}
