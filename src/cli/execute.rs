//! Running a study in its output directory: what `sweep` and `run` have in common.

use std::time::{Duration, Instant};

use super::cost::binary;
use super::job::{Done, Job};
use super::notices::{tallies, tell_opened, tell_start};
use super::output::Output;
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

/// Runs what of a study is missing on the threads of this process; a film is one of its first case.
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

/// Runs what of a study is missing in its output directory.
pub(super) fn execute(
    job: &Job,
    crew: &mut dyn Crew,
    interrupt: &Interrupt,
    output: &Output,
) -> Result<Done, SweepError> {
    let study = &job.study;
    let anew = job.mode == OpenMode::Fresh || !job.out.join("journal.jsonl").exists();
    if anew {
        // Before anything is written or moved aside.
        if job.shares_threads {
            crew.share_threads(study.run_count());
        }
        demand_memory(study.runs(), crew)?;
    }
    let (mut directory, opened) =
        Directory::open(&job.out, study, job.mode, job.simd, crew.widest_simd())?;
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
    if job.retry_failed {
        directory.retry_failed();
    }
    let missing = directory.runs().iter().filter(|record| record.is_none()).count();
    let tallies = tallies(&directory, study.cases.len());
    tell_opened(&opened, job, tallies, output);
    // One who died before it had a manifest has done nothing.
    let began = matches!(opened, Opened::Resumed(done) if missing == 0 || done > 0);
    let damage = Manifest::damage(&job.out).filter(|_| began);
    if let Some(what) = damage {
        let rest =
            if Manifest::read(&job.out).is_none() { ", without earlier sessions" } else { "" };
        output.note(format_args!("manifest.json {what}: made again{rest}"));
    }
    if missing == 0 {
        // Tables follow the file, which may ask for other error bars than before. The manifest has to tell the same
        // file, or `verify` and `report` would make other tables.
        let manifest = Manifest::new(&job.out, study, &job.overrides, directory.simd());
        match damage {
            Some(_) => manifest.write(&job.out)?,
            None => manifest.asked_again(&job.out)?,
        }
        directory.write_tables(study)?;
        directory.clear_checkpoints()?;
        let (savings, ending) = (Savings::default(), Ending::Finished);
        return Ok(Done { directory, ending, savings, wall_time_s: None, film_time_s: 0.0 });
    }
    if job.shares_threads {
        crew.share_threads(missing);
    }
    if !anew {
        let missing = study.runs().zip(directory.runs()).filter(|(_, record)| record.is_none());
        demand_memory(missing.map(|(case, _)| case), crew)?;
    }
    let kept = directory.kept();
    if !kept.is_empty() {
        let cases = counted(kept.len(), "checkpoint");
        output.note(format_args!("{cases} of cases that had begun"));
    }
    // A case with a state of its own needs no shared stretch.
    let cost_left = |config: &CaseConfig| {
        let cost = cost(config);
        let alone = !kept.is_empty() && kept.contains(&CaseId::of(config));
        if alone { Cost { trunk_share: 0.0, ..cost } } else { cost }
    };
    let wanted = |index: usize| directory.runs()[index].is_none();
    let plan = Plan::new(study, job.branching, cost_left, wanted);
    let start = Instant::now();
    let mut manifest = Manifest::new(&job.out, study, &job.overrides, directory.simd());
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
    tell_start(crew, &directory, tallies, output);
    let ranks = crew.ranks().to_vec();
    let simd = directory.simd();
    let mut ended = None;
    crew.work(simd, &job.out, &mut |link| {
        let progress = Progress::new(output.progress_style(), tallies);
        let mut session = Session {
            study,
            plan: &plan,
            directory: &mut directory,
            ranks: &ranks,
            interrupt,
            progress,
        };
        ended = Some(coordinate(link, &mut session)?);
        Ok(())
    })?;
    let Worked { ending, savings, load } = ended.unwrap_or_default();
    if ending == Ending::Finished {
        directory.clear_checkpoints()?;
    }
    let wall_time_s = Some(start.elapsed().as_secs_f64());
    if let Some(session) = manifest.sessions.last_mut() {
        session.ended = Some(timestamp());
        session.wall_time_s = wall_time_s;
        session.savings = Some(savings);
        session.load = Some(load).filter(|load| !load.ranks.is_empty());
        let word = if ending == Ending::Finished { "finished" } else { "interrupted" };
        session.ending = Some(word.to_owned());
    }
    manifest.write(&job.out)?;
    Ok(Done { directory, ending, savings, wall_time_s, film_time_s: 0.0 })
}

/// Makes sure that as many cases as run at once on this machine fit into it, and those of a rank into the address
/// space that it may take.
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
