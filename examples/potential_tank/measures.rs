//! Maxima of a run, of its first impact and of its first peak, gathered step by step.
//!
//! Written apart from the program's own readings: there is no sound here to be kept out of them.

use seawall::simulation::Maximum;

use super::window::RunningMean;

/// F* must last this long above or below a bound to count, over √(h/g): 0.02 s at h = 0.2 m.
const PERSISTENCE: f64 = 0.14;
/// The first impact is on once F* has passed this, and the threshold.
const IMPACT_FORCE: f64 = 1.15;
/// A stop ends the first impact only after X* has exceeded this.
const IMPACT_TRAVEL: f64 = 0.01;
/// A peak is over when it has dropped by this share.
const PEAK_DROP: f64 = 0.10;
/// Span of the force's running mean over √(h/g).
const MEAN_SPAN: f64 = 0.07;

/// One step's readings, non-dimensional: F*, R*, X*, M*, and the wall's count of stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Seconds since the paddle's start.
    pub time: f64,
    /// F*.
    pub force: f64,
    /// R*.
    pub runup: f64,
    /// X*; `None` for a fixed wall.
    pub displacement: Option<f64>,
    /// M*, the moment about the foot over that of still water.
    pub moment: f64,
    /// Stops so far.
    pub stops: u32,
}

/// Where the first impact stands.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Impact {
    Before,
    On { stops: u32 },
    Over,
}

/// Running maximum that is closed once the quantity has dropped 10 % of its height above `base`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Peak {
    base: f64,
    highest: f64,
    closed: bool,
}

impl Peak {
    fn new(base: f64) -> Peak {
        Peak { base, highest: f64::NEG_INFINITY, closed: false }
    }

    fn push(&mut self, value: f64) {
        if self.closed {
            return;
        }
        self.highest = self.highest.max(value);
        let height = self.highest - self.base;
        self.closed = height > 0.0 && value - self.base < (1.0 - PEAK_DROP) * height;
    }

    fn value(&self) -> Option<f64> {
        self.highest.is_finite().then_some(self.highest)
    }
}

/// Maxima so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Measures {
    threshold: f64,
    persistence: f64,
    mean: RunningMean,
    mean_moment: RunningMean,
    impact: Impact,
    above_since: Option<f64>,
    below_since: Option<f64>,
    force_peak: Peak,
    runup_peak: Peak,
    /// Over the whole run: F* (running mean), R*, X*.
    pub force: Option<Maximum>,
    /// R*.
    pub runup: Option<Maximum>,
    /// X*.
    pub displacement: Option<Maximum>,
    /// Over the first impact.
    pub first_force: Option<Maximum>,
    /// R* over the first impact.
    pub first_runup: Option<Maximum>,
    /// X* over the first impact.
    pub first_displacement: Option<Maximum>,
    /// M* over the first impact (running mean).
    pub first_moment: Option<Maximum>,
    /// Largest F* of a single step.
    pub force_raw: f64,
    /// When F > F_th first lasted.
    pub onset: Option<f64>,
    /// The last reading's F*, R*, X*.
    pub last: [f64; 3],
}

fn raise(maximum: &mut Option<Maximum>, value: f64, time_s: f64) {
    if maximum.is_none_or(|m| value > m.value) {
        *maximum = Some(Maximum { value, time_s });
    }
}

impl Measures {
    /// For F_threshold over the hydrostatic force, still water depth (m) and gravity (m/s²).
    pub fn new(threshold_ratio: f64, depth: f64, gravity: f64) -> Measures {
        let mean = RunningMean::new(MEAN_SPAN * (depth / gravity).sqrt());
        Measures {
            threshold: threshold_ratio,
            persistence: PERSISTENCE * (depth / gravity).sqrt(),
            mean_moment: mean.clone(),
            mean,
            impact: Impact::Before,
            above_since: None,
            below_since: None,
            force_peak: Peak::new(1.0),
            runup_peak: Peak::new(0.0),
            force: None,
            runup: None,
            displacement: None,
            first_force: None,
            first_runup: None,
            first_displacement: None,
            first_moment: None,
            force_raw: f64::NEG_INFINITY,
            onset: None,
            last: [0.0; 3],
        }
    }

    /// Takes one step's readings.
    pub fn push(&mut self, reading: Reading) {
        let Reading { time, force, runup, displacement, moment, stops } = reading;
        self.last = [force, runup, displacement.unwrap_or(0.0)];
        self.force_raw = self.force_raw.max(force);
        raise(&mut self.runup, runup, time);
        if let Some(x) = displacement {
            raise(&mut self.displacement, x, time);
        }
        if let Some((at, mean)) = self.mean.push(time, force) {
            raise(&mut self.force, mean, at);
            self.follow_impact(at, mean, &reading);
        }
        let moment = self.mean_moment.push(time, moment);
        if matches!(self.impact, Impact::On { .. }) {
            if let Some((at, mean)) = moment {
                raise(&mut self.first_moment, mean, at);
            }
            raise(&mut self.first_runup, runup, time);
            self.runup_peak.push(runup);
            if let Some(x) = displacement {
                raise(&mut self.first_displacement, x, time);
            }
            self.end_impact(stops);
        }
    }

    /// Onset, start of the first impact, its force.
    fn follow_impact(&mut self, at: f64, mean: f64, reading: &Reading) {
        if mean > self.threshold {
            self.below_since = None;
            let since = *self.above_since.get_or_insert(at);
            if self.onset.is_none() && at - since >= self.persistence {
                self.onset = Some(since);
            }
        } else {
            self.above_since = None;
            self.below_since.get_or_insert(at);
        }
        if self.impact == Impact::Before && mean > self.threshold.max(IMPACT_FORCE) {
            self.impact = Impact::On { stops: reading.stops };
        }
        if matches!(self.impact, Impact::On { .. }) {
            raise(&mut self.first_force, mean, at);
            self.force_peak.push(mean);
            if self.below_since.is_some_and(|since| at - since >= self.persistence) {
                self.impact = Impact::Over;
            }
        }
    }

    fn end_impact(&mut self, stops: u32) {
        if let Impact::On { stops: before } = &mut self.impact {
            let travelled = self.first_displacement.is_some_and(|m| m.value > IMPACT_TRAVEL);
            if !travelled {
                *before = stops; // touches of a stiff wall that has hardly moved do not count
            } else if stops > *before {
                self.impact = Impact::Over;
            }
        }
    }

    /// F* of the first peak.
    pub fn force_peak(&self) -> Option<f64> {
        self.force_peak.value()
    }

    /// R* of the first peak.
    pub fn runup_peak(&self) -> Option<f64> {
        self.runup_peak.value()
    }
}
