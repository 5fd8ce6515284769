//! A rank at work: it takes orders, and passes reports and checkpoints on.

use std::collections::{HashMap, VecDeque};
use std::time::{Duration, Instant};

use super::post::{Post, out_of_turn};
use super::{Message, Start};
use crate::execute::worker::Worker;
use crate::execute::{Link, Order, Report, Setup};
use crate::results::SweepError;
use crate::schedule::{Held, Work};

/// A rank at work: its messages and its worker.
pub(super) struct Station<'a, 'run, 'scope> {
    pub(super) post: &'a mut Post,
    pub(super) worker: &'a mut Worker<'run, 'scope>,
}

impl Station<'_, '_, '_> {
    fn obey(&mut self, order: Order) {
        if let Some(Held { trunk, holder }) = self.worker.take(order) {
            self.post.send(holder, &Message::Pull { trunk });
        }
    }

    /// Handles a message that all ranks understand. Returns others.
    fn handle(&mut self, from: usize, message: Message) -> Option<Message> {
        match message {
            Message::Pull { trunk } => {
                let bytes = self.worker.checkpoint(trunk).map(|bytes| bytes.to_vec());
                self.post.send_checkpoint(from, trunk, bytes);
                None
            }
            Message::Checkpoint { trunk, bytes } => {
                self.worker.arrive(trunk, bytes);
                None
            }
            other => Some(other),
        }
    }
}

/// Rank 0 at work, to which the others report.
pub(super) struct RankZero<'a, 'run, 'scope> {
    pub(super) station: Station<'a, 'run, 'scope>,
    /// Reports of others that were not taken yet.
    pub(super) reports: VecDeque<(usize, Report)>,
    /// The present work of the others, as last reported.
    pub(super) elsewhere: HashMap<usize, Vec<(Work, f64)>>,
}

impl RankZero<'_, '_, '_> {
    /// Reports have come from another rank. Work that has ended is no longer its present work.
    fn note(&mut self, rank: usize, reports: Vec<Report>) {
        if let Some(pieces) = self.elsewhere.get_mut(&rank) {
            let ended: Vec<_> = reports.iter().filter_map(Report::work).collect();
            pieces.retain(|(work, _)| !ended.contains(work));
        }
        self.reports.extend(reports.into_iter().map(|report| (rank, report)));
    }
}

impl Link for RankZero<'_, '_, '_> {
    fn send(&mut self, rank: usize, order: Order) {
        match rank {
            0 => self.station.obey(order),
            _ => self.station.post.send(rank, &Message::Order(order)),
        }
    }

    fn poll(&mut self, patience: Duration) -> Result<Option<(usize, Report)>, SweepError> {
        let start = Instant::now();
        let mut nap = Duration::ZERO;
        loop {
            if let Some(report) = self.reports.pop_front() {
                return Ok(Some(report));
            }
            if let Some(report) = self.station.worker.poll(nap) {
                return Ok(Some((0, report)));
            }
            let mut heard = false;
            while let Some((rank, message)) = self.station.post.receive()? {
                heard = true;
                match self.station.handle(rank, message) {
                    None => {}
                    Some(Message::Reports(reports)) => self.note(rank, reports),
                    Some(Message::UnderWay(pieces)) => {
                        self.elsewhere.insert(rank, pieces);
                    }
                    Some(other) => return Err(out_of_turn(rank, &other)),
                }
            }
            nap = if heard { Duration::ZERO } else { self.station.post.nap() };
            if start.elapsed() >= patience {
                return Ok(None);
            }
        }
    }

    fn under_way(&self) -> Vec<(Work, f64)> {
        let elsewhere = self.elsewhere.values().flatten().copied();
        self.station.worker.under_way().into_iter().chain(elsewhere).collect()
    }
}

/// A rank reports its progress at this interval.
const SAID_EVERY: Duration = Duration::from_secs(1);
/// But all ranks together send at most this many in a second.
const SAID_A_SECOND: u32 = 200;

/// Largest number of reports in one message.
const MANY: usize = 100;

/// The work of any rank but 0, until it must finish or start again. Returns the new start.
pub(super) fn work(
    setup: &Setup<'_>,
    mut station: Station<'_, '_, '_>,
) -> Result<Option<Start>, SweepError> {
    let mut told = false;
    let mut nap = Duration::ZERO;
    let every = SAID_EVERY.max(Duration::from_secs(station.post.size() as u64) / SAID_A_SECOND);
    let mut said = Instant::now();
    station.post.expect_rank_zero(true);
    loop {
        let first = station.worker.poll(nap);
        let more = std::iter::from_fn(|| station.worker.poll(Duration::ZERO)).take(MANY);
        let reports: Vec<_> = first.into_iter().chain(more).collect();
        if !reports.is_empty() {
            station.post.send(0, &Message::Reports(reports));
        }
        if setup.interrupt.is_raised() && !told {
            told = true;
            station.post.send(0, &Message::Reports(vec![Report::Interrupted]));
        }
        if said.elapsed() >= every && station.post.is_delivered() {
            said = Instant::now();
            station.post.send(0, &Message::UnderWay(station.worker.under_way()));
        }
        let mut heard = false;
        while let Some((rank, message)) = station.post.receive()? {
            heard = true;
            match station.handle(rank, message) {
                None => {}
                Some(Message::Order(order)) => station.obey(order),
                Some(Message::Rest) => station.post.expect_rank_zero(false),
                Some(Message::Start(start)) => return Ok(Some(start)),
                Some(Message::Finish) => return Ok(None),
                Some(other) => return Err(out_of_turn(rank, &other)),
            }
        }
        nap = if heard { Duration::ZERO } else { station.post.nap() };
    }
}
