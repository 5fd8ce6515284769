//! What `accuracy` and `stress` have in common: running a matrix in its output directory.

use std::path::{Path, PathBuf};

use super::execute::{Done, Job, execute};
use super::failure::BadInput;
use super::input::{SimdChoice, default_out};
use super::output::Output;
use crate::sweep::executor::{Setup, threads};
use crate::sweep::matrix::{Matrix, Pair};
use crate::sweep::{CaseRecord, Ending, Interrupt, OpenMode, SphRunner};

/// What the user asked for.
pub(super) struct Request<'a> {
    /// The user's own matrix.
    pub(super) file: Option<&'a Path>,
    /// The one that is built in.
    pub(super) built_in: &'static str,
    pub(super) out: Option<&'a Path>,
    pub(super) quick: bool,
    pub(super) fresh: bool,
    pub(super) threads: Option<u16>,
    /// Whether cases may share trunks; not where each one's time is measured.
    pub(super) branching: bool,
}

/// A matrix that has been run.
pub(super) struct Ran {
    pub(super) matrix: Matrix,
    pub(super) pairs: Vec<Pair>,
    pub(super) records: Vec<Option<CaseRecord>>,
    pub(super) out: PathBuf,
    /// The exit code where it was interrupted.
    pub(super) interrupted: Option<u8>,
}

/// Runs what of a matrix is missing in its directory.
pub(super) fn run(request: &Request<'_>, output: &Output) -> anyhow::Result<Ran> {
    let text = match request.file {
        None => request.built_in.to_owned(),
        Some(path) => std::fs::read_to_string(path)
            .map_err(|error| BadInput(format!("{}: {error}", path.display())))?,
    };
    let name = request.file.map_or("the built-in matrix".into(), |path| path.display().to_string());
    let matrix = Matrix::read(&text).map_err(|error| BadInput(format!("{name}: {error}")))?;
    let (study, pairs) = matrix.study(request.quick, &text);
    if study.cases.is_empty() {
        return Err(BadInput(format!("{name}: no case that this program can run")).into());
    }
    let job = Job {
        out: request.out.map_or_else(|| default_out(&study), Path::to_owned),
        study,
        mode: if request.fresh { OpenMode::Fresh } else { OpenMode::Resume },
        retry_failed: false,
        branching: request.branching,
        simd: SimdChoice::Auto.path(),
        overrides: Vec::new(),
    };
    let interrupt = Interrupt::listen()?;
    let setup = Setup {
        make_runner: &|simd| Box::new(SphRunner { simd }),
        threads: request.threads.map(usize::from),
        interrupt: &interrupt,
    };
    let done: Done = threads::with_crew(&setup, |crew| execute(&job, crew, &interrupt, output))?;
    if done.ending == Ending::Interrupted {
        output.note("interrupted; the same command goes on");
    }
    Ok(Ran {
        matrix,
        pairs,
        records: done.directory.records().to_vec(),
        out: done.directory.path().to_owned(),
        interrupted: (done.ending == Ending::Interrupted).then(|| done.exit_code()),
    })
}
