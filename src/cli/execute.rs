//! Runs a study in its output directory: code that `sweep` and `run` share.

use std::time::{Duration, Instant};

use super::cost::binary;
use super::job::{Done, Job, Retry};
use super::notices::{expect_page, tallies, tell_opened, tell_start};
use super::output::Output;
use crate::disk::names::JOURNAL;
use crate::execute::{
    Crew, Ending, Interrupt, Keeping, Progress, Session, Setup, SphRunner, Worked, coordinate,
    host_name, memory, threads,
};
use crate::film::Filming;
use crate::math::words::counted;
use crate::results::{
    Directory, Manifest, OpenMode, Opened, Program, RankInfo, Savings, SessionInfo, SweepError,
    has_checkpoints, timestamp,
};
use crate::scene::CaseConfig;
use crate::simulation::{Cost, cost};
use crate::study::{Case, CaseId, Plan};

/// Runs the missing part of a study on the threads of this process. A film shows its first case.
pub(super) fn on_threads(
    job: &Job,
    threads: Option<u16>,
    film: Option<Filming>,
    checkpoint_every_s: f64,
    output: &Output,
) -> anyhow::Result<Done> {
    if film.is_some() && has_checkpoints(&job.out) {
        output.note("a film shows a case from its start: what has a checkpoint starts over");
    }
    let keep = Keeping::new(&job.out, checkpoint_every_s).filter(|_| film.is_none());
    let film = film.map(|film| (job.study.cases[0].id, film));
    let interrupt = Interrupt::listen()?;
    let setup = Setup {
        make_runner: &|resources| {
            Box::new(SphRunner { resources, film: film.clone(), keep: keep.clone() })
        },
        threads: threads.map(usize::from),
        interrupt: &interrupt,
        patience: Duration::MAX,
    };
    Ok(threads::with_crew(&setup, |crew| execute(job, crew, &interrupt, output))?)
}

/// Runs the missing part of a study in its output directory.
pub(super) fn execute(
    job: &Job,
    crew: &mut dyn Crew,
    interrupt: &Interrupt,
    output: &Output,
) -> Result<Done, SweepError> {
    let anew = job.mode == OpenMode::Fresh || !job.out.join(JOURNAL).exists();
    if anew {
        // These checks come before anything is written or moved aside.
        share_threads(job, job.study.run_count(), crew);
        demand_memory(job.study.runs(), crew)?;
    }
    let (mut directory, opened) = open(job, crew, output)?;
    let missing = directory.runs().iter().filter(|record| record.is_none()).count();
    let tallies = tallies(&directory, job.study.cases.len());
    tell_opened(&opened, job, tallies, output);
    // A run that died before it had a manifest has done nothing.
    let began = matches!(opened, Opened::Resumed(done) if missing == 0 || done > 0);
    let damage = Manifest::damage(&job.out).filter(|_| began);
    if let Some(what) = damage {
        let rest =
            if Manifest::read(&job.out).is_none() { ", without earlier sessions" } else { "" };
        output.note(format_args!("manifest.json {what}: made again{rest}"));
    }
    if missing == 0 {
        return all_there(job, directory, damage.is_some(), interrupt);
    }
    share_threads(job, missing, crew);
    if !anew {
        let missing = job.study.runs().zip(directory.runs()).filter(|(_, run)| run.is_none());
        demand_memory(missing.map(|(case, _)| case), crew)?;
    }
    let plan = plan_of_missing(job, &directory, output);
    let start = Instant::now();
    let mut manifest = begin_session(job, crew, &directory, output)?;
    expect_page(job, interrupt, output)?;
    tell_start(crew, &directory, tallies, output);
    let ranks = crew.ranks().to_vec();
    let mut ended = None;
    crew.work(directory.simd(), &job.out, &mut |link| {
        let progress = Progress::new(output.progress_style(), tallies);
        let mut session = Session {
            study: &job.study,
            plan: &plan,
            directory: &mut directory,
            ranks: &ranks,
            interrupt,
            progress,
        };
        ended = Some(coordinate(link, &mut session)?);
        Ok(())
    })?;
    let worked = ended.unwrap_or_default();
    let (ending, savings) = (worked.ending, worked.savings);
    if ending == Ending::Finished {
        directory.clear()?;
    }
    let wall_time_s = start.elapsed().as_secs_f64();
    end_session(&mut manifest, worked, wall_time_s);
    manifest.write(&job.out)?;
    let wall_time_s = Some(wall_time_s);
    Ok(Done { directory, ending, savings, wall_time_s, film_time_s: 0.0 })
}

/// Opens the output directory, and reports what is found there.
fn open(job: &Job, crew: &dyn Crew, output: &Output) -> Result<(Directory, Opened), SweepError> {
    let (mut directory, opened) =
        Directory::open(&job.out, &job.study, job.mode, job.simd, crew.widest_simd())?;
    for finding in directory.findings() {
        output.note(finding);
    }
    let suspects = directory.attempts().suspects();
    if suspects > 0 {
        output.note(format_args!(
            "{} had begun when an earlier process died: each runs in a process of its own now",
            counted(suspects, "run")
        ));
    }
    match job.retry {
        Retry::Nothing => {}
        Retry::Cases => directory.retry_failed(false),
        Retry::All => directory.retry_failed(true),
    }
    Ok((directory, opened))
}

/// Makes the tables of a complete study. The file may now ask for other error bars than before. The
/// manifest has to hold this file, or `verify` and `report` would make other tables.
fn all_there(
    job: &Job,
    mut directory: Directory,
    damaged: bool,
    interrupt: &Interrupt,
) -> Result<Done, SweepError> {
    let manifest = Manifest::new(&job.out, &job.study, &job.overrides, directory.simd());
    if damaged {
        manifest.write(&job.out)?
    } else {
        manifest.asked_again(&job.out)?
    }
    let written = directory.write_tables(&job.study, &|| interrupt.is_raised())?;
    directory.clear()?;
    let ending = if written { Ending::Finished } else { Ending::Interrupted };
    let savings = Savings::default();
    Ok(Done { directory, ending, savings, wall_time_s: None, film_time_s: 0.0 })
}

/// The cases that are missing, and the trunks that they share.
fn plan_of_missing(job: &Job, directory: &Directory, output: &Output) -> Plan {
    let kept = directory.kept();
    if !kept.is_empty() {
        let cases = counted(kept.len(), "checkpoint");
        output.note(format_args!("{cases} of cases that had begun"));
    }
    // A case with its own saved state needs no trunk.
    let cost_left = |config: &CaseConfig| {
        let cost = cost(config);
        let alone = !kept.is_empty() && kept.contains(&CaseId::of(config));
        if alone { Cost { trunk_share: 0.0, ..cost } } else { cost }
    };
    Plan::new(&job.study, job.branching, cost_left, |index| directory.runs()[index].is_none())
}

/// The manifest with a session that begins now.
fn begin_session(
    job: &Job,
    crew: &dyn Crew,
    directory: &Directory,
    output: &Output,
) -> Result<Manifest, SweepError> {
    let mut manifest = Manifest::new(&job.out, &job.study, &job.overrides, directory.simd());
    if let Some(other) = manifest.other_program() {
        output.note(format_args!(
            "note: another build of the same physics version has worked here, {other}"
        ));
    }
    manifest.sessions.push(SessionInfo {
        program: Some(Program::this()),
        executor: crew.executor().to_owned(),
        ranks: crew.ranks().to_vec(),
        started: timestamp(),
        ..SessionInfo::default()
    });
    manifest.write(&job.out)?;
    Ok(manifest)
}

/// Writes into the manifest what is known of the last session once it has ended.
fn end_session(manifest: &mut Manifest, worked: Worked, wall_time_s: f64) {
    let Some(session) = manifest.sessions.last_mut() else { return };
    session.ended = Some(timestamp());
    session.wall_time_s = Some(wall_time_s);
    session.savings = Some(worked.savings);
    session.load = Some(worked.load).filter(|load| !load.ranks.is_empty());
    let word = if worked.ending == Ending::Finished { "finished" } else { "interrupted" };
    session.ending = Some(word.to_owned());
}

/// Lets threads that so many runs leave idle work within the runs, if the job wants that.
fn share_threads(job: &Job, runs: usize, crew: &mut dyn Crew) {
    if job.shares_threads {
        crew.share_threads(runs);
    }
}

/// Checks memory: the cases that run at once must fit into this machine, and a rank's cases into
/// its allowed address space.
fn demand_memory<'a>(
    runs: impl Iterator<Item = &'a Case>,
    crew: &dyn Crew,
) -> Result<(), SweepError> {
    let here = host_name();
    let ranks = crew.ranks().iter().filter(|rank| rank.host == here);
    let places: Vec<usize> = ranks.map(RankInfo::places).collect();
    let mut sizes: Vec<_> = runs.map(|case| cost(&case.config).memory_bytes).collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    let of_rank = places.iter().max().copied().unwrap_or(0);
    let limits = [
        (places.iter().sum(), memory::available_bytes(), format!("{here} has")),
        (of_rank, memory::address_space_left(), "the limit of this process (ulimit -v) has".into()),
    ];
    for (at_once, left, whose) in limits {
        let sizes = &sizes[..sizes.len().min(at_once)];
        let needed: u64 = sizes.iter().sum();
        if let Some(left) = left.filter(|&left| needed > left) {
            return Err(SweepError::Refused(format!(
                "{} at once may take {} of memory, and {whose} {} left: take fewer --threads, or a \
                 larger particle_spacing_m",
                counted(sizes.len(), "case"),
                binary(needed),
                binary(left)
            )));
        }
    }
    Ok(())
}
