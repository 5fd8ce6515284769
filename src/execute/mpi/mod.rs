//! Many processes under an MPI launcher; rank 0 coordinates and computes.
//!
//! On every rank the thread that entered here sends and receives all messages, and never blocks. It
//! sends without waiting and looks for messages. Otherwise it sleeps until a case on one of the
//! other threads ends. It sleeps for half the time without messages so far, from 0.05 to 20 ms.
//! Checkpoints go from rank to rank when the receiver asks.
//!
//! A session: every rank sends Hello; rank 0 sends Start, then orders, then Rest. Start may come
//! again, for the next round of a study; Finish ends the session. A rank then answers Bye once
//! everything that it sent has been received. It goes on receiving until Leave, so that nobody
//! waits for a partner that has gone.
//!
//! A rank that looks for messages also sends signs of life, and reports a rank that has been silent
//! for long. The launcher notices a dead rank and ends the job.

mod hello;
mod letter;
mod message;
mod post;
mod pulse;
mod station;

use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;

use mpi::Threading;
use mpi::traits::Communicator;

use self::hello::{Hello, share_cores, stranger};
use self::message::{Message, Start};
use self::post::{Post, out_of_turn};
use self::station::{RankZero, Station, work};
use super::worker::with_worker;
use super::{Crew, Launcher, Link, Setup, resources, share_threads};
use crate::keys::{named, shown};
use crate::math::simd::SimdPath;
use crate::results::{Filing, Mark, RankInfo, SweepError};

/// Whether this build can run under MPI.
pub const AVAILABLE: bool = true;

/// Joins the other ranks. `lead` runs on rank 0 only and returns its exit code. The other ranks
/// serve it and return 0.
///
/// # Errors
/// MPI cannot be started, or is another than the launcher's. Any later error ends the whole job.
pub fn with_crew(
    setup: &Setup<'_>,
    launcher: Launcher,
    lead: impl FnOnce(&mut dyn Crew) -> u8,
) -> Result<u8, SweepError> {
    let Some((universe, level)) = mpi::initialize_with_threading(Threading::Funneled) else {
        return Err(SweepError::Executor("MPI has been started before".to_owned()));
    };
    if level < Threading::Funneled {
        return Err(SweepError::Executor("this MPI allows no second thread".to_owned()));
    }
    let world = universe.world();
    let library = mpi::environment::library_version().unwrap_or_default();
    if let Some(told) = launcher.misfit(world.size() as usize, name_of(&library)) {
        return Err(SweepError::Refused(told));
    }
    let rank = world.rank();
    // A rank that unwound from here would leave the others waiting, so it ends the job.
    let ended = catch_unwind(AssertUnwindSafe(|| {
        let post = Post::new(universe.world(), setup.patience);
        if rank == 0 { lead_crew(setup, post, lead) } else { serve(setup, post).map(|()| 0) }
    }));
    match ended {
        Ok(Ok(code)) => Ok(code),
        Ok(Err(error)) => {
            tell_before_the_end(&format!("error: rank {rank}: {}\n", shown(&error.to_string())));
            world.abort(70)
        }
        Err(_) => world.abort(70),
    }
}

/// How long a launcher may take to pass a line on. That of MPICH drops what it has not passed on when
/// a rank ends the job.
const PASSED_ON_IN: Duration = Duration::from_millis(200);

/// Writes a line at once and whole, and gives the launcher time to pass it on.
fn tell_before_the_end(line: &str) {
    // Nothing can be told where this fails.
    let _ = std::io::stderr().write_all(line.as_bytes());
    std::thread::sleep(PASSED_ON_IN);
}

/// The name of an MPI library, from all that it tells of itself.
fn name_of(library: &str) -> &str {
    let name = library.split([',', ':', '\n']).next().unwrap_or_default();
    name.trim_end_matches("Version").trim()
}

fn lead_crew(
    setup: &Setup<'_>,
    mut post: Post,
    lead: impl FnOnce(&mut dyn Crew) -> u8,
) -> Result<u8, SweepError> {
    let mut hellos = vec![None; post.size()];
    hellos[0] = Some(Hello::of_this_process());
    while hellos.iter().any(Option::is_none) {
        match post.receive()? {
            Some((rank, Message::Hello(hello))) => hellos[rank] = Some(hello),
            Some((rank, message)) => return Err(out_of_turn(rank, &message)),
            None => std::thread::sleep(post.nap()),
        }
    }
    let hellos: Vec<_> = hellos.into_iter().flatten().collect();
    if let Some((rank, reason)) = stranger(&hellos) {
        return Err(SweepError::Executor(format!("rank {rank} on {} {reason}", hellos[rank].host)));
    }
    post.introduce(hellos.iter().map(|hello| hello.host.clone()).collect());
    let ranks = share_cores(&hellos, setup.threads);
    let widest = hellos.iter().map(|hello| hello.simd).min().unwrap_or(SimdPath::Portable);
    let mut crew = MpiCrew { setup: *setup, post, ranks, widest };
    let code = lead(&mut crew);
    crew.dismiss()?;
    Ok(code)
}

struct MpiCrew<'a> {
    setup: Setup<'a>,
    post: Post,
    ranks: Vec<RankInfo>,
    widest: SimdPath,
}

impl MpiCrew<'_> {
    fn send_all(&mut self, message: impl Fn(&RankInfo) -> Message) {
        for rank in 1..self.ranks.len() {
            self.post.send(rank, &message(&self.ranks[rank]));
        }
    }

    fn dismiss(&mut self) -> Result<(), SweepError> {
        self.send_all(|_| Message::Finish);
        let mut working = self.ranks.len() - 1;
        while working > 0 {
            match self.post.receive()? {
                Some((rank, Message::Bye)) => {
                    self.post.forget(rank);
                    working -= 1;
                }
                Some(_) => {}
                None => std::thread::sleep(self.post.nap()),
            }
        }
        self.send_all(|_| Message::Leave);
        while !self.post.is_delivered() {
            std::thread::sleep(self.post.nap());
        }
        Ok(())
    }
}

impl Crew for MpiCrew<'_> {
    fn executor(&self) -> &'static str {
        "mpi"
    }

    fn ranks(&self) -> &[RankInfo] {
        &self.ranks
    }

    fn share_threads(&mut self, runs: usize) {
        share_threads(&mut self.ranks, runs);
    }

    fn widest_simd(&self) -> SimdPath {
        self.widest
    }

    fn work(
        &mut self,
        simd: SimdPath,
        out: &Path,
        lead: &mut dyn FnMut(&mut dyn Link) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        let mark = Mark::of(out);
        self.send_all(|rank| Message::Start(Start { simd, rank: rank.clone(), out: mark.clone() }));
        let runner = (self.setup.make_runner)(resources(&self.ranks[0], simd));
        let post = &mut self.post;
        let filing = Filing::here(out);
        let led = with_worker(0, self.ranks[0].places(), &*runner, Some(&filing), |worker| {
            let station = Station { post, worker };
            let (reports, elsewhere) = Default::default();
            lead(&mut RankZero { station, reports, elsewhere })
        })?;
        self.send_all(|_| Message::Rest);
        led
    }
}

/// Any rank but 0: one round of work after another, until rank 0 has none left.
fn serve(setup: &Setup<'_>, mut post: Post) -> Result<(), SweepError> {
    post.send(0, &Message::Hello(Hello::of_this_process()));
    let mut next = loop {
        match post.receive()? {
            None => std::thread::sleep(post.nap()),
            Some((0, Message::Start(start))) => break Some(start),
            Some((0, Message::Finish)) => break None,
            Some((rank, message)) => return Err(out_of_turn(rank, &message)),
        }
    };
    while let Some(Start { simd, rank: info, out }) = next {
        let rank = post.rank();
        let runner = (setup.make_runner)(resources(&info, simd));
        let post = &mut post;
        let filing = out.as_ref().and_then(Filing::elsewhere);
        if let (Some(out), None) = (&out, &filing) {
            let (host, out) = (&info.host, named(out.directory()));
            let rest = "rank 0 writes the files of its cases";
            eprintln!("note: rank {rank} on {host} does not see {out} of rank 0: {rest}");
        }
        next = with_worker(rank, info.places(), &*runner, filing.as_ref(), |worker| {
            work(setup, Station { post, worker })
        })??;
    }
    leave(&mut post)
}

/// Waits until everything sent has been received, and until no rank sends any more.
fn leave(post: &mut Post) -> Result<(), SweepError> {
    let mut said_bye = false;
    post.hush();
    loop {
        match post.receive()? {
            Some((0, Message::Leave)) => break,
            Some(_) => {}
            None => std::thread::sleep(post.nap()),
        }
        if !said_bye && post.is_delivered() {
            said_bye = true;
            post.send(0, &Message::Bye);
        }
    }
    while !post.is_delivered() {
        std::thread::sleep(post.nap());
    }
    Ok(())
}

#[cfg(test)]
mod tests;
