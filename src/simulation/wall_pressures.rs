//! Pressures along the wall and their moment about its foot: largest running means of the whole run
//! and of its first impact.

use serde::{Deserialize, Serialize};

use super::first_impact::FirstImpact;
use super::outcome::{EnvelopeRow, Maximum};
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
    /// The moment over ρgh³/6.
    pub moment: Option<Maximum>,
    first_moment: Option<Maximum>,
    /// Largest pressures, Pa, up the wall.
    highest: Vec<f64>,
    first_highest: Vec<f64>,
    /// Number of the provisional impact to which the first ones belong.
    trial: u32,
}

impl Pressed {
    /// For this many points on the wall, and means over this many seconds.
    pub fn new(points: usize, span: f64) -> Pressed {
        Pressed {
            means: RunningMeans::new(span, points + 1),
            moment: None,
            first_moment: None,
            highest: vec![0.0; points],
            first_highest: vec![0.0; points],
            trial: 0,
        }
    }

    /// Takes a step's moment and pressures, Pa, at a time, s. The force must be taken first.
    pub fn push(&mut self, time: f64, moment: f64, pressures: &[f64], first: &FirstImpact) {
        if self.trial != first.trials {
            self.trial = first.trials;
            self.first_moment = None;
            self.first_highest.fill(0.0);
        }
        let Some((at, means)) = self.means.push(time, moment, pressures) else { return };
        let (moment, pressures) = (means[0], &means[1..]);
        Maximum::raise(&mut self.moment, moment, at);
        raise(&mut self.highest, pressures);
        if first.is_under_way() {
            Maximum::raise(&mut self.first_moment, moment, at);
            raise(&mut self.first_highest, pressures);
        }
    }

    /// Pressures in the sound of a stop do not count: the means must fill again.
    pub fn interrupt(&mut self) {
        self.means.clear();
    }

    /// Largest moment of the first impact, if there was one.
    pub fn first_moment(&self, first: &FirstImpact) -> Option<Maximum> {
        first.force().and(self.first_moment)
    }

    /// The envelope at these heights above the bed, m, as far up as the wall was wet.
    pub fn envelope(&self, heights: &[f64], first: &FirstImpact) -> Vec<EnvelopeRow> {
        let wet = self.highest.iter().rposition(|&pressure| pressure > 0.0);
        let rows = heights.iter().zip(self.highest.iter().zip(&self.first_highest));
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
mod tests {
    use super::*;

    const HEIGHTS: [f64; 4] = [0.025, 0.075, 0.125, 0.175];

    #[test]
    fn a_triangle_acts_at_a_third_of_its_height() {
        let rows = 200;
        let apart = 0.2 / f64::from(rows);
        let along = (0..rows).map(|row| (f64::from(row) + 0.5) * apart);
        let pressures: Vec<f64> = along.clone().map(|y| 9810.0 * (0.2 - y)).collect();
        let lever = Lever::of(&pressures, along, None);
        assert!((lever.arm / (0.2 / 3.0) - 1.0).abs() < 1e-4, "{lever:?}");
        assert!((lever.force / 196.2 - 1.0).abs() < 1e-12, "{lever:?}");
        assert_eq!(Lever::of(&[0.0; 4], HEIGHTS.into_iter(), None), Lever::default());
    }

    /// The story: a crest that took one row of particles more made the moment of the same water 6 %
    /// larger.
    #[test]
    fn the_last_row_presses_as_far_as_the_wall_goes() {
        let apart = 0.02;
        let lever = |height: f64| {
            let rows = (height / apart).round() as usize;
            let along = (0..rows).map(|row| (row as f64 + 0.5) * apart);
            let pressures: Vec<f64> = along.clone().map(|y| 9810.0 * (0.3 - y)).collect();
            Lever::of(&pressures, along, Some(height))
        };
        for height in [0.221, 0.2299, 0.2301, 0.239, 0.24] {
            let force = 9810.0 * (0.3 - 0.5 * height) * height;
            let moment = 9810.0 * (0.15 - height / 3.0) * height * height;
            let told = lever(height);
            assert!((told.force / force - 1.0).abs() < 0.002, "{height}: {told:?}");
            assert!((told.force * told.arm / moment - 1.0).abs() < 0.01, "{height}: {told:?}");
        }
    }

    /// A pulse that runs up the wall, with sound that a mean removes.
    fn pressures(time: f64) -> [f64; 4] {
        HEIGHTS.map(|y| {
            let bell = (-((time - 1.0 - y) / 0.1).powi(2)).exp();
            1000.0 * bell + 50.0 * (time * std::f64::consts::TAU / 0.011).sin()
        })
    }

    fn pressed() -> (Pressed, FirstImpact) {
        let (mut pressed, mut first) = (Pressed::new(4, 0.01), FirstImpact::new([1.1; 2], 0.1428));
        for step in 0..3000 {
            let time = 0.001 * f64::from(step);
            let pressures = pressures(time);
            let sum = pressures.iter().sum::<f64>();
            if time > 0.005 {
                first.push_force(time - 0.005, 1.0 + 5e-4 * sum, 0);
            }
            pressed.push(time, 1e-3 * sum, &pressures, &first);
        }
        (pressed, first)
    }

    #[test]
    fn the_envelope_holds_at_least_what_was_there_at_once() {
        let (pressed, first) = pressed();
        let envelope = pressed.envelope(&HEIGHTS, &first);
        assert_eq!(envelope.len(), 4);
        let sum: f64 = envelope.iter().map(|row| row.pressure_max_pa).sum();
        let at_once = 1e3 * pressed.moment.unwrap().value;
        assert!(sum >= at_once && sum < 1.5 * at_once, "{sum} against {at_once}");
        for row in envelope {
            assert!((row.pressure_max_pa / 1000.0 - 1.0).abs() < 0.03, "{row:?}");
            assert_eq!(row.first_pressure_max_pa, Some(row.pressure_max_pa));
        }
        assert_eq!(pressed.first_moment(&first), pressed.moment);
    }

    #[test]
    fn a_dry_wall_has_no_envelope_and_still_water_no_first_impact() {
        let (dry, none) = (Pressed::new(4, 0.01), FirstImpact::new([1.1; 2], 0.1428));
        assert!(dry.envelope(&HEIGHTS, &none).is_empty());
        let mut still = Pressed::new(4, 0.01);
        (0..50).for_each(|k| still.push(0.001 * f64::from(k), 1.0, &[3.0, 2.0, 1.0, 0.0], &none));
        let rows = still.envelope(&HEIGHTS, &none);
        assert_eq!((rows.len(), rows[0].first_pressure_max_pa), (3, None));
        assert_eq!(rows[2].pressure_max_pa, 1.0);
    }
}
