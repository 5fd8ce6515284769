//! Mail between ranks: whole messages, sent and received without waiting.

use std::mem::ManuallyDrop;
use std::time::{Duration, Instant};

use mpi::point_to_point::{Message as MatchedMessage, Status};
use mpi::request::{Request, StaticScope};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination, Equivalence, Source};

use super::Message;
use crate::results::SweepError;

/// Raised with every change of the messages; leads every message.
const PROTOCOL: u16 = 3;
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
}

impl Post {
    pub(super) fn new(world: SimpleCommunicator) -> Post {
        Post { world, outgoing: Vec::new(), incoming: None, moved: Instant::now() }
    }

    pub(super) fn rank(&self) -> usize {
        self.world.rank() as usize
    }

    pub(super) fn size(&self) -> usize {
        self.world.size() as usize
    }

    /// Sends without waiting: two ranks that send to each other cannot block each other.
    pub(super) fn send(&mut self, to: usize, message: &Message) {
        let bytes = postcard::to_stdvec(&(PROTOCOL, message)).expect("messages are plain data");
        assert!(bytes.len() <= LARGEST + 64, "a message of {} bytes", bytes.len());
        self.outgoing.push(Letter::send(&self.world, to, bytes));
        self.moved = Instant::now();
    }

    pub(super) fn send_checkpoint(&mut self, to: usize, trunk: usize, bytes: Option<Vec<u8>>) {
        let bytes = bytes.filter(|bytes| bytes.len() <= LARGEST);
        self.send(to, &Message::Checkpoint { trunk, bytes });
    }

    /// The next message, if one is here; also moves others on.
    pub(super) fn receive(&mut self) -> Result<Option<(usize, Message)>, SweepError> {
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

/// A message on its way, and the memory that MPI reads it from or writes it to.
struct Letter {
    /// Never dropped: rsmpi panics on that, and an unwinding rank must get to its abort.
    request: ManuallyDrop<Request<'static, [u8], StaticScope>>,
    bytes: *mut [u8],
}

impl Letter {
    fn send(world: &SimpleCommunicator, to: usize, bytes: Vec<u8>) -> Letter {
        let bytes = Box::into_raw(bytes.into_boxed_slice());
        // SAFETY: the memory is freed in `test` only, after MPI has let go of it; until then it
        // is only read.
        let content: &'static [u8] = unsafe { &*bytes };
        let request = world.process_at_rank(to as i32).immediate_send(StaticScope, content);
        Letter { request: ManuallyDrop::new(request), bytes }
    }

    fn receive(message: MatchedMessage, status: &Status) -> Letter {
        let length = status.count(u8::equivalent_datatype()) as usize;
        let bytes = Box::into_raw(vec![0; length].into_boxed_slice());
        // SAFETY: the memory is read and freed in `test` only, after MPI has let go of it; until
        // then only MPI writes there.
        let content: &'static mut [u8] = unsafe { &mut *bytes };
        let request = message.immediate_matched_receive_into(StaticScope, content);
        Letter { request: ManuallyDrop::new(request), bytes }
    }

    /// What it says once it has arrived; itself while still on its way.
    fn test(self) -> Result<Box<[u8]>, Letter> {
        let bytes = self.bytes;
        match ManuallyDrop::into_inner(self.request).test() {
            // SAFETY: made by `Box::into_raw`; the request is complete, and nothing else refers
            // to it.
            Ok(_) => Ok(unsafe { Box::from_raw(bytes) }),
            Err(request) => Err(Letter { request: ManuallyDrop::new(request), bytes }),
        }
    }
}
