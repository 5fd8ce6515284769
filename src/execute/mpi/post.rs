//! Messages between ranks, sent and received without waiting.

use std::io::Write;
use std::time::{Duration, Instant};

use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Source};

use super::Message;
use super::letter::Letter;
use super::pulse::{News, Pulse};
use crate::results::SweepError;

/// Raised with every change of the messages. It is at the start of every message.
const PROTOCOL: u16 = 6;
/// MPI counts bytes in a C int. A larger checkpoint is not sent, and the case that needs it runs
/// from rest.
const LARGEST: usize = 1 << 30;

/// Time between looks just after a message has moved.
const SHORT_NAP: Duration = Duration::from_micros(50);
/// Longest time between looks while a large message is in transit. MPI moves it in pieces, some at
/// every look of both sides.
const LARGE_NAP: Duration = Duration::from_micros(200);
const LARGE: usize = 100_000;
/// Longest time between looks while another message is in transit. Its receiver may be busy.
const LETTER_NAP: Duration = Duration::from_millis(1);
/// Longest time between looks otherwise. Every look takes 30 microseconds from the case on this
/// core.
const LONG_NAP: Duration = Duration::from_millis(20);
/// The time between looks is the silence so far over this. So a wait is at most half longer.
const NAP_OF_SILENCE: u32 = 2;

pub(super) struct Post {
    world: SimpleCommunicator,
    outgoing: Vec<Letter>,
    /// The message that is arriving from a rank. No other is received before it, so that messages
    /// stay in order.
    incoming: Option<(usize, Letter)>,
    /// When something was last sent, or was seen to arrive or to leave.
    moved: Instant,
    pulse: Pulse,
    /// The machine of each rank, once known.
    hosts: Vec<String>,
    /// Whether rank 0 should be listening now. It does not while it opens files and draws.
    expects_rank_zero: bool,
    /// Whether this rank sends no more signs of life.
    hushed: bool,
}

impl Post {
    /// The messages of this rank. A rank that is silent for longer than `patience` is reported.
    pub(super) fn new(world: SimpleCommunicator, patience: Duration) -> Post {
        let now = Instant::now();
        let pulse = Pulse::new(world.size() as usize, patience, now);
        let (outgoing, hosts) = (Vec::new(), Vec::new());
        let (expects_rank_zero, hushed, incoming) = (false, false, None);
        Post { world, outgoing, incoming, moved: now, pulse, hosts, expects_rank_zero, hushed }
    }

    /// Sets the machine of each rank.
    pub(super) fn introduce(&mut self, hosts: Vec<String>) {
        self.hosts = hosts;
    }

    /// Whether silence of rank 0 is reported from now on.
    pub(super) fn expect_rank_zero(&mut self, expected: bool) {
        self.expects_rank_zero = expected;
    }

    pub(super) fn rank(&self) -> usize {
        self.world.rank() as usize
    }

    pub(super) fn size(&self) -> usize {
        self.world.size() as usize
    }

    /// Sends without waiting: two ranks that send to each other cannot block each other.
    pub(super) fn send(&mut self, to: usize, message: &Message) {
        self.post(to, message);
        self.moved = Instant::now();
    }

    fn post(&mut self, to: usize, message: &Message) {
        let bytes = postcard::to_stdvec(&(PROTOCOL, message)).expect("messages are plain data");
        assert!(bytes.len() <= LARGEST + 64, "a message of {} bytes", bytes.len());
        self.outgoing.push(Letter::send(&self.world, to, bytes));
    }

    pub(super) fn send_checkpoint(&mut self, to: usize, trunk: usize, bytes: Option<Vec<u8>>) {
        let bytes = bytes.filter(|bytes| bytes.len() <= LARGEST);
        self.send(to, &Message::Checkpoint { trunk, bytes });
    }

    /// Sends no more signs of life, because nobody may be there to receive them.
    pub(super) fn hush(&mut self) {
        self.hushed = true;
        self.expects_rank_zero = false;
    }

    /// A rank has announced that it sends no more.
    pub(super) fn forget(&mut self, rank: usize) {
        self.pulse.leave(rank);
    }

    /// The next message, if one is here. It also moves others on, sends signs of life, and reports
    /// silent ranks.
    pub(super) fn receive(&mut self) -> Result<Option<(usize, Message)>, SweepError> {
        loop {
            let received = self.take()?;
            if let Some((rank, _)) = &received {
                self.pulse.hear(*rank, Instant::now()).into_iter().for_each(|news| self.tell(news));
            }
            match received {
                Some((_, Message::Beat)) => {}
                Some(received) => return Ok(Some(received)),
                None => break,
            }
        }
        self.beat();
        Ok(None)
    }

    /// Sends a sign of life if it is time, and reports silent ranks. No more are sent to a rank
    /// that does not receive them.
    fn beat(&mut self) {
        let now = Instant::now();
        let (here, size) = (self.rank(), self.size());
        if self.pulse.is_due(now) && !self.hushed {
            let others = if here == 0 { 1..size } else { 0..1 };
            for rank in others {
                if !self.outgoing.iter().any(|letter| letter.to == Some(rank)) {
                    self.post(rank, &Message::Beat);
                }
            }
        }
        // One report is enough for rank 0.
        let watched = match here {
            0 => 1..size,
            1 if self.expects_rank_zero => 0..1,
            _ => 0..0,
        };
        for news in self.pulse.look(watched, now) {
            self.tell(news);
        }
    }

    fn tell(&self, news: News) {
        let name = |rank: usize| match self.hosts.get(rank) {
            Some(host) => format!("rank {rank} on {host}"),
            None => format!("rank {rank}"),
        };
        let told = match news {
            News::Silent(rank, time) => {
                let seconds = time.as_secs_f64();
                format!(
                    "{} has not been heard of for {seconds:.0} s; what it runs waits",
                    name(rank)
                )
            }
            News::Back(rank) => format!("{} is heard again", name(rank)),
        };
        // If a warning cannot be written, the sweep must still go on.
        let _ = writeln!(std::io::stderr(), "warning: {told}");
    }

    fn take(&mut self) -> Result<Option<(usize, Message)>, SweepError> {
        self.is_delivered();
        let (rank, letter) = match self.incoming.take() {
            Some(incoming) => incoming,
            None => match self.world.any_process().immediate_matched_probe() {
                Some((message, status)) => {
                    self.moved = Instant::now();
                    (status.source_rank() as usize, Letter::receive(message, &status))
                }
                None => return Ok(None),
            },
        };
        match letter.test() {
            Ok(bytes) => {
                self.moved = Instant::now();
                Ok(Some((rank, read(rank, &bytes)?)))
            }
            Err(letter) => {
                self.incoming = Some((rank, letter));
                Ok(None)
            }
        }
    }

    /// How long to wait before looking again.
    pub(super) fn nap(&self) -> Duration {
        let incoming = self.incoming.iter().map(|(_, letter)| letter);
        let largest = self.outgoing.iter().chain(incoming).map(|letter| letter.bytes.len()).max();
        let longest = match largest {
            None => LONG_NAP,
            Some(bytes) if bytes < LARGE => LETTER_NAP,
            Some(_) => LARGE_NAP,
        };
        (self.moved.elapsed() / NAP_OF_SILENCE).clamp(SHORT_NAP, longest)
    }

    /// Whether everything sent has left. Forgets messages that have.
    pub(super) fn is_delivered(&mut self) -> bool {
        let before = self.outgoing.len();
        let outgoing = std::mem::take(&mut self.outgoing);
        self.outgoing = outgoing.into_iter().filter_map(|letter| letter.test().err()).collect();
        if self.outgoing.len() < before {
            self.moved = Instant::now();
        }
        self.outgoing.is_empty()
    }
}

fn read(rank: usize, bytes: &[u8]) -> Result<Message, SweepError> {
    let unreadable = |reason: &dyn std::fmt::Display| {
        SweepError::Executor(format!("a message from rank {rank} cannot be read: {reason}"))
    };
    let (protocol, rest) =
        postcard::take_from_bytes::<u16>(bytes).map_err(|error| unreadable(&error))?;
    if protocol != PROTOCOL {
        return Err(unreadable(&format_args!("protocol {protocol}, not {PROTOCOL}")));
    }
    postcard::from_bytes(rest).map_err(|error| unreadable(&error))
}

/// A message that its receiver does not expect now.
pub(super) fn out_of_turn(rank: usize, message: &Message) -> SweepError {
    let told = format!("{message:?}");
    let name = told.split([' ', '(']).next().unwrap_or_default();
    SweepError::Executor(format!("rank {rank} sent {name} out of turn"))
}
