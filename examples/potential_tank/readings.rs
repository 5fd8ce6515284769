//! What is read off a run: measures, wave gauge, histories, what should be conserved.

use std::collections::VecDeque;

use super::law::{DEPTH, GRAVITY, STATIC_FORCE, THRESHOLD};
use super::measures::{Measures, Reading};
use super::tank::CHUNK;
use super::water::Surface;

/// The measures are fed at least so often, seconds.
const INTERVAL: f64 = 1e-4;
/// Samples are accepted so much later, seconds.
const WAITING: f64 = 0.02;
/// Place of the wave gauge, metres.
const GAUGE: f64 = 1.5;
/// The crest is past once the level has dropped this share of it.
const PASSED_DROP: f64 = 0.3;
/// Crests lower than this, over h, are ripples.
const SMALLEST_CREST: f64 = 0.01;

/// One line of a history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Seconds.
    pub time: f64,
    /// F*, R*, X*, M*.
    pub values: [f64; 4],
}

/// F*, R*, X*, M* at a time, and the rates of R* and X*, 1/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Seconds.
    pub time: f64,
    /// F*, R*, X*, M*.
    pub values: [f64; 4],
    /// Of R* and X*.
    pub rates: [f64; 2],
    /// Stops so far.
    pub stops: u32,
}

impl Sample {
    /// Values a `share` of the way to the next sample: a line for F* and M*, parabolas for R* and X*.
    fn towards(&self, next: &Sample, share: f64) -> [f64; 4] {
        let span = next.time - self.time;
        let line = |k: usize| share * (next.values[k] - self.values[k]);
        let bend = |k: usize| {
            let tangent = self.rates[k - 1] * span;
            share * (tangent + share * (next.values[k] - self.values[k] - tangent))
        };
        let [force, runup, x, moment] = self.values;
        [force + line(0), runup + bend(1), x + bend(2), moment + line(3)]
    }
}

/// Readings so far.
#[derive(Clone)]
pub struct Readings {
    /// Whether the wall may move.
    pub movable: bool,
    /// Maxima.
    pub measures: Measures,
    /// Every 0.005 s.
    pub history: Vec<Row>,
    /// Largest relative errors.
    pub volume_error: f64,
    /// Over the energy of a solitary wave of this height.
    pub energy_error: f64,
    /// How often the wall came back onto its stop.
    pub stops: u32,
    /// The stop's strongest blow: impulse of the water on the wall over ρ g h²/2 √(h/g).
    pub stop_impulse: f64,
    last: Option<Sample>,
    pending: VecDeque<Sample>,
    crest: f64,
    passed: bool,
}

impl Readings {
    /// None yet.
    pub fn new() -> Readings {
        Readings {
            movable: false,
            measures: Measures::new(THRESHOLD, DEPTH, GRAVITY),
            history: Vec::new(),
            volume_error: 0.0,
            energy_error: 0.0,
            stops: 0,
            stop_impulse: 0.0,
            last: None,
            pending: VecDeque::new(),
            crest: 0.0,
            passed: false,
        }
    }

    /// Largest level at the gauge over still water before the wave came back, over h.
    pub fn crest(&self) -> f64 {
        self.crest
    }

    /// F* of the last sample.
    pub fn force(&self) -> f64 {
        self.pending.back().map_or(1.0, |sample| sample.values[0])
    }

    /// Takes a sample and its surface. Samples wait, so that the last ones before a failure, which
    /// it may have spoilt, do not count.
    pub fn take(&mut self, sample: Sample, surface: &Surface) {
        self.pending.push_back(Sample { stops: self.stops, ..sample });
        while self.pending[0].time < sample.time - WAITING {
            self.accept();
        }
        if !self.passed {
            let level = level(surface, GAUGE) / DEPTH - 1.0;
            self.crest = self.crest.max(level);
            self.passed = self.crest > SMALLEST_CREST && level < (1.0 - PASSED_DROP) * self.crest;
        }
    }

    /// Accepts all samples that still wait.
    pub fn settle(&mut self) {
        while !self.pending.is_empty() {
            self.accept();
        }
    }

    /// Accepts the oldest sample. Between samples the measures are fed more often, so that the ends of
    /// impacts fall between steps, too.
    fn accept(&mut self) {
        let Some(sample) = self.pending.pop_front() else { return };
        let time = sample.time;
        if let Some(last) = self.last.filter(|last| last.time < time) {
            let count = ((time - last.time) / INTERVAL).ceil();
            for k in 1..count as u32 {
                let share = f64::from(k) / count;
                let at = last.time + share * (time - last.time);
                self.push(at, last.towards(&sample, share), last.stops);
            }
        }
        self.push(time, sample.values, sample.stops);
        self.last = Some(sample);
        let near = (time / CHUNK).round() * CHUNK;
        let due = (time - near).abs() < 1e-9;
        if due && self.history.last().is_none_or(|row| time - row.time > 0.5 * CHUNK) {
            self.history.push(Row { time, values: sample.values });
        }
    }

    fn push(&mut self, time: f64, values: [f64; 4], stops: u32) {
        let [force, runup, x, moment] = values;
        let displacement = self.movable.then_some(x);
        self.measures.push(Reading { time, force, runup, displacement, moment, stops });
    }

    /// Takes the relative errors of volume and energy.
    pub fn conserved(&mut self, volume: f64, energy: f64) {
        self.volume_error = self.volume_error.max(volume.abs());
        self.energy_error = self.energy_error.max(energy.abs());
    }

    /// The wall came onto its stop with this impulse of the water on it, N s per metre of width.
    pub fn stop(&mut self, impulse: f64) {
        self.stops += 1;
        let scaled = impulse / (STATIC_FORCE * (DEPTH / GRAVITY).sqrt());
        if scaled.abs() > self.stop_impulse.abs() {
            self.stop_impulse = scaled;
        }
    }
}

/// The surface's level at `place`, by the polynomial through the six nodes around it.
fn level(surface: &Surface, place: f64) -> f64 {
    let Surface { x, y, .. } = surface;
    let after = x.partition_point(|x| *x < place).clamp(3, x.len() - 3);
    let near = after - 3..after + 3;
    let weight = |k: usize| -> f64 {
        near.clone().filter(|j| *j != k).map(|j| (place - x[j]) / (x[k] - x[j])).product()
    };
    near.clone().map(|k| weight(k) * y[k]).sum()
}
