//! The force for maxima: a centred running mean without the effect of sound.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::sound::Compression;

/// The slope of the compression is that of a line through the turns within this many mean spans on
/// both sides ...
const SIDE: f64 = 3.0;
/// ... and within at least this many turns on both sides.
const SIDE_TURNS: f64 = 1.5;
/// For a wall that swings, the line is shorter: this many mean spans ...
const SWIFT_SIDE: f64 = 1.0;
/// ... and at least this many turns, but no longer than the other.
const SWIFT_TURNS: f64 = 2.5;
/// Memory reserved for this many samples.
const ROOM: usize = 256;

/// A force without its sound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quiet {
    /// When, s.
    pub time: f64,
    /// The mean of the samples without the sound.
    pub force: f64,
    /// The effect of the sound.
    pub sound: Push,
}

/// The effect of the water's sound on a wall.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Push {
    /// Its force.
    pub force: f64,
    /// The same from a shorter time, for walls that swing on their spring.
    pub swift: f64,
    /// Depth of the water, m, if the sound is known.
    pub depth: Option<f64>,
}

/// Keeps the last samples and gives the mean over `span` seconds around an earlier time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuietForce {
    span: f64,
    /// Time from the middle of that mean to the last sample, s.
    lag: f64,
    /// Time to both sides of that middle, s.
    side: f64,
    filled: bool,
    samples: VecDeque<(f64, f64)>,
    turns: VecDeque<Compression>,
    /// When the wall's acceleration jumped, s.
    jumps: VecDeque<f64>,
}

impl QuietForce {
    /// A mean over `span` seconds. The compression comes once in `turn` seconds. Without a `turn`
    /// the water makes no sound.
    pub fn new(span: f64, turn: Option<f64>) -> QuietForce {
        let side = turn.map_or(0.5 * span, |turn| (SIDE * span).max(SIDE_TURNS * turn));
        QuietForce {
            span,
            // A turn is complete at its end.
            lag: side + turn.unwrap_or(0.0),
            side,
            filled: false,
            samples: VecDeque::with_capacity(ROOM),
            turns: VecDeque::with_capacity(ROOM),
            jumps: VecDeque::new(),
        }
    }

    /// Forgets all samples. The span must then fill again.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.turns.clear();
        self.jumps.clear();
        self.filled = false;
    }

    /// Records that the wall's acceleration jumps at `time`, s, which is that of the last sample.
    pub fn jump(&mut self, time: f64) {
        self.jumps.push_back(time);
    }

    /// Takes a sample, and the compression if a turn has ended. Returns the mean without sound once
    /// the span is filled.
    pub fn push(&mut self, (time, force): (f64, f64), turn: Option<Compression>) -> Option<Quiet> {
        self.samples.push_back((time, force));
        self.turns.extend(turn);
        self.tell(time - self.lag)
    }

    /// Gives the means that are still missing when no sample follows.
    pub fn finish(&mut self, mut told: impl FnMut(Quiet)) {
        let mut last = self.samples.iter().rev().map(|&(time, _)| time);
        let (Some(newest), Some(before)) = (last.next(), last.next()) else { return };
        let mut middle = newest - self.lag;
        while middle <= newest - 0.5 * self.span {
            middle += newest - before;
            self.tell(middle).into_iter().for_each(&mut told);
        }
    }

    /// The mean without sound around `middle`.
    fn tell(&mut self, middle: f64) -> Option<Quiet> {
        // If steps are longer than the span, at least one counts on either side.
        let step = match (self.samples.front(), self.samples.get(1)) {
            (Some(first), Some(second)) => second.0 - first.0,
            _ => 0.0,
        };
        let span = self.span.max(step);
        let slack = span * 1e-9;
        let oldest = middle - 0.5 * span - slack;
        while self.samples.front().is_some_and(|&(t, _)| t < oldest) {
            self.samples.pop_front();
            self.filled = true;
        }
        while self.turns.front().is_some_and(|turn| turn.time < middle - self.side - slack) {
            self.turns.pop_front();
        }
        while self.jumps.front().is_some_and(|&jump| jump < middle - self.side - slack) {
            self.jumps.pop_front();
        }
        if !self.filled {
            return None;
        }
        let newest = middle + 0.5 * span + slack;
        let (mut last, mut sum, mut count) = (0.0, 0.0, 0.0);
        for &(t, force) in self.samples.iter().take_while(|&&(t, _)| t <= newest) {
            (last, sum, count) = (t, sum + force, count + 1.0);
        }
        let time = 0.5 * (self.samples.front()?.0 + last);
        let sound = self.sound(middle);
        (count > 0.0).then(|| Quiet { time, force: sum / count - sound.force, sound })
    }

    /// The effect of sound on the force around `middle`; none if the sound is not known over the
    /// whole time.
    fn sound(&self, middle: f64) -> Push {
        let turn = self.turn();
        let swift_side = self.side.min((SWIFT_SIDE * self.span).max(SWIFT_TURNS * turn));
        match [self.side, swift_side].map(|side| self.added(middle, side)) {
            [Some([force, depth]), Some([swift, _])] => Push { force, swift, depth: Some(depth) },
            _ => Push::default(),
        }
    }

    /// The effect from the turns up to `side` seconds away, and the water's depth in them. Across a
    /// jump of the wall's acceleration the slope is none, so turns beyond it do not count.
    fn added(&self, middle: f64, side: f64) -> Option<[f64; 2]> {
        let within = side * (1.0 + 1e-9);
        let [from, to] = self.alike(middle);
        let alike = |time: f64| time >= from && time < to && (time - middle).abs() <= within;
        let turns = || self.turns.iter().filter(|turn| alike(turn.time));
        let count = turns().count() as f64;
        let reach = turns().next_back()?.time - turns().next()?.time;
        // If the turns cover little more than half of that time, some are missing. But where few fit
        // into it they cover no more.
        let whole = side.min(middle - from) + side.min(to - middle);
        let fit = (whole / self.turn() + 1e-9).floor();
        if count < 3.0 || (reach < 0.625 * whole && count < fit) {
            return None;
        }
        let mean = |part: &dyn Fn(&Compression) -> f64| turns().map(part).sum::<f64>() / count;
        let (time, rate) = (mean(&|turn| turn.time), mean(&|turn| turn.rate));
        let above = turns().map(|turn| (turn.time - time) * (turn.rate - rate)).sum::<f64>();
        let below = turns().map(|turn| (turn.time - time).powi(2)).sum::<f64>();
        Some([mean(&|turn| turn.carried) - above / below, mean(&|turn| turn.depth)])
    }

    /// Time from one compression to the next, s; 0 where there is no sound.
    fn turn(&self) -> f64 {
        self.lag - self.side
    }

    /// The time around `middle` in which the wall's acceleration did not jump, s.
    fn alike(&self, middle: f64) -> [f64; 2] {
        let before = self.jumps.iter().rfind(|&&jump| jump <= middle);
        let after = self.jumps.iter().find(|&&jump| jump > middle);
        [*before.unwrap_or(&f64::NEG_INFINITY), *after.unwrap_or(&f64::INFINITY)]
    }
}

#[cfg(test)]
mod tests;
