//! The table at the end of a sweep, and how its cases fared.

use super::execute::{Done, Job};
use super::output::{duration, short};
use super::table::Table;
use crate::results::counted;

/// Rows shown without `-v`.
const ROWS: usize = 30;

/// A row per case, `all` or the first few, and the lines below them.
pub(super) fn told(job: &Job, done: &Done, report: &std::path::Path, all: bool) -> String {
    let keys = &job.study.keys;
    let heading = ["F* max", "R* max", "X* max", "first F*", "first R*", "energy gap %", "status"];
    let mut table = Table::new(keys.iter().map(String::as_str).chain(heading));
    let rows = if all { usize::MAX } else { ROWS };
    let mut bounds = false;
    for record in done.records().take(rows) {
        let value = |key: &String| match record.values.get(key) {
            Some(serde_json::Value::String(text)) => text.clone(),
            Some(value) => value.to_string(),
            None => "-".to_owned(),
        };
        let mut cells: Vec<String> = keys.iter().map(value).collect();
        match &record.outcome {
            Some(outcome) => {
                let or_dash = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), short);
                cells.push(short(outcome.force_max.value));
                cells.push(short(outcome.runup_max.value));
                let moved = or_dash(outcome.displacement_max.map(|maximum| maximum.value));
                let truncated = outcome.displacement_truncated == Some(true);
                cells.push(if truncated { format!("≥ {moved}") } else { moved });
                bounds |= truncated;
                cells.push(or_dash(outcome.first_force_max.map(|maximum| maximum.value)));
                cells.push(or_dash(outcome.first_runup_max.map(|maximum| maximum.value)));
                cells.push(short(outcome.energy_gap_percent));
                let doubtful = outcome.doubtful_reason.is_some();
                cells.push(if doubtful { "doubtful" } else { "ok" }.to_owned());
            }
            None => {
                cells.extend(std::iter::repeat_n("-".to_owned(), 6));
                cells.push(record.failure.map_or("failed", |kind| kind.name()).to_owned());
            }
        }
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
