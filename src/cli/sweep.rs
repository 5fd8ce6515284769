//! `seawall sweep`: runs all cases of a sweep file.

use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use serde_json::{Value, json};

use super::closed_study::Asked;
use super::execute::execute;
use super::executor::{Executor, choose};
use super::failure::exit_code;
use super::goal::Goal;
use super::input::{
    Expect, Setting, SimdChoice, default_out, named_out, out_of, study, sweep_file,
};
use super::job::{Done, Job, Retry};
use super::options::{EndingArgs, KeepArgs};
use super::output::{Output, json_paths};
use super::{INTERRUPTED, SUCCESS, check, films, max_error, notices, options, overview, warnings};
use crate::disk::names::{PAGE, SUMMARY};
use crate::execute::{Crew, Ending, Interrupt, Keeping, Launcher, Setup, SphRunner, mpi, threads};
use crate::keys::named;
use crate::math::words::counted;
use crate::report::ReportError;
use crate::results::{Derived, OpenMode, write_all_histories};

/// Run all cases of a sweep file, on threads or under mpirun. Go on where an earlier run stopped.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  seawall sweep sweeps/smoke.toml
  seawall sweep sweeps/nightly.toml --out results/runs/today --threads 4
  seawall sweep sweeps/liang2017.toml --set numerics.particle_spacing_m=0.016
  mpirun -n 4 --bind-to none seawall sweep sweeps/nightly.toml
  seawall sweep sweeps/nightly.toml --max-error 2 --out results/runs/within-2-percent
  seawall sweep sweeps/nightly.toml --film wave_height_ratio=0.5,spring_stiffness_n_per_m=10,seawall_mass_kg_per_m=50
  seawall sweep sweeps/nightly.toml --retry-failed")]
pub(super) struct SweepArgs {
    /// The sweep file.
    file: PathBuf,
    /// Where results go [default: results/runs/<name>].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Who does the work. `auto` takes MPI only where an MPI launcher started the process.
    #[arg(long, value_enum, default_value_t = Executor::Auto)]
    executor: Executor,
    /// Threads per rank. A thread computes one case. Where fewer cases than threads are left, threads share a case
    /// [default: the node's cores shared among its ranks].
    #[arg(long, value_name = "N", value_parser = options::threads(), allow_negative_numbers = true)]
    threads: Option<u16>,
    /// Go on with an earlier run, or start where there is none. This is the default.
    #[arg(long, conflicts_with = "fresh")]
    resume: bool,
    /// Move an earlier run aside and start over.
    #[arg(long)]
    fresh: bool,
    /// Run again the cases, and companions for error bars, that failed earlier.
    #[arg(long)]
    retry_failed: bool,
    /// Validate and show what would run; write nothing.
    #[arg(long)]
    pub(super) dry_run: bool,
    /// Run every case from rest, in place of sharing the stretch before the wall moves. The results are the
    /// same and come later: for checking.
    #[arg(long)]
    no_branch: bool,
    /// Choose particle spacing and precision case by case, so that force and displacement are expected to be
    /// within so many percent. Error bars check it. A case that misses, is doubtful or fails runs again with finer particles. What cannot
    /// be met is told at the end and in max_error.csv, and changes no exit code. In the file this is `[accuracy]
    /// max_error_percent`.
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = max_error::percent)]
    max_error: Option<f64>,
    /// Film cases once the sweep is done, into films/. `auto` takes up to four: that of the largest force,
    /// of the highest runup, of the softest wall that turns, and the most doubtful one. Cases of more than a
    /// minute are left out. `none` films nothing. A case is named by its id or by KEY=VALUE,KEY=VALUE. The
    /// option may be repeated. A film runs its case once more.
    #[arg(long, value_name = "CASE", default_value = "auto")]
    film: Vec<String>,
    /// Under MPI, name a rank that has said nothing for so many seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = options::seconds(1.0, 1e6), allow_negative_numbers = true)]
    hung_after_s: f64,
    #[command(flatten)]
    keep: KeepArgs,
    #[command(flatten)]
    ending: EndingArgs,
    /// Instruction set of the hot loops.
    #[arg(long, value_enum, default_value_t = SimdChoice::Auto)]
    simd: SimdChoice,
    /// Set a key of the file, such as numerics.boundary=improved-shepard. The option may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

impl SweepArgs {
    /// Whether a finished study only has to be reported again.
    fn only_goes_on(&self) -> bool {
        !self.fresh && !self.retry_failed && self.simd.path().is_none()
    }
}

pub(super) fn main(args: &SweepArgs, output: &Output, launcher: Launcher) -> anyhow::Result<u8> {
    if args.dry_run {
        if launcher.rank > 0 {
            return Ok(SUCCESS);
        }
        let study = study(&args.file, &args.settings, Expect::Grid)?;
        let study = max_error::chosen(args.max_error, study, output)?;
        films::check(&args.film, &study)?;
        let code = check::show(&study, !args.no_branch, output)?;
        args.ending.end(code);
        return Ok(code);
    }
    let use_mpi = choose(args.executor, launcher, mpi::AVAILABLE)?;
    let interrupt = Interrupt::listen()?;
    let setup = Setup {
        make_runner: &|resources| {
            // Every rank works out for itself where results go.
            let out = args.out.clone().or_else(|| out_of(&args.file, &args.settings));
            let keep = out.and_then(|out| Keeping::new(&out, args.keep.checkpoint_every_s));
            Box::new(SphRunner { resources, film: None, keep })
        },
        threads: args.threads.map(usize::from),
        interrupt: &interrupt,
        patience: Duration::from_secs_f64(args.hung_after_s),
    };
    let lead = |crew: &mut dyn Crew| {
        let result = lead(args, output, crew, &interrupt);
        let code = exit_code(result, Launcher { rank: 0, ..launcher }, output.is_json());
        args.ending.end(code);
        code
    };
    match use_mpi {
        true => Ok(mpi::with_crew(&setup, launcher, lead)?),
        false => Ok(threads::with_crew(&setup, lead)),
    }
}

fn lead(
    args: &SweepArgs,
    output: &Output,
    crew: &mut dyn Crew,
    interrupt: &Interrupt,
) -> anyhow::Result<u8> {
    let file = sweep_file(&args.file, &args.settings)?;
    let overrides: Vec<_> = args.settings.iter().map(|setting| setting.text.clone()).collect();
    let asked = Asked::of(&file, &overrides, &args.film).filter(|_| args.max_error.is_none());
    if let Some(asked) = asked.as_ref().filter(|_| args.only_goes_on()) {
        let out = args.out.clone().unwrap_or_else(|| named_out(&file.name));
        args.ending.begin(&out)?;
        if let Some(code) = asked.tell(&out, &out.join(PAGE), output)? {
            return Ok(code);
        }
    }
    let study = study(&args.file, &args.settings, Expect::Grid)?;
    let goal = Goal::of(args.max_error, &file, &study)?;
    let out = args.out.clone().unwrap_or_else(|| default_out(&study));
    let first = goal.first((&file, study), (&out, args.fresh), output);
    let places = films::check(&args.film, &first)?;
    let places = if goal.chooses_numerics() { places } else { Default::default() };
    warnings::tell(&args.file, &first, output);
    warnings::tell_threads(args.threads, output);
    let job = Job {
        retry: if args.retry_failed { Retry::All } else { Retry::Nothing },
        branching: !args.no_branch,
        simd: args.simd.path(),
        overrides,
        reports: true,
        ..Job::of(first, out.clone(), args.fresh)
    };
    args.ending.begin(&job.out)?;
    let (job, mut done) = in_rounds(&args.file, &goal, job, crew, interrupt, output)?;
    let path = done.directory.path();
    let making = (done.ending == Ending::Finished)
        .then(|| notices::hold_making_unless(path, interrupt, output));
    let Some(_making) = making.flatten() else {
        notices::tell_interrupted(&job, &done, crew, output);
        return done.interrupted(&job, output);
    };
    Derived::owe(done.directory.path())?;
    let (filming, film_time_s) =
        films::make(&args.film, &places, &job.study, &done, args.threads, interrupt, output)?;
    done.film_time_s = film_time_s;
    done.directory.demand_in_place()?;
    write_all_histories(done.directory.path())?;
    let (text, value) = told_at_end(&goal, &job, &done, output)?;
    let code = done.exit_code().max(filming);
    let closing = asked.filter(|_| filming == SUCCESS);
    let closing = closing.and_then(|asked| asked.closing(&job, &mut done));
    // The report reads files alone. Of a large study both would be too much.
    let left = done.directory.left();
    done.directory.forget_records();
    drop(job);
    // A fault in files that have just been written is not bad input.
    let written = crate::report::write(done.directory.path()).map_err(|error| match error {
        ReportError::Write { .. } => error.into(),
        _ => anyhow::anyhow!("{error}"),
    })?;
    Derived::end(done.directory.path(), &written.made, filming != INTERRUPTED)?;
    left.demand(done.directory.path())?;
    if let Some(closing) = closing {
        closing.write(done.directory.path())?;
    }
    output.result(&text, &value)?;
    if code == INTERRUPTED {
        notices::tell_true_code(&out, crew, output);
    }
    Ok(code)
}

/// Runs a job, and then round by round what its goal asks for.
fn in_rounds(
    file: &Path,
    goal: &Goal,
    mut job: Job,
    crew: &mut dyn Crew,
    interrupt: &Interrupt,
    output: &Output,
) -> anyhow::Result<(Job, Done)> {
    let mut done = execute(&job, crew, interrupt, output)?;
    while done.ending == Ending::Finished {
        let Some(next) = goal.next(file, &job.study, &done, output)? else { break };
        let spent_s = done.wall_time_s;
        drop(done); // its lock
        job = Job { study: next, mode: OpenMode::Resume, retry: Retry::Nothing, ..job };
        done = execute(&job, crew, interrupt, output)?;
        done.wall_time_s = spent_s.into_iter().chain(done.wall_time_s).reduce(|sum, s| sum + s);
    }
    Ok((job, done))
}

/// The final words of a sweep, for people and programs.
fn told_at_end(
    goal: &Goal,
    job: &Job,
    done: &Done,
    output: &Output,
) -> anyhow::Result<(String, Value)> {
    let report = done.directory.path().join(PAGE);
    let mut text = overview::text(job, done, &report, output.verbose);
    let mut value = if output.is_json() { done.json(job, Some(&report))? } else { json!({}) };
    value["films"] = json!(json_paths(&films::pages(done.directory.path())));
    goal.report(&job.study, done, (&mut text, &mut value))?;
    if let failed @ 1.. = done.failed() {
        let why = named(&done.directory.path().join(SUMMARY));
        output.failure(format_args!("{} failed, see {why}", counted(failed, "case")));
    }
    Ok((text, value))
}
