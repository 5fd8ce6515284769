//! The table at the end of a sweep, and how its cases fared.

use super::execute::{Done, Job};
use super::output::{duration, short};
use super::table::Table;
use crate::math::name::name_of;
use crate::quantities::summary::{
    DISPLACEMENT_MAX, ENERGY_GAP, FIRST_FORCE_MAX, FIRST_RUNUP_MAX, FORCE_MAX, RUNUP_MAX, STATUS,
};
use crate::quantities::{Bars, Column};
use crate::results::counted;

/// Rows shown without `-v`.
const ROWS: usize = 30;
/// Shown besides what was swept and how the case fared.
const SHOWN: [&Column; 6] =
    [&FORCE_MAX, &RUNUP_MAX, &DISPLACEMENT_MAX, &FIRST_FORCE_MAX, &FIRST_RUNUP_MAX, &ENERGY_GAP];

/// A row per case, `all` or the first few, and the lines below them.
pub(super) fn told(job: &Job, done: &Done, report: &std::path::Path, all: bool) -> String {
    let keys = &job.study.keys;
    let heading = SHOWN.into_iter().chain([&STATUS]).map(Column::heading);
    let mut table = Table::new(keys.iter().cloned().chain(heading));
    let rows = if all { usize::MAX } else { ROWS };
    let mut bounds = false;
    for record in done.records().take(rows) {
        let value = |key: &String| match record.values.get(key) {
            Some(serde_json::Value::String(text)) => text.clone(),
            Some(value) => value.to_string(),
            None => "-".to_owned(),
        };
        let mut cells: Vec<String> = keys.iter().map(value).collect();
        let case = record.reported(&job.study.cases[record.index].config, Bars::default());
        for column in SHOWN {
            let number = column.number(&case).map_or_else(|| "-".to_owned(), short);
            let bound = column.is_bound(&case);
            cells.push(if bound { format!("≥ {number}") } else { number });
            bounds |= bound;
        }
        cells.push(match &record.outcome {
            Some(outcome) if outcome.doubtful_reason.is_some() => "doubtful".to_owned(),
            Some(_) => "ok".to_owned(),
            None => record.failure.map_or_else(|| "failed".to_owned(), name_of),
        });
        table.row(cells);
    }
    let mut text = table.render();
    let total = done.records().count();
    if total > rows {
        text.push_str(&format!("... and {} more in summary.csv (-v shows all)\n", total - rows));
    }
    if bounds {
        text.push_str("≥: the wall was still moving at the end, a lower bound\n");
    }
    let (failed, doubtful) = (done.failed(), done.doubtful());
    let are = if total == 1 { "is" } else { "are" };
    text.push_str(&format!("\n{} of {} {are} well", total - failed, counted(total, "case")));
    if failed > 0 {
        text.push_str(&format!(", {failed} failed (seawall status tells why)"));
    }
    if let Some(wall_time) = done.wall_time_s {
        text.push_str(&format!("; {}", duration(wall_time)));
    }
    if done.savings.trunks > 0 && done.savings.steps_from_rest > 0 {
        let computed = done.savings.steps_computed as f64;
        let saved = 100.0 * (1.0 - computed / done.savings.steps_from_rest as f64);
        text.push_str(&format!("; shared trunks saved {saved:.0} % of the steps"));
    }
    text.push('\n');
    if doubtful > 0 {
        let (is, its) =
            if doubtful == 1 { ("is", "its history") } else { ("are", "their histories") };
        text.push_str(&format!(
            "{} {is} doubtful (doubtful_reason in summary.csv): look at {its} first\n",
            counted(doubtful, "finished case")
        ));
    }
    text.push_str(&format!("report: {}\n", report.display()));
    text
}
