//! Who does the work of a sweep: threads or MPI.

use clap::ValueEnum;

use super::failure::BadInput;
use crate::execute::Launcher;

/// Who does the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Executor {
    /// MPI under an MPI launcher, threads otherwise.
    Auto,
    /// One process.
    Threads,
    /// All processes of an MPI job.
    Mpi,
}

/// Whether MPI does the work.
pub(super) fn choose(
    executor: Executor,
    launcher: Launcher,
    available: bool,
) -> Result<bool, BadInput> {
    let alone = "this build has no MPI: rebuild with `cargo build --release --features mpi`";
    match executor {
        Executor::Mpi if available => Ok(true),
        Executor::Mpi => Err(BadInput(format!("--executor mpi: {alone}"))),
        Executor::Auto if launcher.present && available => Ok(true),
        Executor::Auto if launcher.is_parallel() => Err(BadInput(format!(
            "an MPI launcher started several copies of this program, but {alone}"
        ))),
        Executor::Threads if launcher.is_parallel() => Err(BadInput(
            "--executor threads: an MPI launcher started several copies of this program; \
             start it without the launcher, or use --executor mpi"
                .to_owned(),
        )),
        Executor::Auto | Executor::Threads => Ok(false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mpi_is_taken_only_where_a_launcher_is() {
        let alone = Launcher::default();
        let single = Launcher { present: true, size: Some(1), ..alone };
        let four = Launcher { present: true, size: Some(4), ..alone };
        let chosen = |executor, launcher, available| choose(executor, launcher, available).ok();
        assert_eq!(chosen(Executor::Auto, alone, true), Some(false));
        assert_eq!(chosen(Executor::Auto, four, true), Some(true));
        assert_eq!(chosen(Executor::Auto, four, false), None);
        assert_eq!(chosen(Executor::Auto, single, false), Some(false));
        assert_eq!(chosen(Executor::Threads, four, true), None);
        assert_eq!(chosen(Executor::Threads, single, true), Some(false));
        assert_eq!(chosen(Executor::Mpi, alone, true), Some(true));
        assert_eq!(chosen(Executor::Mpi, alone, false), None);
    }
}
