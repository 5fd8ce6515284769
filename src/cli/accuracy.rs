//! `seawall accuracy`: speed against error.

use clap::Args;
use serde_json::json;

use super::matrix::{MatrixArgs, run};
use super::output::{Output, json_path, short};
use super::table::Table;
use super::{CASES_FAILED, SUCCESS};
use crate::accuracy::{MethodScore, Scored, methods, score};
use crate::disk;
use crate::disk::names::ACCURACY;
use crate::keys::named;
use crate::math::comma::csv_of;
use crate::quantities::accuracy::{Errors, Line, TARGETS, cheapest_within};
use crate::report::accuracy::write;

/// Run many methods on cases with known answers. Tell the error and the processor time of each.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall accuracy --quick
  seawall accuracy --threads 2
  seawall accuracy --case standing_wave --method 'dx 0.02,R 3'
  seawall accuracy sweeps/accuracy.toml --out results/runs/accuracy --format json

The cases, their truths and the methods are those of sweeps/accuracy.toml. Errors are percent of
the truth, of the still water depth for levels; a method's error is their root mean square over all
cases. Interrupted, the same command goes on.")]
pub(super) struct AccuracyArgs {
    #[command(flatten)]
    matrix: MatrixArgs,
}

const BUILT_IN: &str = include_str!("../../sweeps/accuracy.toml");

pub(super) fn main(args: &AccuracyArgs, output: &Output) -> anyhow::Result<u8> {
    let ran = run(&args.matrix, BUILT_IN, false, output)?;
    if let Some(code) = ran.interrupted {
        return Ok(code);
    }
    let scored = score(&ran.matrix, &ran.pairs, &ran.records);
    let [scores, loads] = Errors::EACH.map(|group| methods(&ran.matrix, &scored, group));
    let about: Vec<_> =
        ran.matrix.cases.iter().map(|case| (case.name.clone(), case.about.clone())).collect();
    let lines = lines(&scored, &[(Errors::All, &scores), (Errors::Loads, &loads)]);
    disk::put(&ran.out.join(ACCURACY), csv_of(&lines))?;
    let page = write(&ran.out, &about)?;
    let mut table =
        Table::new(["method", "error, %", "worst, %", "cpu, s", "failed", "on the front"]);
    let told = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), short);
    for row in &scores {
        table.row([
            row.method.clone(),
            told(row.error_percent),
            told(row.worst_percent),
            short(row.cpu_time_s),
            row.failed.to_string(),
            if row.pareto { "yes" } else { "" }.to_owned(),
        ]);
    }
    let mut text = format!("{}\n", table.render());
    for group in Errors::EACH {
        let what = group.words();
        for target in TARGETS {
            let best = match cheapest_within(&lines, group.name(), target) {
                Some(best) => format!("{}, {} s", best.method, told(best.cpu_time_s)),
                None => "none of these".to_owned(),
            };
            text.push_str(&format!("best at {target} %, {what}: {best}\n"));
        }
    }
    text.push_str(&format!("report: {}\n", named(&page)));
    let value = json!({ "out": json_path(&ran.out), "report": json_path(&page), "methods": scores, "loads": loads, "rows": scored });
    output.result(&text, &value)?;
    Ok(if scored.iter().any(|row| row.errors().next().is_none()) { CASES_FAILED } else { SUCCESS })
}

/// A line for every pair, then for every method a line over all cases, named after the group.
fn lines(scored: &[Scored], groups: &[(Errors, &Vec<MethodScore>)]) -> Vec<Line> {
    let pair = |row: &Scored| {
        let errors: Vec<f64> = row.errors().collect();
        let mean = errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64;
        Line {
            case: row.case.clone(),
            method: row.method.clone(),
            force_error_percent: row.force_error_percent,
            runup_error_percent: row.runup_error_percent,
            displacement_error_percent: row.displacement_error_percent,
            flow_error_percent: row.flow_error_percent,
            error_percent: (!errors.is_empty()).then(|| mean.sqrt()),
            cpu_time_s: row.cpu_time_s,
            reason: row.reason.clone(),
            ..Line::default()
        }
    };
    let sums = |(group, scores): &(Errors, &Vec<MethodScore>)| {
        let name = group.name();
        let sum = move |score: &MethodScore| Line {
            case: name.to_owned(),
            method: score.method.clone(),
            error_percent: score.error_percent,
            cpu_time_s: Some(score.cpu_time_s),
            pareto: if score.pareto { "yes" } else { "no" }.to_owned(),
            ..Line::default()
        };
        scores.iter().map(sum).collect::<Vec<_>>()
    };
    scored.iter().map(pair).chain(groups.iter().flat_map(sums)).collect()
}
