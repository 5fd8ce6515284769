//! A message in transit between ranks, and its memory.

use std::mem::ManuallyDrop;

use mpi::point_to_point::{Message as MatchedMessage, Status};
use mpi::request::{Request, StaticScope};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, Destination, Equivalence};

/// A message in transit, and the memory from which MPI reads it or to which MPI writes it.
pub(super) struct Letter {
    /// Never dropped: rsmpi would panic, and an unwinding rank must reach its abort.
    request: ManuallyDrop<Request<'static, [u8], StaticScope>>,
    pub(super) bytes: *mut [u8],
    /// The receiving rank; `None` if it comes to this rank.
    pub(super) to: Option<usize>,
}

impl Letter {
    pub(super) fn send(world: &SimpleCommunicator, to: usize, bytes: Vec<u8>) -> Letter {
        let bytes = Box::into_raw(bytes.into_boxed_slice());
        // SAFETY: the memory is freed in `test` only, after MPI has let go of it; until then it
        // is only read.
        let content: &'static [u8] = unsafe { &*bytes };
        let request = world.process_at_rank(to as i32).immediate_send(StaticScope, content);
        Letter { request: ManuallyDrop::new(request), bytes, to: Some(to) }
    }

    pub(super) fn receive(message: MatchedMessage, status: &Status) -> Letter {
        let length = status.count(u8::equivalent_datatype()) as usize;
        let bytes = Box::into_raw(vec![0; length].into_boxed_slice());
        // SAFETY: the memory is read and freed in `test` only, after MPI has let go of it; until
        // then only MPI writes there.
        let content: &'static mut [u8] = unsafe { &mut *bytes };
        let request = message.immediate_matched_receive_into(StaticScope, content);
        Letter { request: ManuallyDrop::new(request), bytes, to: None }
    }

    /// The content once it has arrived; itself while still in transit.
    pub(super) fn test(self) -> Result<Box<[u8]>, Letter> {
        let (bytes, to) = (self.bytes, self.to);
        match ManuallyDrop::into_inner(self.request).test() {
            // SAFETY: made by `Box::into_raw`; the request is complete, and nothing else refers
            // to it.
            Ok(_) => Ok(unsafe { Box::from_raw(bytes) }),
            Err(request) => Err(Letter { request: ManuallyDrop::new(request), bytes, to }),
        }
    }
}
