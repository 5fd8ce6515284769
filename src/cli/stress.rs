//! `seawall stress`: numerical stability on hard cases.

use clap::Args;
use serde_json::json;

use super::matrix::{MatrixArgs, run};
use super::output::{Output, json_path};
use super::table::Table;
use super::{CASES_FAILED, SUCCESS};
use crate::accuracy::{Judged, Matrix, Verdict, judge};
use crate::disk;
use crate::keys::named;
use crate::math::comma::csv;
use crate::math::lists::different;
use crate::report::tables;

/// Run many methods on hard cases, and tell which method survives which case. What counts as surviving is
/// stated beforehand.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall stress
  seawall stress --quick
  seawall stress sweeps/stress.toml --out results/runs/stress --threads 2
  seawall stress --quick --format json
  seawall stress --case rest_35s,wave_0.7 --method default

The cases, their criteria and the methods are those of sweeps/stress.toml. Exit code 1: some case
failed or missed its criterion.")]
pub(super) struct StressArgs {
    #[command(flatten)]
    matrix: MatrixArgs,
}

pub(super) const BUILT_IN: &str = include_str!("../../sweeps/stress.toml");

pub(super) fn main(args: &StressArgs, output: &Output) -> anyhow::Result<u8> {
    let ran = run(&args.matrix, BUILT_IN, true, output)?;
    if let Some(code) = ran.interrupted {
        return Ok(code);
    }
    let judged = judge(&ran.matrix, &ran.pairs, &ran.records);
    let page = ran.out.join("stress.md");
    disk::put(&ran.out.join("stress.csv"), table_of(&judged))?;
    disk::put(&page, markdown(&ran.matrix, &judged))?;
    let survived = |row: &&Judged| matches!(row.verdict, Verdict::Passed | Verdict::NotThere);
    let all_well = judged.iter().all(|row| survived(&row));
    let mut table = Table::new(["case", "method", "verdict", "edge", "closest bound, or reason"]);
    for row in &judged {
        table.row([&row.case, &row.method, word(&row.verdict), &edge(row), &row.reason]);
    }
    let text = format!("{}\nreport: {}\n", table.render(), named(&page));
    output.result(
        &text,
        &json!({ "out": json_path(&ran.out), "report": json_path(&page), "rows": judged }),
    )?;
    Ok(if all_well { SUCCESS } else { CASES_FAILED })
}

fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Passed => "passed",
        Verdict::Missed => "missed",
        Verdict::Failed => "failed",
        Verdict::NotThere => "not there",
    }
}

fn edge(row: &Judged) -> String {
    row.edge.map_or_else(|| "-".to_owned(), |edge| format!("{edge:.2}"))
}

fn table_of(judged: &[Judged]) -> String {
    let header = ["case", "method", "verdict", "edge", "reason", "wall_time_s"];
    let row = |row: &Judged| {
        let time = row.wall_time_s.map(|time| format!("{time:.1}")).unwrap_or_default();
        let edge = row.edge.map(|edge| format!("{edge:.3}")).unwrap_or_default();
        let verdict = word(&row.verdict).to_owned();
        [row.case.clone(), row.method.clone(), verdict, edge, row.reason.clone(), time]
    };
    csv([header.map(str::to_owned)].into_iter().chain(judged.iter().map(row)))
}

/// The matrix of methods and cases survived, then every case with its criterion.
fn markdown(matrix: &Matrix, judged: &[Judged]) -> String {
    let methods = different(judged.iter().map(|row| row.method.as_str()));
    let mut text = format!(
        "# Hard cases\n\nWritten by `seawall stress` (physics version {}). A number is the largest \
         share of a bound that the run reached,\ncriteria and health alike: below 1 it passed, \
         above 1 it ran to its end and missed the criterion. A word is the\nkind of failure. `-`: \
         not run with this method, or not in this build.\n\n",
        crate::study::PHYSICS_VERSION
    );
    let line = |name: &String| {
        let own =
            |method: &&str| judged.iter().find(|row| row.case == *name && row.method == *method);
        let cells = methods.iter().map(|method| own(method).map_or("-".to_owned(), cell));
        [name.clone()].into_iter().chain(cells).collect::<Vec<_>>()
    };
    let lines = matrix.cases.iter().map(|case| line(&case.name));
    let lines = lines.filter(|cells| cells[1..].iter().any(|cell| cell != "-")).collect();
    let header = [&["case"], &methods[..]].concat();
    text.push_str(&tables::Table::new("", "", &header, lines).markdown());
    text.push_str("\n## Cases and criteria\n\n");
    for case in &matrix.cases {
        let ranges =
            case.pass.iter().map(|(name, [low, high])| format!("{name} in [{low}, {high}]"));
        let same = case.same.iter().map(|same| {
            let percent = 100.0 * same.tolerance;
            let names: Vec<_> = same.quantities.iter().map(ToString::to_string).collect();
            format!("{} within {percent} % of {}", names.join(", "), same.case)
        });
        let criteria: Vec<_> = ranges.chain(same).collect();
        let criteria =
            if criteria.is_empty() { "runs to its end".to_owned() } else { criteria.join("; ") };
        text.push_str(&format!("- **{}**: {}. Criterion: {criteria}.\n", case.name, case.about));
    }
    text.push_str("\n## Failures and misses\n\n");
    let bad = |row: &&Judged| matches!(row.verdict, Verdict::Missed | Verdict::Failed);
    for row in judged.iter().filter(bad) {
        text.push_str(&format!("- {}, {}: {}\n", row.case, row.method, row.reason));
    }
    text
}

fn cell(row: &Judged) -> String {
    match row.verdict {
        Verdict::NotThere => "-".to_owned(),
        Verdict::Failed => row.reason.split(' ').next().unwrap_or("failed").to_owned(),
        Verdict::Passed | Verdict::Missed => edge(row),
    }
}
