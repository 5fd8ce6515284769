//! Messages on opening and starting a study.

use std::path::Path;

use super::INTERRUPTED;
use super::job::{Done, Job};
use super::output::Output;
use crate::execute::{Crew, Interrupt, Tally};
use crate::keys::named;
use crate::math::name::name_of;
use crate::math::words::counted;
use crate::results::{Derived, Directory, Making, Opened, RankInfo, SweepError};

/// Waits for other processes that make page, figures, tables or films of a directory.
pub(super) fn hold_making(directory: &Path, output: &Output) -> Making {
    Making::hold(directory, || tell_waiting(directory, output))
}

/// The same; `None` where it is told to stop meanwhile.
pub(super) fn hold_making_unless(
    directory: &Path,
    interrupt: &Interrupt,
    output: &Output,
) -> Option<Making> {
    Making::hold_unless(directory, || tell_waiting(directory, output), &|| interrupt.is_raised())
}

/// Notes that a sweep has begun and owes films and page. Who is killed between its last case and its page
/// has then left something to do.
pub(super) fn expect_page(
    job: &Job,
    interrupt: &Interrupt,
    output: &Output,
) -> Result<(), SweepError> {
    if job.reports
        && let Some(_making) = hold_making_unless(&job.out, interrupt, output)
    {
        Derived::expect(&job.out)?;
    }
    Ok(())
}

fn tell_waiting(directory: &Path, output: &Output) {
    let out = named(directory);
    output.note(format_args!("{out}: waiting for another process that makes page or films"));
}

/// How many cases and companions there are, and how many of them are done.
pub(super) fn tallies(directory: &Directory, cases: usize) -> [Tally; 2] {
    let (cases, companions) = directory.runs().split_at(cases);
    [cases, companions].map(|runs| Tally {
        all: runs.len(),
        done: runs.iter().filter(|record| record.is_some()).count(),
    })
}

/// Cases, and companions where there are any: `8 cases and 8 companions for error bars`.
fn in_words(cases: usize, companions: usize) -> String {
    let cases = counted(cases, "case");
    match companions {
        0 => cases,
        companions => format!("{cases} and {} for error bars", counted(companions, "companion")),
    }
}

/// Reports what was found on opening.
pub(super) fn tell_opened(
    opened: &Opened,
    job: &Job,
    [cases, companions]: [Tally; 2],
    output: &Output,
) {
    let out = named(&job.out);
    let all_done = cases.done == cases.all && companions.done == companions.all;
    match opened {
        Opened::New => {}
        Opened::Moved(aside) => output.note(format_args!("moved {out} to {}", named(aside))),
        Opened::Resumed(_) if all_done => {
            output.note(format_args!("{out} is finished; --fresh would run it again"));
        }
        Opened::Resumed(_) => {
            let all = in_words(cases.all, companions.all);
            let done = match companions.all {
                0 => cases.done.to_string(),
                _ => format!("{} and {}", cases.done, companions.done),
            };
            output.note(format_args!("resuming {out}: {done} of {all} done"));
        }
    }
}

/// Reports what runs now, and on what.
pub(super) fn tell_start(
    crew: &dyn Crew,
    directory: &Directory,
    [cases, companions]: [Tally; 2],
    output: &Output,
) {
    let ranks = crew.ranks();
    let places: usize = ranks.iter().map(RankInfo::places).sum();
    let threads: usize = ranks.iter().map(|rank| rank.threads).sum();
    let within = ranks.iter().map(|rank| rank.threads_per_case).max().unwrap_or(1);
    let within =
        if within > 1 { format!(", up to {within} threads on one case") } else { String::new() };
    let who = match crew.executor() {
        "mpi" => {
            let [ranks, places] = [(ranks.len(), "MPI rank"), (places, "case")]
                .map(|(number, noun)| counted(number, noun));
            format!("{ranks}, {places} at once{within}")
        }
        _ => format!("{}{within}", counted(threads, "thread")),
    };
    output.note(format_args!(
        "{} on {who}, {}, into {}",
        in_words(cases.all - cases.done, companions.all - companions.done),
        name_of(directory.simd()),
        named(directory.path())
    ));
    if output.verbose {
        for (rank, info) in ranks.iter().enumerate() {
            let threads = counted(info.threads, "thread");
            output.note(format_args!("rank {rank}: {}, {threads}", info.host));
        }
    }
}

/// The last words of a sweep that was told to stop.
pub(super) fn tell_interrupted(job: &Job, done: &Done, crew: &dyn Crew, output: &Output) {
    let (finished, cases) = (done.records().count(), counted(job.study.cases.len(), "case"));
    output.note(format_args!("interrupted: {finished} of {cases} done; the same command goes on"));
    tell_true_code(done.directory.path(), crew, output);
}

/// The exit code of a sweep that was told to stop, where a launcher may lose it.
pub(super) fn tell_true_code(directory: &Path, crew: &dyn Crew, output: &Output) {
    if crew.executor() == "mpi" {
        output.note(format_args!(
            "the journal is whole. A launcher that was told to end may return 0 or 1; seawall's own code is \
             {INTERRUPTED}, as `seawall status {} --exit-code` tells",
            named(directory)
        ));
    }
}
