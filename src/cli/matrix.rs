//! Runs a matrix in its output directory, for `accuracy` and `stress`.

use std::path::PathBuf;

use clap::Args;

use super::execute::on_threads;
use super::failure::BadInput;
use super::input::{MATRIX, default_out, read};
use super::job::Job;
use super::options;
use super::options::EVERY_S;
use super::output::Output;
use crate::accuracy::{Matrix, Trial};
use crate::execute::Ending;
use crate::keys::named;
use crate::results::CaseRecord;

/// What both commands take.
#[derive(Debug, Args)]
pub(super) struct MatrixArgs {
    /// A file of cases and methods [default: the one in sweeps/ that has the command's name; it is built in].
    file: Option<PathBuf>,
    /// Where results go [default: results/runs/<name of the matrix>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only the cases and methods that are marked as quick. They take less than a minute.
    #[arg(long)]
    quick: bool,
    /// Only these cases. The option may be repeated.
    #[arg(long = "case", value_name = "NAME,...")]
    cases: Vec<String>,
    /// Only these methods. The option may be repeated.
    #[arg(long = "method", value_name = "NAME,...")]
    methods: Vec<String>,
    /// Move an earlier run aside and start over.
    #[arg(long)]
    fresh: bool,
    /// How many cases run at once [default: one per core]. Fewer give steadier times.
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
}

pub(super) struct Ran {
    pub(super) matrix: Matrix,
    pub(super) pairs: Vec<Trial>,
    pub(super) records: Vec<Option<CaseRecord>>,
    pub(super) out: PathBuf,
    /// The exit code of an interrupted run.
    pub(super) interrupted: Option<u8>,
}

/// Runs the missing part of a matrix, or of the built-in one, in its directory. If `branching`,
/// cases share trunks. They do not where the time of each is measured.
pub(super) fn run(
    args: &MatrixArgs,
    built_in: &str,
    branching: bool,
    output: &Output,
) -> anyhow::Result<Ran> {
    let text = match &args.file {
        None => built_in.to_owned(),
        Some(path) => read(path, MATRIX)?,
    };
    let built_in = || "the built-in matrix".to_owned();
    let name = args.file.as_ref().map_or_else(built_in, |path| named(path));
    let told = |error| BadInput(format!("{name}: {error}"));
    if is_of_study(&text) {
        let told = format!("{name}: is a sweep or scene file; {}", MATRIX.advice());
        return Err(BadInput(told).into());
    }
    let whole = Matrix::read(&text).map_err(told)?;
    let matrix = whole.only(&args.cases, &args.methods).map_err(told)?;
    let (study, pairs) = matrix.study(args.quick, &text);
    if study.cases.is_empty() {
        return Err(BadInput(format!("{name}: {}", nothing_runs(&pairs, args.quick))).into());
    }
    let out = args.out.clone().unwrap_or_else(|| default_out(&study));
    let job = Job {
        branching,
        shares_threads: false, // What a method costs is told.
        ..Job::of(study, out, args.fresh)
    };
    let done = on_threads(&job, args.threads, None, EVERY_S, output)?;
    if done.ending == Ending::Interrupted {
        output.note("interrupted; the same command goes on");
    }
    Ok(Ran {
        matrix,
        pairs,
        records: done.directory.case_records().to_vec(),
        out: done.directory.path().to_owned(),
        interrupted: (done.ending == Ending::Interrupted).then(|| done.exit_code()),
    })
}

/// Whether a file has sections that only sweep and scene files have.
fn is_of_study(text: &str) -> bool {
    let file: toml::Table = text.parse().unwrap_or_default();
    ["scene", "numerics", "grid", "probe"].iter().any(|section| file.contains_key(*section))
}

/// Why no pair of a case and a method is left.
fn nothing_runs(pairs: &[Trial], quick: bool) -> String {
    match pairs.iter().find_map(|pair| pair.run.as_ref().err()) {
        Some(reason) => format!("no case that this program can run: {reason}"),
        None if quick => {
            "no such case and method are both marked as quick; leave --quick out".into()
        }
        None => "no such method is for such a case".into(),
    }
}
