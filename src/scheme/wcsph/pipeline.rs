//! The passes of a step after its forces are known, part by part: each part goes on as soon as what
//! it reads is there, so that a pass finds in a core's own cache what the one before it has left.
//!
//! Parts follow each other along the tank, and so do the particles that they read. Where a team
//! shares the work, all parts go through each pass together.

use std::ops::Range;
use std::time::Instant;

use super::Wcsph;
use super::parts::power;
use crate::body::BodyMotion;
use crate::math::simd::LANES;

/// Parts that go through the passes together.
#[derive(Debug, Clone)]
pub(super) struct Turn {
    parts: Range<usize>,
    /// Their particles, padding included.
    lanes: Range<usize>,
    /// So many particles, from the first, must have new velocities before these parts' pairs can be
    /// gone through and their particles be moved; or new pressures, before their next forces.
    after: usize,
}

/// What is lost on the way, per metre of width.
pub(super) struct Lost {
    /// Power of density diffusion, where it was asked for, W.
    pub diffusion_power: f64,
    /// Energy of what settles at the surface, J.
    pub spray: f64,
}

/// Time from one look at the clock to the next, seconds.
struct Laps(Instant);

impl Laps {
    fn next(&mut self) -> f64 {
        let before = std::mem::replace(&mut self.0, Instant::now());
        (self.0 - before).as_secs_f64()
    }
}

impl Wcsph {
    /// Finds what parts wait for, with new lists.
    pub(super) fn plan_turns(&mut self) {
        let padded = self.fluid.padded_len();
        let Wcsph { turns, parts, exchange, team, ghosts, numbers, .. } = self;
        turns.clear();
        if !team.is_alone() || parts.len() == 1 {
            turns.push(Turn { parts: 0..parts.len(), lanes: 0..padded, after: 0 });
            return;
        }
        numbers.keep_apart();
        let end_of = |block: usize| exchange.water_of(block).end;
        turns.extend(parts.iter().enumerate().map(|(number, part)| {
            let mut after = 0;
            for cluster in 0..part.clusters.len() {
                // In the order of the particles.
                let last = part.pairs.group(cluster, 0).last();
                after = after.max(last.map_or(0, |&last| last as usize + 1));
                for group in 1..part.pairs.groups() {
                    let ghosts = part.pairs.group(cluster, group).iter();
                    let ends = ghosts.map(|&ghost| end_of((ghost as usize - padded) / LANES));
                    after = ends.fold(after, usize::max);
                }
            }
            Turn { parts: number..number + 1, lanes: part.lanes(), after }
        }));
        // A wall may turn round the velocity of a particle: only when no ghost is left to read it.
        for block in 0..ghosts.len() / LANES {
            let read = exchange.water_of(block);
            let first = turns.partition_point(|turn| turn.lanes.end <= read.start);
            let read_by = turns[first..].iter_mut();
            for turn in read_by.take_while(|turn| turn.lanes.start < read.end) {
                turn.after = turn.after.max(read.end);
            }
        }
    }

    /// Takes the water through a step of `dt` seconds with the accelerations at hand: velocities,
    /// rates of change of density, places; and with `forces` on to the accelerations of the next.
    pub(super) fn go_through(
        &mut self,
        dt: f64,
        bodies: &[BodyMotion],
        sample: bool,
        forces: bool,
    ) -> Lost {
        let turns = std::mem::take(&mut self.turns);
        let mut laps = Laps(Instant::now());
        let mut spray = 0.0;
        // How many blocks of ghosts have new velocities, and how many new pressures.
        let (mut mirrored, mut pressed) = (0, 0);
        // Which turns are still to be moved, and which to be given their next forces.
        let (mut to_move, mut to_force) = (turns.iter().peekable(), turns.iter().peekable());
        for Turn { parts, lanes, .. } in &turns {
            self.kick(dt, lanes.clone());
            self.pack_velocities(parts.clone());
            self.timings.integration += laps.next();
            let ready = self.exchange.ready(lanes.end);
            self.mirror_ghosts(mirrored..ready);
            self.timings.ghosts += laps.next();
            mirrored = ready;
            while let Some(Turn { parts, lanes: moved, .. }) =
                to_move.next_if(|turn| turn.after <= lanes.end)
            {
                self.continuity_pass(dt, sample, parts.clone());
                self.timings.continuity += laps.next();
                self.drift(dt, moved.clone());
                self.settle_surface(dt, moved.clone(), &mut spray);
                if !forces {
                    self.timings.integration += laps.next();
                    continue;
                }
                self.hold_inside(bodies, moved.clone());
                self.pack_pressures(parts.clone());
                self.timings.integration += laps.next();
                let ready = self.exchange.ready(moved.end);
                self.press_ghosts(pressed..ready);
                self.timings.ghosts += laps.next();
                pressed = ready;
                while let Some(turn) = to_force.next_if(|turn| turn.after <= moved.end) {
                    self.acoustic_pass(turn.parts.clone());
                }
                self.timings.momentum += laps.next();
            }
        }
        self.turns = turns;
        let diffusion_power = power(&self.parts);
        if forces {
            self.sum_loads();
        }
        self.timings.momentum += laps.next();
        Lost { diffusion_power, spray }
    }
}
