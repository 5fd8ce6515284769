//! The force as it counts for maxima: a centred running mean, without what the sound of the water adds.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};

use super::sound::Compression;

/// The slope of the compression is that of a line through the turns of so many mean spans to both sides.
const SIDE: f64 = 3.0;
/// And of so many turns at least, to both sides.
const SIDE_TURNS: f64 = 1.5;
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
        let newest = middle + self.side * (1.0 + 1e-9);
        let turns = || self.turns.iter().take_while(|turn| turn.time <= newest);
        let count = turns().count() as f64;
        let reach = turns().last().map_or(0.0, |last| last.time - self.turns[0].time);
        // Some turns are missing where they reach over little more than one side.
        if count < 3.0 || reach < 1.25 * self.side {
            return Push::default();
        }
        let mean = |part: &dyn Fn(&Compression) -> f64| turns().map(part).sum::<f64>() / count;
        let (time, rate) = (mean(&|turn| turn.time), mean(&|turn| turn.rate));
        let above = turns().map(|turn| (turn.time - time) * (turn.rate - rate)).sum::<f64>();
        let below = turns().map(|turn| (turn.time - time).powi(2)).sum::<f64>();
        let force = mean(&|turn| turn.carried) - above / below;
        Push { force, depth: Some(mean(&|turn| turn.depth)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPAN: f64 = 0.01;

    #[test]
    fn the_mean_of_a_line_is_its_middle() {
        for turn in [None, Some(0.003)] {
            let (mut mean, mut told) = (QuietForce::new(SPAN, turn), 0);
            for k in 0..200 {
                let time = 0.0009 * f64::from(k);
                if let Some(quiet) = mean.push((time, 3.0 * time + 1.0), None) {
                    assert!((quiet.force - (3.0 * quiet.time + 1.0)).abs() < 1e-12);
                    told += 1;
                }
            }
            assert!(told > 150, "{told}");
        }
    }

    /// Feeds a force that sound has part in, and tells the largest of what is left.
    fn largest(step: f64, steps: u32, sound: f64) -> f64 {
        let turn = f64::from(steps) * step;
        let mut force = QuietForce::new(SPAN, Some(turn));
        let bell = |t: f64| (-((t - 0.5) / 0.1).powi(2)).exp();
        // -d/dt of the rate is the sound.
        let rate = |t: f64| sound * bell(t) * (t - 0.5);
        let added = |t: f64| 2.0 * sound - (rate(t + 1e-6) - rate(t - 1e-6)) / 2e-6;
        let (mut sums, mut highest) = ([0.0; 2], 0.0_f64);
        for k in 0..(1.0 / step) as u32 {
            let time = step * f64::from(k);
            let full = k % steps == 0 && k > 0;
            let told = full.then(|| {
                let [time, rate] = std::mem::take(&mut sums).map(|sum| sum / f64::from(steps));
                Compression { time, rate, carried: 2.0 * sound, depth: 0.4 }
            });
            sums[0] += time;
            // Within a turn the rate is seen aslant.
            sums[1] += rate(time) + 0.3 * (f64::from(k % steps) - 0.5 * f64::from(steps - 1));
            let heard = (time, 1.0 + bell(time) + added(time));
            if let Some(quiet) = force.push(heard, told) {
                highest = highest.max(quiet.force);
            }
        }
        highest
    }

    /// Four rows of water take longer steps than the span.
    #[test]
    fn a_force_is_told_of_steps_longer_than_the_span() {
        let still = largest(1.2 * SPAN, 3, 0.0);
        assert!((still - 2.0).abs() < 5e-3, "{still}");
    }

    #[test]
    fn sound_is_taken_off_at_every_step() {
        for (step, steps) in [(0.0013, 3), (0.0026, 3), (0.004, 3), (0.0008, 1)] {
            let (loud, still) = (largest(step, steps, 0.05), largest(step, steps, 0.0));
            assert!((loud - still).abs() < 5e-3, "{step}: {loud}, {still}");
            assert!((still - 2.0).abs() < 5e-3, "{step}: {still}");
        }
    }

    #[test]
    fn the_last_samples_are_told_at_the_end() {
        let mut force = QuietForce::new(SPAN, Some(0.003));
        let mut told: Vec<f64> = Vec::new();
        for k in 0..100 {
            told.extend(force.push((0.001 * f64::from(k), 2.0), None).map(|quiet| quiet.time));
        }
        let before = told.len();
        force.finish(|quiet| {
            assert!((quiet.force - 2.0).abs() < 1e-12);
            told.push(quiet.time);
        });
        assert!(told.len() > before + 20, "{told:?}");
        assert!(told.windows(2).all(|pair| pair[1] > pair[0]), "{told:?}");
        assert!(told.last().is_some_and(|&at| (0.0925..0.0955).contains(&at)), "{told:?}");
    }

    #[test]
    fn what_was_not_listened_to_throughout_is_left_as_it_is() {
        let mut force = QuietForce::new(SPAN, Some(0.003));
        for k in 0..100 {
            let time = 0.001 * f64::from(k);
            let turn = Compression { time, rate: 9.0 * time, carried: 0.0, depth: 0.4 };
            let told = force.push((time, 2.0), (k % 3 == 0 && k < 60).then_some(turn));
            if let Some(Quiet { time: at, force: value, sound }) = told {
                assert_eq!(sound.force, 2.0 - value);
                assert_eq!(sound.depth.is_some(), value > 2.1);
                let expected = if at < 0.045 { 11.0 } else { 2.0 };
                assert!(
                    (0.045..0.055).contains(&at) || at < 0.01 || (value - expected).abs() < 1e-9,
                    "{at}: {value}"
                );
            }
        }
    }
}
