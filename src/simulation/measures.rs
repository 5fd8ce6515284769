//! Maxima of a run, of its first impact and of its first peak, found step by step.

use serde::{Deserialize, Serialize};

use super::blows::{Acoustics, Blows, Hit};
use super::first_impact::{FirstImpact, StepReading};
use super::outcome::Maximum;
use super::quiet_force::{Push, Quiet, QuietForce};
use super::quiet_travel::{Mount, QuietTravel};
use super::sound::Compression;
use super::wall_pressures::Pressed;
use super::waves::Waves;
use crate::body::WallStep;

/// Span of the force's running mean over √(h/g).
pub(super) const MEAN_SPAN: f64 = 0.07;

/// Maxima so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measures {
    quiet: QuietForce,
    travel: QuietTravel,
    /// Whether the effect of sound is removed.
    listens: bool,
    /// The first impact.
    pub first: FirstImpact,
    /// Hits on the stop.
    pub blows: Blows,
    /// Largest F* of the whole run (running mean without sound).
    pub force: Option<Maximum>,
    /// R*.
    pub runup: Option<Maximum>,
    /// X*; of a wall that nothing drives back |X*|.
    pub displacement: Option<Maximum>,
    /// Largest |X*| of any step, with the effect of sound.
    pub farthest: f64,
    /// Whether the wall left its stop in the sound of an impact before that X*.
    pub kicked: bool,
    /// Largest F* of a single step in which no impact can be heard.
    pub force_raw: Option<f64>,
    /// The last reading's F*, R*, X*.
    pub last: [f64; 3],
    /// The wall's stops so far.
    stops: u32,
    /// Pressures along the wall and their moment.
    pub pressed: Pressed,
    /// Each wave of a train.
    pub waves: Option<Waves>,
}

impl Measures {
    /// `thresholds` are the F* above which the wall moves and that below which an impact is over.
    /// `points` is the number of points on the wall's face. If there is a `turn`, the water's
    /// compression comes once in `turn` seconds.
    pub fn new(
        thresholds: [f64; 2],
        acoustics: Acoustics,
        turn: Option<f64>,
        points: usize,
    ) -> Measures {
        let unit_time = (acoustics.depth / acoustics.gravity).sqrt();
        Measures {
            quiet: QuietForce::new(MEAN_SPAN * unit_time, turn),
            travel: QuietTravel::new(),
            listens: turn.is_some(),
            first: FirstImpact::new(thresholds, unit_time),
            blows: Blows::new(acoustics),
            force: None,
            runup: None,
            displacement: None,
            farthest: 0.0,
            kicked: false,
            force_raw: None,
            last: [0.0; 3],
            stops: 0,
            pressed: Pressed::new(points, MEAN_SPAN * unit_time),
            waves: None,
        }
    }

    /// Takes one step's readings, the water's compression at the end of a turn of steps, and the
    /// wall's mount. Forces in the sound of an impact on the stop do not count.
    pub fn push(
        &mut self,
        reading: StepReading,
        compression: Option<Compression>,
        mount: Option<Mount>,
    ) {
        let StepReading { time, force, runup, displacement, stops } = reading;
        let stopped = stops != self.stops;
        (self.last, self.stops) = ([force, runup, displacement], stops);
        Maximum::raise(&mut self.runup, runup, time);
        if let Some(waves) = &mut self.waves {
            waves.run_up(time, runup);
        }
        if stopped {
            self.follow(time, Push::default(), mount);
        }
        self.blows.follow(time, displacement);
        self.travel.push(time, displacement);
        self.farthest = self.farthest.max(displacement.abs());
        let drowned = self.blows.drown(time);
        if drowned {
            let first = &mut self.first;
            self.quiet.finish(|quiet| first.push_last(quiet.time, quiet.force));
            self.quiet.clear();
            self.first.interrupt();
        } else {
            if self.blows.since_audible(time).is_none() {
                self.force_raw = Some(self.force_raw.map_or(force, |raw| raw.max(force)));
            }
            if let Some(quiet) = self.quiet.push((time, force), compression) {
                self.feel(quiet, mount);
            }
        }
        if drowned || !self.listens {
            self.follow(time, Push::default(), mount);
        }
        self.first.push_motion(&reading);
    }

    /// Takes a force without its sound, and the displacements until then.
    fn feel(&mut self, quiet: Quiet, mount: Option<Mount>) {
        let Quiet { time, force, sound } = quiet;
        self.follow(time, sound, mount);
        Maximum::raise(&mut self.force, force, time);
        self.first.push_force(time, force, self.stops);
        if let Some(waves) = &mut self.waves {
            waves.press(time, force);
        }
    }

    /// Takes the wall's displacements until this time, s; `sound` is the push of sound until then.
    fn follow(&mut self, until: f64, sound: Push, mount: Option<Mount>) {
        while let Some((at, displacement)) = self.travel.next(until, sound, mount) {
            // What nothing drives back may go to either side.
            let displacement = if mount.is_none() { displacement.abs() } else { displacement };
            let before = self.displacement;
            Maximum::raise(&mut self.displacement, displacement, at);
            if self.displacement != before {
                self.kicked = self.blows.kicked();
            }
            self.first.push_travel(displacement, at);
        }
    }

    /// No more readings follow.
    pub fn finish(&mut self, mount: Option<Mount>) {
        let mut rest = Vec::new();
        self.quiet.finish(|quiet| rest.push(quiet));
        rest.into_iter().for_each(|quiet| self.feel(quiet, mount));
        self.follow(f64::INFINITY, Push::default(), mount);
    }

    /// Takes the moment about the wall's foot, over ρgh³/6, and the pressures along its face, Pa,
    /// of the last step.
    pub fn press(&mut self, time: f64, moment: f64, pressures: &[f64]) {
        if self.blows.drown(time) {
            self.pressed.interrupt();
        } else {
            self.pressed.push(time, moment, pressures, &self.first);
        }
    }

    /// Takes what the wall did in the step of the last reading. The step begins at `time` and lasts
    /// `dt`, s. `rested` says whether the wall stood before it.
    pub fn note(&mut self, time: f64, dt: f64, step: &WallStep, rested: bool) {
        if step.stop_loss > 0.0 {
            self.hit(time, dt, step.stop_speed);
        }
        if step.jumps {
            self.quiet.jump(time);
            if rested && step.travel > 0.0 {
                self.break_loose(time);
            }
        }
    }

    /// Records that friction gave way to the water. The force was then what friction bears, and at
    /// once it is less, as the wall evades it. No mean over time reaches that.
    fn break_loose(&mut self, time: f64) {
        let force = self.first.threshold;
        Maximum::raise(&mut self.force, force, time);
        self.first.bear(force, time);
        if let Some(waves) = &mut self.waves {
            waves.press(time, force);
        }
    }

    /// Records that the wall hits its stop in the step of the last reading. The step begins at
    /// `time` and lasts `dt`, s; the wall's speed is `speed`, m/s.
    pub fn hit(&mut self, time: f64, dt: f64, speed: f64) {
        let farthest = self.displacement.map_or(0.0, |farthest| farthest.value);
        self.blows.hit(Hit { time_s: time, dt, speed, runup: self.last[1] }, farthest);
    }
}

#[cfg(test)]
mod tests;
