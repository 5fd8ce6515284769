//! The loop that connects manager, link and journal. It runs on one thread, on rank 0.

use std::time::{Duration, Instant};

use super::gauge::Way;
use super::load::Loads;
use super::message::Reached;
use super::reckoning::Reckoning;
use super::session::{Ending, Session, Worked};
use super::{Link, Order, Posted, Report};
use crate::results::{CaseRecord, Delivery, RankInfo, Savings, SweepError, forget_load};
use crate::schedule::{Command, Event, Manager, Work};
use crate::simulation::{CaseResult, Failure, FailureKind, Stopped};

/// How long to wait for a report before checking signals and the journal.
const PATIENCE: Duration = Duration::from_millis(50);

/// Runs a plan to its end, or until interrupted. Everything finished is recorded and on the disk
/// when this returns.
pub fn coordinate(link: &mut dyn Link, session: &mut Session<'_>) -> Result<Worked, SweepError> {
    let capacities: Vec<_> = session.ranks.iter().map(RankInfo::places).collect();
    let mut loop_ = Loop {
        manager: Manager::new(session.plan, &capacities),
        commands: Vec::new(),
        trunk_of_case: vec![None; session.plan.cases.len()],
        trunk_steps: vec![0; session.plan.trunks.len()],
        savings: Savings::default(),
        loads: Loads::new(session.ranks),
        reckoning: Reckoning::new(session.plan),
    };
    for rank in 0..capacities.len() {
        loop_.tell(Event::Ready { rank }, link, session)?;
    }
    // This visits all ranks, which would take too long at every report of thousands.
    let mut looked = Instant::now();
    let mut told = false;
    while !loop_.manager.finished() {
        match link.poll(PATIENCE)? {
            Some((rank, report)) => loop_.take(rank, report, link, session)?,
            None => session.directory.sync(true)?,
        }
        if looked.elapsed() >= PATIENCE {
            looked = Instant::now();
            loop_.reckoning.look(link.under_way());
            session.progress.reached(loop_.reckoning.done_and_left());
        }
        session.directory.sync(false)?;
        loop_.loads.tell(session.directory.path());
        if session.interrupt.is_raised() && !told {
            told = true;
            loop_.tell(Event::Interrupted, link, session)?;
        }
    }
    session.directory.sync(true)?;
    session.directory.attempts().close()?;
    let interrupt = session.interrupt;
    let written = session.directory.write_tables(session.study, &|| interrupt.is_raised())?;
    let finished = written && loop_.manager.unfinished() == 0;
    let ending = if finished { Ending::Finished } else { Ending::Interrupted };
    forget_load(session.directory.path())?;
    Ok(Worked { ending, savings: loop_.savings, load: loop_.loads.so_far() })
}

struct Loop<'a> {
    manager: Manager,
    commands: Vec<Command>,
    /// The trunk that each running case started from.
    trunk_of_case: Vec<Option<usize>>,
    trunk_steps: Vec<u64>,
    savings: Savings,
    loads: Loads,
    reckoning: Reckoning<'a>,
}

impl Loop<'_> {
    fn tell(
        &mut self,
        event: Event,
        link: &mut dyn Link,
        session: &mut Session<'_>,
    ) -> Result<(), SweepError> {
        self.manager.on(event, &mut self.commands);
        let ended = match event {
            Event::Done { work, .. } | Event::GivenBack { work, .. } => Some(session.id(work)),
            Event::Ready { .. } | Event::Interrupted => None,
        };
        let begun = self.commands.iter().filter_map(|command| match *command {
            Command::Run { work, .. } => Some(session.id(work)),
            Command::Drop { .. } | Command::Cancel => None,
        });
        let begun: Vec<_> = begun.collect();
        session.directory.attempts().turn(ended, &begun)?;
        for command in self.commands.drain(..) {
            match command {
                Command::Run { rank, work, from } => {
                    let config = match work {
                        Work::Trunk(trunk) => &session.plan.trunks[trunk].config,
                        Work::Case(case) => {
                            self.trunk_of_case[case] = from.map(|held| held.trunk);
                            &session.study.run(session.plan.cases[case].index).config
                        }
                    };
                    let config = Posted::from(config);
                    let id = session.id(work);
                    let apart = session.directory.attempts().is_suspect(id);
                    let limits = session.study.limits;
                    let cases = session.study.cases.len();
                    let is_case = |case: usize| session.plan.cases[case].index < cases;
                    let files = match work {
                        Work::Case(case) if is_case(case) => Some(id),
                        _ => None,
                    };
                    let order = Order::Run { work, config, from, apart, limits, files };
                    link.send(rank, order);
                    self.loads.begin(rank, work);
                }
                Command::Drop { rank, trunk } => link.send(rank, Order::Drop { trunk }),
                Command::Cancel => {
                    for rank in 0..session.ranks.len() {
                        link.send(rank, Order::Cancel);
                    }
                }
            }
        }
        Ok(())
    }

    fn take(
        &mut self,
        rank: usize,
        report: Report,
        link: &mut dyn Link,
        session: &mut Session<'_>,
    ) -> Result<(), SweepError> {
        let event = match report {
            Report::TrunkDone { trunk, result: Err(Stopped::Interrupted), .. } => {
                Event::GivenBack { rank, work: Work::Trunk(trunk) }
            }
            Report::TrunkDone { trunk, result, wall_time_s } => {
                self.loads.end(rank, Work::Trunk(trunk), wall_time_s);
                let mut share = None;
                if let Ok(Reached { steps, time_s }) = result {
                    share = Some(Way::of(&session.plan.trunks[trunk].config).share(time_s));
                    self.savings.trunks += 1;
                    self.savings.steps_computed += steps;
                    self.trunk_steps[trunk] = steps;
                }
                if let Err(Stopped::Failed(Failure {
                    kind: FailureKind::EndedTheProcess, ..
                })) = result
                {
                    session.suspect_branches(trunk);
                }
                self.reckoning.trunk(trunk, share);
                session.progress.reached(self.reckoning.done_and_left());
                Event::Done { rank, work: Work::Trunk(trunk), ok: result.is_ok() }
            }
            Report::CaseDone { case, result, wall_time_s, cpu_time_s } => {
                let result = match result {
                    Ok(delivery) => Ok(delivery),
                    Err(Stopped::Failed(failure)) => Err(failure),
                    Err(Stopped::Interrupted) => {
                        let event = Event::GivenBack { rank, work: Work::Case(case) };
                        return self.tell(event, link, session);
                    }
                };
                self.loads.end(rank, Work::Case(case), wall_time_s);
                let ok = self.record(rank, case, result, (wall_time_s, cpu_time_s), session)?;
                Event::Done { rank, work: Work::Case(case), ok }
            }
            Report::Interrupted => Event::Interrupted,
        };
        self.tell(event, link, session)
    }

    fn record(
        &mut self,
        rank: usize,
        case: usize,
        result: Result<Delivery, Failure>,
        (wall_time_s, cpu_time_s): (f64, Option<f64>),
        session: &mut Session<'_>,
    ) -> Result<bool, SweepError> {
        let planned = session.plan.cases[case];
        let trunk = self.trunk_of_case[case];
        if let Ok(delivery) = &result {
            let steps = delivery.outcome().steps;
            let shared = trunk.map_or(0, |trunk| self.trunk_steps[trunk]);
            self.savings.branches += usize::from(trunk.is_some());
            self.savings.steps_computed += steps.saturating_sub(shared);
            self.savings.steps_from_rest += steps;
        }
        let host = &session.ranks[rank].host;
        let whole = session.study.run(planned.index);
        let (study, directory) = (session.study, &mut *session.directory);
        let timed = |record| CaseRecord { cpu_time_s, ..record };
        let mut record_whole = |result: Result<CaseResult, Failure>| {
            let record = timed(CaseRecord::new(study, whole, &result, wall_time_s, host));
            let ok = record.is_ok();
            directory.record(record, result.as_ref().ok()).map(|()| ok)
        };
        let ok = match result {
            Ok(Delivery::Whole(result)) => record_whole(Ok(*result))?,
            Err(failure) => record_whole(Err(failure))?,
            Ok(Delivery::Filed(filed)) => {
                let record = CaseRecord::of_filed(study, whole, &filed, wall_time_s, host);
                directory.record_filed(timed(record), &filed)?;
                true
            }
        };
        if planned.index < session.study.cases.len() {
            session.progress.case(ok);
        } else {
            session.progress.companion();
        }
        self.reckoning.case(case);
        session.progress.reached(self.reckoning.done_and_left());
        Ok(ok)
    }
}
