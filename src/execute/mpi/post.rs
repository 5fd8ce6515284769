//! Mail between ranks: whole messages, sent and received without waiting.

use std::io::Write;
use std::time::{Duration, Instant};

use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Source};

use super::Message;
use super::letter::Letter;
use super::pulse::{News, Pulse};
use crate::results::SweepError;

/// Raised with every change of the messages; leads every message.
const PROTOCOL: u16 = 6;
/// MPI counts bytes in a C int; a checkpoint larger than this is not sent, and the case that
/// wants it runs from rest.
const LARGEST: usize = 1 << 30;

/// How long to leave the mail alone when some has just moved.
const SHORT_NAP: Duration = Duration::from_micros(50);
/// How long at most while a large one is on its way: MPI moves it piece by piece, some with every look
/// of both sides.
const LARGE_NAP: Duration = Duration::from_micros(200);
const LARGE: usize = 100_000;
/// How long at most while another is on its way: whoever it is for may have other things to do first.
const LETTER_NAP: Duration = Duration::from_millis(1);
/// How long at most otherwise: every look takes its 30 microseconds from the case that runs on this core.
const LONG_NAP: Duration = Duration::from_millis(20);
/// A nap lasts the silence so far over this: a wait is lengthened by half at the most.
const NAP_OF_SILENCE: u32 = 2;

pub(super) struct Post {
    world: SimpleCommunicator,
    outgoing: Vec<Letter>,
    /// From a rank. No other is taken before it is here, so that messages stay in order.
    incoming: Option<(usize, Letter)>,
    /// When something was last sent, or seen to arrive or to have left.
    moved: Instant,
    pulse: Pulse,
    /// The machine of each rank, once it is known.
    hosts: Vec<String>,
    /// Whether rank 0 is expected to listen now: while it opens files and draws, it does not.
    expects_rank_zero: bool,
    /// Whether this rank says no more by itself.
    hushed: bool,
}

impl Post {
    /// The mail of this rank; who is silent for longer than `patience` is named.
    pub(super) fn new(world: SimpleCommunicator, patience: Duration) -> Post {
        let now = Instant::now();
        let pulse = Pulse::new(world.size() as usize, patience, now);
        let (outgoing, hosts) = (Vec::new(), Vec::new());
        let (expects_rank_zero, hushed, incoming) = (false, false, None);
        Post { world, outgoing, incoming, moved: now, pulse, hosts, expects_rank_zero, hushed }
    }

    /// The machine of each rank.
    pub(super) fn introduce(&mut self, hosts: Vec<String>) {
        self.hosts = hosts;
    }

    /// Whether silence of rank 0 is worth a word from now on.
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

    /// Says no more by itself: nobody may be there to hear it.
    pub(super) fn hush(&mut self) {
        self.hushed = true;
        self.expects_rank_zero = false;
    }

    /// A rank has said that it will say no more.
    pub(super) fn forget(&mut self, rank: usize) {
        self.pulse.leave(rank);
    }

    /// The next message, if one is here; also moves others on, lets hear of this rank, and names those that
    /// are silent.
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

    /// Lets hear of this rank where it is time to, and tells who is silent. Where nothing can be said to a
    /// rank because it does not listen, no more is said.
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
        // One voice is enough for rank 0.
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
        // A warning that nobody reads must not end a sweep.
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

    /// Whether everything sent has left; forgets what has.
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
