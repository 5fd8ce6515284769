//! The force as it counts for maxima: a centred running mean, without what the sound of the water adds.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::sound::Compression;

/// The slope of the compression is that of a line through the turns of so many mean spans to both sides.
const SIDE: f64 = 3.0;
/// And of so many turns at least, to both sides.
const SIDE_TURNS: f64 = 1.5;
/// A wall that swings hears the slope of a shorter line: so many mean spans ...
const SWIFT_SIDE: f64 = 1.0;
/// ... and so many turns at least, but no longer than the other.
const SWIFT_TURNS: f64 = 2.5;
/// Room from the start for so many samples.
const ROOM: usize = 256;

/// A force without its sound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quiet {
    /// When, s.
    pub time: f64,
    /// The mean of the samples less the sound.
    pub force: f64,
    /// What the sound was.
    pub sound: Push,
}

/// What the sound of the water does to a wall.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Push {
    /// What it adds to the force.
    pub force: f64,
    /// The same over a shorter time, for walls that swing on their spring.
    pub swift: f64,
    /// In water so deep, m, where that was listened to.
    pub depth: Option<f64>,
}

/// Keeps the last samples and tells the mean over `span` seconds around a time some way back.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuietForce {
    span: f64,
    /// From the last sample back to the middle of what is told, s.
    lag: f64,
    /// To both sides of that middle, s.
    side: f64,
    filled: bool,
    samples: VecDeque<(f64, f64)>,
    turns: VecDeque<Compression>,
}

impl QuietForce {
    /// A mean over `span` seconds. The compression comes once in `turn` seconds; where there is none, the
    /// water makes no sound.
    pub fn new(span: f64, turn: Option<f64>) -> QuietForce {
        let side = turn.map_or(0.5 * span, |turn| (SIDE * span).max(SIDE_TURNS * turn));
        QuietForce {
            span,
            // A turn is told when it is over.
            lag: side + turn.unwrap_or(0.0),
            side,
            filled: false,
            samples: VecDeque::with_capacity(ROOM),
            turns: VecDeque::with_capacity(ROOM),
        }
    }

    /// Forgets all samples: the next span has to fill anew.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.turns.clear();
        self.filled = false;
    }

    /// Takes a sample, and a turn of the compression where one has ended. Returns the mean without sound,
    /// once the span is filled.
    pub fn push(&mut self, (time, force): (f64, f64), turn: Option<Compression>) -> Option<Quiet> {
        self.samples.push_back((time, force));
        self.turns.extend(turn);
        self.tell(time - self.lag)
    }

    /// Tells what is still to be told when no sample follows.
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
        // Of steps that are longer than the span there is at least one to either side.
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

    /// What sound adds to the force around `middle`; nothing where it was not listened to throughout.
    fn sound(&self, middle: f64) -> Push {
        let turn = self.lag - self.side;
        let swift_side = self.side.min((SWIFT_SIDE * self.span).max(SWIFT_TURNS * turn));
        match [self.side, swift_side].map(|side| self.added(middle, side)) {
            [Some([force, depth]), Some([swift, _])] => Push { force, swift, depth: Some(depth) },
            _ => Push::default(),
        }
    }

    /// That from the turns up to `side` seconds away, and the depth of the water in them.
    fn added(&self, middle: f64, side: f64) -> Option<[f64; 2]> {
        let within = side * (1.0 + 1e-9);
        let turns = || self.turns.iter().filter(|turn| (turn.time - middle).abs() <= within);
        let count = turns().count() as f64;
        let reach = turns().next_back()?.time - turns().next()?.time;
        // Some turns are missing where they reach over little more than one side.
        if count < 3.0 || reach < 1.25 * side {
            return None;
        }
        let mean = |part: &dyn Fn(&Compression) -> f64| turns().map(part).sum::<f64>() / count;
        let (time, rate) = (mean(&|turn| turn.time), mean(&|turn| turn.rate));
        let above = turns().map(|turn| (turn.time - time) * (turn.rate - rate)).sum::<f64>();
        let below = turns().map(|turn| (turn.time - time).powi(2)).sum::<f64>();
        Some([mean(&|turn| turn.carried) - above / below, mean(&|turn| turn.depth)])
    }
}

#[cfg(test)]
mod tests;
