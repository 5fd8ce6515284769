//! Mail between ranks: whole messages, sent without waiting.

use std::mem::ManuallyDrop;

use mpi::request::{Request, StaticScope};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination, Equivalence, Source};

use super::Message;
use crate::sweep::error::SweepError;

/// Raised with every change of the messages; leads every message.
const PROTOCOL: u16 = 2;
/// MPI counts bytes in a C int; a checkpoint larger than this is not sent, and the case that
/// wants it runs from rest.
const LARGEST: usize = 1 << 30;

/// A rank's mail.
pub(super) struct Post {
    world: SimpleCommunicator,
    outgoing: Vec<Outgoing>,
}

impl Post {
    pub(super) fn new(world: SimpleCommunicator) -> Post {
        Post { world, outgoing: Vec::new() }
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
        self.outgoing.push(Outgoing::start(&self.world, to, bytes));
    }

    pub(super) fn send_checkpoint(&mut self, to: usize, trunk: usize, bytes: Option<Vec<u8>>) {
        let bytes = bytes.filter(|bytes| bytes.len() <= LARGEST);
        self.send(to, &Message::Checkpoint { trunk, bytes });
    }

    /// The next message, if one is here; also moves outgoing ones on.
    pub(super) fn receive(&mut self) -> Result<Option<(usize, Message)>, SweepError> {
        self.is_delivered();
        let Some((message, status)) = self.world.any_process().immediate_matched_probe() else {
            return Ok(None);
        };
        let mut bytes = vec![0_u8; status.count(u8::equivalent_datatype()) as usize];
        message.matched_receive_into(&mut bytes[..]);
        let rank = status.source_rank();
        let unreadable = |reason: &dyn std::fmt::Display| {
            SweepError::Executor(format!("a message from rank {rank} cannot be read: {reason}"))
        };
        let (protocol, rest) =
            postcard::take_from_bytes::<u16>(&bytes).map_err(|error| unreadable(&error))?;
        if protocol != PROTOCOL {
            return Err(unreadable(&format_args!("protocol {protocol}, not {PROTOCOL}")));
        }
        let message = postcard::from_bytes(rest).map_err(|error| unreadable(&error))?;
        Ok(Some((rank as usize, message)))
    }

    /// Whether everything sent has left; forgets what has.
    pub(super) fn is_delivered(&mut self) -> bool {
        let outgoing = std::mem::take(&mut self.outgoing);
        self.outgoing = outgoing.into_iter().filter_map(Outgoing::test).collect();
        self.outgoing.is_empty()
    }
}

/// A message on its way, and the memory that MPI reads it from.
struct Outgoing {
    /// Never dropped: rsmpi panics on that, and an unwinding rank must get to its abort.
    request: ManuallyDrop<Request<'static, [u8], StaticScope>>,
    bytes: *mut [u8],
}

impl Outgoing {
    fn start(world: &SimpleCommunicator, to: usize, bytes: Vec<u8>) -> Outgoing {
        let bytes = Box::into_raw(bytes.into_boxed_slice());
        // SAFETY: the memory is freed in `test` only, after MPI has let go of it; until then it
        // is only read.
        let content: &'static [u8] = unsafe { &*bytes };
        let process = world.process_at_rank(to as i32);
        let request = ManuallyDrop::new(process.immediate_send(StaticScope, content));
        Outgoing { request, bytes }
    }

    /// Itself while still on its way.
    fn test(self) -> Option<Outgoing> {
        let bytes = self.bytes;
        match ManuallyDrop::into_inner(self.request).test() {
            Ok(_) => {
                // SAFETY: made by `Box::into_raw` in `start`; the request is complete, and
                // nothing else refers to it.
                drop(unsafe { Box::from_raw(bytes) });
                None
            }
            Err(request) => Some(Outgoing { request: ManuallyDrop::new(request), bytes }),
        }
    }
}
