//! The first impact of a wave: onset, start and end, and the maxima in between.

use serde::{Deserialize, Serialize};

use super::force_rise::Onrush;
use super::outcome::Maximum;
use super::peak::Peak;

/// F* must stay above or below a bound for this time to count, over √(h/g): 0.02 s at h = 0.2 m.
const PERSISTENCE: f64 = 0.14;
/// The first impact begins once F* has stayed above this. It is over once F* stays below.
const IMPACT_FORCE: f64 = 1.15;
/// A stop ends the first impact only after X* has exceeded this.
const IMPACT_TRAVEL: f64 = 0.01;
/// Samples of the force's rise are at least this far apart, over √(h/g).
const SHORT: f64 = 0.0175;

/// One step's readings, non-dimensional: F*, R*, X*, and the wall's count of stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReading {
    /// Seconds since the paddle's start.
    pub time: f64,
    /// F*.
    pub force: f64,
    /// R*.
    pub runup: f64,
    /// X*; 0 for a fixed wall, as for one that has not moved.
    pub displacement: f64,
    /// Stops so far.
    pub stops: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Stage {
    Before,
    /// F* has exceeded the bound, but has not stayed above it yet. All readings are provisional.
    Trial {
        above_since: Option<f64>,
    },
    On,
    Over,
}

/// Maxima and peaks since the impact's start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Readings {
    force: Option<Maximum>,
    runup: Option<Maximum>,
    displacement: Option<Maximum>,
    force_peak: Peak,
    runup_peak: Peak,
    /// Number of stops that do not end the impact.
    stops: u32,
}

impl Readings {
    fn new(stops: u32) -> Readings {
        Readings {
            force: None,
            runup: None,
            displacement: None,
            force_peak: Peak::new(1.0),
            runup_peak: Peak::new(0.0),
            stops,
        }
    }
}

/// The first impact so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FirstImpact {
    /// F* above which the wall moves.
    pub threshold: f64,
    /// F* below which the impact is over.
    let_go: f64,
    persistence: f64,
    stage: Stage,
    above_since: Option<f64>,
    below_since: Option<f64>,
    readings: Readings,
    onset: Option<f64>,
    onrush: Onrush,
    /// How many impacts have begun provisionally.
    pub trials: u32,
}

impl FirstImpact {
    /// `threshold` is the F* above which the wall moves, `let_go` that below which an impact is
    /// over; √(h/g) in seconds.
    pub fn new([threshold, let_go]: [f64; 2], unit_time: f64) -> FirstImpact {
        FirstImpact {
            threshold,
            let_go,
            persistence: PERSISTENCE * unit_time,
            stage: Stage::Before,
            above_since: None,
            below_since: None,
            readings: Readings::new(0),
            onset: None,
            onrush: Onrush::new(IMPACT_FORCE.max(let_go), SHORT * unit_time),
            trials: 0,
        }
    }

    /// Takes the running mean of F* at a time, s, and the number of stops so far.
    pub fn push_force(&mut self, at: f64, mean: f64, stops: u32) {
        let persistence = self.persistence;
        if mean > self.threshold {
            let since = *self.above_since.get_or_insert(at);
            if self.onset.is_none() && at - since >= persistence {
                self.onset = Some(since);
            }
        } else {
            self.above_since = None;
        }
        if mean > self.let_go {
            self.below_since = None;
        } else {
            self.below_since.get_or_insert(at);
        }
        let above = mean > IMPACT_FORCE.max(self.let_go);
        if self.stage == Stage::Before && above {
            self.stage = Stage::Trial { above_since: Some(at) };
            self.readings = Readings::new(stops);
            self.onrush.begin();
            self.trials += 1;
        }
        if let Stage::Trial { above_since } = &mut self.stage {
            if !above {
                *above_since = None;
            } else if at - *above_since.get_or_insert(at) >= persistence {
                self.stage = Stage::On;
            }
        }
        if self.stage != Stage::Over {
            self.onrush.push(at, mean, self.is_under_way());
        }
        if self.is_under_way() {
            Maximum::raise(&mut self.readings.force, mean, at);
            self.readings.force_peak.push(mean);
            // Noise may lower the force while the water at the wall still climbs.
            let low = self.below_since.is_some_and(|since| at - since >= persistence);
            if low && (self.stage != Stage::On || self.readings.runup_peak.closed) {
                self.end();
            }
        }
    }

    /// Takes an F* that is known for a moment, s, which its running mean misses. It is no peak of
    /// that mean.
    pub fn bear(&mut self, force: f64, at: f64) {
        if self.is_under_way() {
            Maximum::raise(&mut self.readings.force, force, at);
        }
    }

    /// Takes X* at a time, s.
    pub fn push_travel(&mut self, displacement: f64, time: f64) {
        if self.is_under_way() {
            Maximum::raise(&mut self.readings.displacement, displacement, time);
        }
    }

    /// Takes a step's R*. Ends the impact at a stop.
    pub fn push_motion(&mut self, reading: &StepReading) {
        if !self.is_under_way() {
            return;
        }
        let readings = &mut self.readings;
        Maximum::raise(&mut readings.runup, reading.runup, reading.time);
        readings.runup_peak.push(reading.runup);
        let travelled = readings.displacement.is_some_and(|m| m.value > IMPACT_TRAVEL);
        if !travelled {
            // Touches of a stiff wall that has hardly moved do not count.
            readings.stops = reading.stops;
        } else if reading.stops > readings.stops {
            self.end();
        }
    }

    /// Takes the mean of F* just before an impact on the stop. Its part of sound is not known as it
    /// is at other times. So it counts only for the impulse.
    pub fn push_last(&mut self, at: f64, mean: f64) {
        if self.is_under_way() {
            self.onrush.add(at, mean);
        }
    }

    /// Records that the sound of an impact on the stop hides the force.
    pub fn interrupt(&mut self) {
        self.onrush.interrupt();
    }

    /// Ends the impact. If it was still provisional, it was only a short rise.
    fn end(&mut self) {
        self.stage = if self.stage == Stage::On { Stage::Over } else { Stage::Before };
    }

    /// Whether it is on, or provisional.
    pub fn is_under_way(&self) -> bool {
        matches!(self.stage, Stage::Trial { .. } | Stage::On)
    }

    fn counted(&self) -> Option<&Readings> {
        matches!(self.stage, Stage::On | Stage::Over).then_some(&self.readings)
    }

    /// Largest F*, of the running mean.
    pub fn force(&self) -> Option<Maximum> {
        self.counted()?.force
    }

    /// Largest R*.
    pub fn runup(&self) -> Option<Maximum> {
        self.counted()?.runup
    }

    /// Largest X*.
    pub fn displacement(&self) -> Option<Maximum> {
        self.counted()?.displacement
    }

    /// F* of the first peak.
    pub fn force_peak(&self) -> Option<f64> {
        self.counted()?.force_peak.value()
    }

    /// R* of the first peak.
    pub fn runup_peak(&self) -> Option<f64> {
        self.counted()?.runup_peak.value()
    }

    /// ∫ (F* - 1) dt, s.
    pub fn impulse(&self) -> Option<f64> {
        self.counted().map(|_| self.onrush.impulse())
    }

    /// The time in which F* - 1 rose from 10 to 90 % of its largest value, s.
    pub fn rise_time(&self) -> Option<f64> {
        self.onrush.rise_time(self.force()?)
    }

    /// When F > F_th first lasted long enough, seconds.
    pub fn onset(&self) -> Option<f64> {
        self.onset
    }
}
