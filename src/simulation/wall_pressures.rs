//! Pressures along the wall and their moment about its foot: largest running means of the whole run
//! and of its first impact.

use serde::{Deserialize, Serialize};

use super::first_impact::FirstImpact;
use super::outcome::{EnvelopeRow, Maximum};
use super::steady::Steady;
use super::window::RunningMeans;

/// The sums of a step's pressures.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Lever {
    /// Distance along the face from the foot to where the force acts, metres.
    pub arm: f64,
    /// Σ p Δs over the face, N per metre of width.
    pub force: f64,
}

impl Lever {
    /// From pressures, Pa, at equidistant points; `along` has their distances from the foot,
    /// metres. The face may have an `end`: up to there the last two points tell the pressure.
    pub fn of(
        pressures: &[f64],
        along: impl Iterator<Item = f64> + Clone,
        end: Option<f64>,
    ) -> Lever {
        let mut first = along.clone().take(2);
        let apart = first.next().zip(first.next()).map_or(0.0, |(a, b)| b - a);
        let [mut force, mut moment] = pressures.iter().zip(along.clone()).fold(
            [0.0; 2],
            |[force, moment]: [f64; 2], (pressure, along)| {
                [force + pressure, moment + pressure * along]
            },
        );
        if let (Some(end), [.., before, pressure]) = (end, pressures) {
            let last = along.last().unwrap_or(0.0);
            let (more, middle) = ((end - last) / apart - 0.5, 0.5 * (last + 0.5 * apart + end));
            let there = pressure + (pressure - before) * (middle - last) / apart;
            force += more * there.max(0.0);
            moment += more * there.max(0.0) * middle;
        }
        let arm = if force > 0.0 { moment / force } else { 0.0 };
        Lever { arm, force: force * apart }
    }
}

/// Largest pressures and moments so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pressed {
    /// Running means of the moment and of the pressures together.
    means: RunningMeans,
    /// Smooths them, where the wall may swing.
    steady: Option<Steady>,
    largest: Largest,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Largest {
    /// The moment over ρgh³/6.
    moment: Option<Maximum>,
    first_moment: Option<Maximum>,
    /// Largest pressures, Pa, up the wall.
    highest: Vec<f64>,
    first_highest: Vec<f64>,
    /// Number of the provisional impact to which the first ones belong.
    trial: u32,
}

impl Largest {
    /// Takes the moment and the pressures together.
    fn take(&mut self, at: f64, means: &[f64], first: &FirstImpact) {
        let (moment, pressures) = (means[0], &means[1..]);
        Maximum::raise(&mut self.moment, moment, at);
        raise(&mut self.highest, pressures);
        if first.is_under_way() {
            Maximum::raise(&mut self.first_moment, moment, at);
            raise(&mut self.first_highest, pressures);
        }
    }
}

impl Pressed {
    /// For this many points on the wall, and means over this many seconds.
    pub fn new(points: usize, span: f64) -> Pressed {
        let largest = Largest {
            moment: None,
            first_moment: None,
            highest: vec![0.0; points],
            first_highest: vec![0.0; points],
            trial: 0,
        };
        Pressed { means: RunningMeans::new(span, points + 1), steady: None, largest }
    }

    /// Smooths what follows; √(h/g) in seconds.
    pub fn smooth(&mut self, unit_time: f64) {
        self.steady = Some(Steady::new(self.largest.highest.len() + 1, unit_time));
    }

    /// Takes a step's moment and pressures, Pa, at a time, s. The force must be taken first.
    /// Those of a `stiff` wall are smoothed.
    pub fn push(
        &mut self,
        time: f64,
        moment: f64,
        pressures: &[f64],
        (first, stiff): (&FirstImpact, bool),
    ) {
        let largest = &mut self.largest;
        if largest.trial != first.trials {
            largest.trial = first.trials;
            largest.first_moment = None;
            largest.first_highest.fill(0.0);
        }
        let Some((at, means)) = self.means.push(time, moment, pressures) else { return };
        match &mut self.steady {
            Some(steady) => {
                steady.push(Some((at, means[0], &means[1..])));
                steady.each(stiff, |at, smooth| largest.take(at, smooth, first));
            }
            None => largest.take(at, means, first),
        }
    }

    /// Pressures in the sound of a stop do not count: the means must fill again.
    pub fn interrupt(&mut self, first: &FirstImpact) {
        self.means.clear();
        self.finish(first);
    }

    /// No pressures follow.
    pub fn finish(&mut self, first: &FirstImpact) {
        let Pressed { steady, largest, .. } = self;
        let Some(steady) = steady else { return };
        steady.push(None);
        steady.each(false, |at, means| largest.take(at, means, first));
    }

    /// Largest moment of the whole run, over ρgh³/6.
    pub fn moment(&self) -> Option<Maximum> {
        self.largest.moment
    }

    /// Largest moment of the first impact, if there was one.
    pub fn first_moment(&self, first: &FirstImpact) -> Option<Maximum> {
        first.force().and(self.largest.first_moment)
    }

    /// The envelope at these heights above the bed, m, as far up as the wall was wet.
    pub fn envelope(&self, heights: &[f64], first: &FirstImpact) -> Vec<EnvelopeRow> {
        let Largest { highest, first_highest, .. } = &self.largest;
        let wet = highest.iter().rposition(|&pressure| pressure > 0.0);
        let rows = heights.iter().zip(highest.iter().zip(first_highest));
        let row = |(&height_m, (&pressure_max_pa, &of_first)): (&f64, (&f64, &f64))| EnvelopeRow {
            height_m,
            pressure_max_pa,
            first_pressure_max_pa: first.force().map(|_| of_first),
        };
        rows.take(wet.map_or(0, |wet| wet + 1)).map(row).collect()
    }
}

fn raise(highest: &mut [f64], values: &[f64]) {
    for (highest, value) in highest.iter_mut().zip(values) {
        *highest = highest.max(*value);
    }
}

#[cfg(test)]
mod tests;
