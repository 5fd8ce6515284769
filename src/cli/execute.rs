//! Running a study in its output directory: what `sweep` and `run` have in common.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::cost::binary;
use super::output::Output;
use super::shown;
use super::{CASES_FAILED, INTERRUPTED, SUCCESS};
use crate::execute::{
    Crew, Ending, Interrupt, Keeping, Progress, Session, Setup, SphRunner, Tally, Worked,
    coordinate, host_name, memory, threads,
};
use crate::film::Filming;
use crate::math::simd::SimdPath;
use crate::quantities::summary::COARSE_SPACING;
use crate::quantities::{Bars, Value as Cell};
use crate::results::{
    CaseRecord, Directory, Load, Manifest, OpenMode, Opened, Program, RankInfo, Savings,
    SessionInfo, SweepError, counted, finished_whole, has_checkpoints, timestamp,
};
use crate::scene::CaseConfig;
use crate::simulation::{Cost, cost};
use crate::study::{CaseId, Plan, Study};

pub(super) struct Job {
    pub(super) study: Study,
    pub(super) out: PathBuf,
    pub(super) mode: OpenMode,
    pub(super) retry_failed: bool,
    pub(super) branching: bool,
    /// Whether threads that the runs would leave idle work within them.
    pub(super) shares_threads: bool,
    pub(super) simd: Option<SimdPath>,
    pub(super) overrides: Vec<String>,
}

pub(super) struct Done {
    pub(super) directory: Directory,
    pub(super) ending: Ending,
    pub(super) savings: Savings,
    /// `None` where everything was there before.
    pub(super) wall_time_s: Option<f64>,
}

impl Done {
    /// The finished cases, in grid order.
    pub(super) fn records(&self) -> impl Iterator<Item = &CaseRecord> {
        self.directory.records().iter().flatten()
    }

    /// Finished cases of which something touches a quoted number.
    pub(super) fn doubtful(&self) -> usize {
        self.doubts().count()
    }

    /// What touches a quoted number, of every finished case of which something does.
    pub(super) fn doubts(&self) -> impl Iterator<Item = &str> {
        let outcomes = self.records().filter_map(|record| record.outcome.as_ref());
        outcomes.filter_map(|outcome| outcome.doubtful_reason.as_deref())
    }

    /// What to expect of every finished case whose particles are coarse.
    pub(super) fn coarse(&self, job: &Job) -> Vec<String> {
        let told = |record: &CaseRecord| {
            let config = &job.study.cases[record.index].config;
            let case =
                record.outcome.is_some().then(|| record.reported(config, Bars::default()))?;
            match COARSE_SPACING.value(&case)? {
                Cell::Text(why) => Some(why),
                _ => None,
            }
        };
        self.records().filter_map(told).collect()
    }

    pub(super) fn failed(&self) -> usize {
        self.records().filter(|record| !record.is_ok()).count()
    }

    pub(super) fn exit_code(&self) -> u8 {
        match self.ending {
            Ending::Interrupted => INTERRUPTED,
            Ending::Finished if self.failed() > 0 => CASES_FAILED,
            Ending::Finished => SUCCESS,
        }
    }

    /// The finished cases with all that the journal has of them, in grid order.
    pub(super) fn whole(&self, study: &Study) -> Result<Vec<CaseRecord>, SweepError> {
        let whole = finished_whole(self.directory.path(), study)?.into_iter();
        let whole = whole.zip(self.directory.records());
        Ok(whole.filter_map(|(record, here)| record.filter(|_| here.is_some())).collect())
    }

    pub(super) fn json(&self, job: &Job, report: Option<&Path>) -> Result<Value, SweepError> {
        Ok(json!({
            "name": job.study.name,
            "out": shown::path(self.directory.path()),
            "report": report.map(shown::path),
            "cases": job.study.cases.len(),
            "ok": self.records().count() - self.failed(),
            "failed": self.failed(),
            "doubtful": self.doubtful(),
            "coarse": self.coarse(job).len(),
            "wall_time_s": self.wall_time_s,
            "savings": self.savings,
            "records": self.whole(&job.study)?,
        }))
    }
}

/// Runs what of a study is missing on the threads of this process.
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
    let tallies = tallies(&directory);
    tell_opened(&opened, job, tallies, output);
    if missing == 0 {
        directory.write_tables(study)?;
        directory.clear_checkpoints()?;
        if Manifest::read(&job.out).is_none() {
            output
                .note("manifest.json is missing or damaged: made again, without earlier sessions");
            Manifest::new(&job.out, study, &job.overrides, directory.simd()).write(&job.out)?;
        }
        let savings = Savings::default();
        return Ok(Done { directory, ending: Ending::Finished, savings, wall_time_s: None });
    }
    if job.shares_threads {
        crew.share_threads(missing);
    }
    demand_memory(study, &directory, crew)?;
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
        let progress = Progress::new(output.progress_style(), tallies, plan.total_cost());
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
    let Worked { ending, savings, load } = ended.unwrap_or(Worked {
        ending: Ending::Interrupted,
        savings: Savings::default(),
        load: Load::default(),
    });
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
    Ok(Done { directory, ending, savings, wall_time_s })
}

/// Makes sure that as many cases as run at once on this machine fit into it.
fn demand_memory(study: &Study, directory: &Directory, crew: &dyn Crew) -> Result<(), SweepError> {
    let here = host_name();
    let ranks = crew.ranks().iter().filter(|rank| rank.host == here);
    let places: usize = ranks.map(RankInfo::places).sum();
    let missing = study.runs().zip(directory.runs()).filter(|(_, record)| record.is_none());
    let mut sizes: Vec<_> = missing.map(|(case, _)| cost(&case.config).memory_bytes).collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes.truncate(places);
    let needed: u64 = sizes.iter().sum();
    match memory::available_bytes() {
        Some(left) if needed > left => Err(SweepError::Refused(format!(
            "{} at once may take {} of memory, and {here} has {} left: take fewer --threads, or a \
             larger particle_spacing_m",
            counted(sizes.len(), "case"),
            binary(needed),
            binary(left)
        ))),
        _ => Ok(()),
    }
}

/// Cases and companions, and how many of them are done.
fn tallies(directory: &Directory) -> [Tally; 2] {
    let (cases, companions) = directory.runs().split_at(directory.records().len());
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

fn tell_opened(opened: &Opened, job: &Job, [cases, companions]: [Tally; 2], output: &Output) {
    let out = job.out.display();
    let all_done = cases.done == cases.all && companions.done == companions.all;
    match opened {
        Opened::New => {}
        Opened::Moved(aside) => output.note(format_args!("moved {out} to {}", aside.display())),
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

fn tell_start(
    crew: &dyn Crew,
    directory: &Directory,
    [cases, companions]: [Tally; 2],
    output: &Output,
) {
    let ranks = crew.ranks();
    let places: usize = ranks.iter().map(RankInfo::places).sum();
    let threads: usize = ranks.iter().map(|rank| rank.threads).sum();
    let within = ranks.iter().map(|rank| rank.threads_per_case).max().unwrap_or(1);
    let within = if within > 1 { format!(", up to {within} in a case") } else { String::new() };
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
        crate::math::name::name_of(directory.simd()),
        directory.path().display()
    ));
    if output.verbose {
        for (rank, info) in ranks.iter().enumerate() {
            let threads = counted(info.threads, "thread");
            output.note(format_args!("rank {rank}: {}, {threads}", info.host));
        }
    }
}
