//! `seawall compare`: two studies side by side, or a case beside measurements, from files alone.

mod files;
mod json;
mod measured;
mod points;

use std::path::{Path, PathBuf};

use clap::Args;

use self::files::save;
use self::points::{in_all, place, shared};
use super::SUCCESS;
use super::failure::BadInput;
use super::output::{Output, first, short};
use super::stored::demand_summary;
use super::table::Table;
use crate::keys::named;
use crate::math::decimal::significant;
use crate::math::words::counted;
use crate::quantities::Unit;
use crate::quantities::summary::RESULTS;
use crate::report::compare::{Comparison, Difference, Pair, compare, figure, table};

/// Compare two studies, or one case with measurements. Two cases form a pair if they have the same values of every [scene] key
/// that one of the studies sweeps, and of every [numerics] key that both sweep.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall compare results/runs/coarse results/runs/fine
  seawall compare results/runs/coarse results/runs/fine --out results/runs/difference
  seawall compare results/runs/liang2017 results/runs/liang2017_as_published --format json
  seawall compare results/runs/flume gauges.csv --between 265 277 --out results/runs/flume_beside

F* and R* are those of the first impact, X* and volumes over a crest of the whole run; differences are the second study less the
first. Exit code: 0 where it could compare, 2 where the studies have no case in common or cannot be read.")]
pub(super) struct CompareArgs {
    /// The output directory of the first study.
    first: PathBuf,
    /// The output directory of the second study; or a CSV file of measurements, with `time_s` and columns of the
    /// case's `probes/` or `histories/`.
    #[arg(value_name = "SECOND|CSV")]
    second: PathBuf,
    /// Which case is held against measurements: the start of its id, or values of swept keys. Several keys stand with
    /// commas between them, such as H/h=0.3,k=10, or each behind a `--case` of its own.
    #[arg(long, value_name = "CASE", num_args = 1)]
    case: Vec<String>,
    /// Hold measurements against the case from one time to another only, s.
    #[arg(long, num_args = 2, value_names = ["FROM_S", "TO_S"], allow_negative_numbers = true)]
    between: Vec<f64>,
    /// Write compare.csv and compare.svg into this directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// How many cases are shown without `-v`.
const ROWS: usize = 10;

pub(super) fn main(args: &CompareArgs, output: &Output) -> anyhow::Result<u8> {
    if args.second.is_file() || args.second.extension().is_some_and(|ending| ending == "csv") {
        measured::main(args, output)?;
        return Ok(SUCCESS);
    }
    let options = [("--case", args.case.is_empty()), ("--between", args.between.is_empty())];
    if let Some((option, _)) = options.iter().find(|(_, is_empty)| !is_empty) {
        let why = "is for a CSV file of measurements in the second place";
        return Err(BadInput(format!("{option} {why}")).into());
    }
    let directories = [args.first.as_path(), args.second.as_path()];
    for directory in directories {
        demand_summary(directory)?;
    }
    let comparison = compare(directories).map_err(|error| BadInput(error.to_string()))?;
    if comparison.pairs.is_empty() {
        return Err(nothing_in_common(directories, &comparison).into());
    }
    let files = args
        .out
        .as_ref()
        .map(|out| save(out, &table(&comparison).csv(), figure(&comparison).as_ref()));
    let files = files.transpose()?;
    let mut text = text(directories, &comparison, output.verbose);
    for file in files.iter().flatten() {
        text.push_str(&format!("{}\n", named(file)));
    }
    let value = output.value(|| json::value(directories, &comparison, files.as_deref()));
    output.result(&text, &value)?;
    Ok(SUCCESS)
}

fn nothing_in_common(directories: [&Path; 2], comparison: &Comparison) -> BadInput {
    for (directory, has) in directories.into_iter().zip(comparison.have_manifest) {
        if !has {
            let why = "manifest.json is missing or damaged: it says what was swept; `seawall sweep` makes it again";
            return BadInput::of(directory, why);
        }
    }
    let [a, b] = directories.map(named);
    BadInput(match comparison.only.each_ref().map(|only| only.first()) {
        [None, _] => format!("{a}: has no case that came to its end"),
        [_, None] => format!("{b}: has no case that came to its end"),
        [Some(first), Some(second)] => format!(
            "{a} and {b} have no case in common: the first of the one is {first}, of the other {second}"
        ),
    })
}

fn text(directories: [&Path; 2], comparison: &Comparison, all: bool) -> String {
    let mut text = String::new();
    for (one, directory) in directories.iter().enumerate() {
        let (name, finished) = (&comparison.names[one], comparison.finished[one]);
        let letter = ['A', 'B'][one];
        let cases = counted(finished, "finished case");
        text.push_str(&format!("{letter}  {} ({name}, {cases})\n", named(directory)));
    }
    let [a, b] = comparison.only.each_ref().map(Vec::len);
    let pairs = counted(comparison.pairs.len(), "pair");
    text.push_str(&format!("\n{pairs} of cases at the same point; {a} only in A, {b} only in B\n"));
    if !comparison.keys.is_empty() {
        text.push_str("\nThey differ in\n");
        let mut table = Table::new(["key", "A", "B"]);
        for key in &comparison.keys {
            let [a, b] = key.values.each_ref().map(|v| if v.is_empty() { "-" } else { v.as_str() });
            table.row([&format!("{}.{}", key.section, key.key), a, b]);
        }
        text.push_str(&table.render());
    }
    let shared = shared(comparison);
    let alike = in_all(comparison, &shared);
    let alike = if alike.is_empty() { alike } else { format!(", all at {alike}") };
    text.push_str(&format!("\nB less A{alike}\n"));
    text.push_str(&tallies(comparison, &shared));
    text.push('\n');
    text.push_str(&cases(comparison, &shared, all));
    for (one, letter) in ["A", "B"].iter().enumerate() {
        let only = &comparison.only[one];
        let shown = if all { only.len() } else { only.len().min(3) };
        for case in &only[..shown] {
            text.push_str(&format!("only in {letter}: {case}\n"));
        }
        if shown < only.len() {
            text.push_str(&format!(
                "only in {letter}: {} more (-v shows all)\n",
                only.len() - shown
            ));
        }
    }
    text
}

fn tallies(comparison: &Comparison, shared: &[&str]) -> String {
    let mut table = Table::new(["", "cases", "median", "worst", "within bars", "worst at"]);
    for at in 0..RESULTS.len() {
        let column = comparison.column(at);
        let Some(tally) = Pair::tally(&comparison.pairs, at) else { continue };
        let within = match tally.with_bars {
            0 => "no bars".to_owned(),
            bars => format!("{} of {bars}", tally.within),
        };
        let place = place(shared, &comparison.pairs[tally.worst_pair]);
        let [median, worst] = [tally.median, tally.worst]
            .map(|size| format!("{} {}", significant(to_places(size, 9), 2), unit(column.unit)));
        let count = tally.count.to_string();
        table.row([column.symbol.to_owned(), count, median, worst, within, place]);
    }
    table.render()
}

/// A size to so many decimals; zero has no sign, as two builds may differ in the last digit.
fn to_places(size: f64, decimals: i32) -> f64 {
    let whole = 10_f64.powi(decimals);
    (size * whole).round() / whole + 0.0
}

/// The unit of sizes.
fn unit(unit: Unit) -> &'static str {
    if unit == Unit::Runup { "h" } else { "%" }
}

/// The pairs with the largest differences come first. A hundredth of the depth counts as a percent.
fn cases(comparison: &Comparison, shared: &[&str], all: bool) -> String {
    let mut pairs: Vec<&Pair> = comparison.pairs.iter().collect();
    let size = |pair: &Pair| {
        let sizes = pair.differences.iter().zip(RESULTS).filter_map(|(one, column)| {
            let scale = if column.unit == Unit::Runup { 100.0 } else { 1.0 };
            Some(scale * one.as_ref()?.size()?.abs())
        });
        sizes.fold(0.0, f64::max)
    };
    pairs.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let (shown, more) = first(&pairs, ROWS, all);
    // Columns without values are left out: fixed walls have no displacement.
    let has = |at: &usize| pairs.iter().any(|pair| pair.differences[*at].is_some());
    let columns: Vec<usize> = (0..RESULTS.len()).filter(has).collect();
    let heads = columns.iter().flat_map(|&at| {
        let column = comparison.column(at);
        let symbol = column.symbol.trim_start_matches("first ").trim_end_matches(" max");
        [format!("{symbol} of A"), format!("B - A, {}", unit(column.unit))]
    });
    let mut table = Table::new(["case".to_owned()].into_iter().chain(heads));
    for pair in shown {
        let cells = columns.iter().flat_map(|&at| {
            let Some(one) = &pair.differences[at] else { return ["-".to_owned(), "-".to_owned()] };
            let mark = if one.is_within() == Some(false) { " !" } else { "" };
            let size = one
                .size()
                .map_or_else(|| "-".to_owned(), |size| format!("{:+.3}{mark}", to_places(size, 3)));
            let bound = if one.bounds[0] { "≥ " } else { "" };
            [format!("{bound}{}", short(one.values[0])), size]
        });
        table.row([place(shared, pair)].into_iter().chain(cells));
    }
    let mut text = table.render() + &more;
    if text.contains('!') {
        text.push_str("!: the difference is larger than both error bars together\n");
        let differences = comparison.pairs.iter().flat_map(|pair| &pair.differences).flatten();
        if differences.into_iter().any(Difference::has_one_bar) {
            text.push_str(
                "   where one of the two cases has no bar, it is held against the other's alone\n",
            );
        }
    }
    text
}
