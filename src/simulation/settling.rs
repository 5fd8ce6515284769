//! When a run can end early: `stop_when_settled`.

use serde::{Deserialize, Serialize};

use super::measures::Measures;

/// A wall that cannot move farther than this, over the still water's depth, counts as one at rest.
/// When it is let go and comes back, it adds almost no energy to the water.
const STANDS_WITHIN: f64 = 1e-3;
/// Largest value of 4 tanh(u)/√(π u), at sinh 2u = 4u. Of half standing waves of the same energy,
/// that with a length of three depths has the largest force.
const PRESSING: f64 = 1.7225;

/// The recent liveliness of the water: its largest kinetic energy over the last one to two spans.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Liveliness {
    since: f64,
    now: f64,
    before: Option<f64>,
}

impl Liveliness {
    /// Records a kinetic energy, J/m, at a time, s; `span` in s.
    pub fn note(&mut self, time: f64, kinetic: f64, span: f64) {
        if self.now == 0.0 {
            self.since = time;
        } else if time - self.since >= span {
            *self = Liveliness { since: time, now: 0.0, before: Some(self.now) };
        }
        self.now = self.now.max(kinetic);
    }

    /// Upper bound of the water's energy, J/m: twice the largest kinetic energy. Half of the energy
    /// of a travelling wave is kinetic; that of a standing wave is all kinetic at times. `None`
    /// before a whole span has passed.
    ///
    /// It does not use the level of still water, which falls during a coarse run.
    pub fn energy(&self) -> Option<f64> {
        self.before.map(|before| 2.0 * before.max(self.now))
    }
}

/// Upper bounds of what can still happen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prospect {
    /// R*.
    runup: f64,
    /// F*.
    force: f64,
    /// X*; infinite for a wall that may move far.
    displacement: f64,
}

impl Prospect {
    /// For water with an energy E above that of still water, `energy` = E/(ρ g h³), at a wall on
    /// its stop. `wall` is F_th and k h, both over the hydrostatic force, if the wall can move.
    ///
    /// All the energy is assumed to meet in one crest at the wall. This is half a standing wave of
    /// any length w from the water's depth upwards, with E = ¼ ρ g A² w and the force ρ g A tanh(π
    /// h/w) w/π. The shortest rises highest, R* = 2 √(E/(ρ g h³)). That of three depths has the
    /// largest force: with a still column for the first crest, F* = 1 + 1.72 √(E/(ρ g h³)) + R*².
    ///
    /// A force below the threshold moves nothing. Above it a stiff wall goes at most twice as far
    /// as its place of rest. Any other wall may move far. The parts that hold it against the water
    /// until it is back then add energy to the water, so there is no bound.
    pub fn of(energy: f64, wall: Option<[f64; 2]>) -> Prospect {
        let root = energy.max(0.0).sqrt();
        let runup = 2.0 * root;
        let force = 1.0 + PRESSING * root + runup * runup;
        let displacement = match wall {
            Some([threshold, stiffness]) if force > threshold => {
                let far = 2.0 * (force - threshold) / stiffness;
                if far < STANDS_WITHIN { far } else { f64::INFINITY }
            }
            _ => 0.0,
        };
        Prospect { runup, force, displacement }
    }

    /// Whether a wall with this largest X* so far counts as one at rest.
    pub fn stood(displacement: f64) -> bool {
        displacement < STANDS_WITHIN
    }

    /// Whether no maximum so far can be exceeded, those of the first impact included.
    pub fn leaves(&self, measures: &Measures) -> bool {
        let stays = |maximum: Option<super::Maximum>, most: f64| {
            most == 0.0 || maximum.is_some_and(|maximum| most < maximum.value)
        };
        !measures.first.is_under_way()
            && stays(measures.force, self.force)
            && stays(measures.runup, self.runup)
            && stays(measures.displacement, self.displacement)
    }
}

#[cfg(test)]
mod tests {
    use super::super::blows::Acoustics;
    use super::super::first_impact::StepReading;
    use super::*;

    const WATER: Acoustics =
        Acoustics { depth: 0.2, depth_at_wall: 0.2, gravity: 9.81, sound_speed: None };

    /// A wave of F* = 2, R* = 0.5, X* = `x` that has come and gone.
    fn after_a_wave(x: f64) -> Measures {
        let mut measures = Measures::new([1.1; 2], WATER, None, 0);
        for k in 0..2000 {
            let bell = (-(f64::from(k) * 0.005 - 3.0).powi(2)).exp();
            let reading = StepReading {
                time: f64::from(k) * 0.005,
                force: 1.0 + bell,
                runup: 0.5 * bell,
                displacement: x * bell,
                stops: 0,
            };
            measures.push(reading, None, None);
        }
        measures
    }

    #[test]
    fn standing_and_running_waves_have_no_more_energy_than_their_liveliness_says() {
        // Energy 3: a standing wave whose kinetic energy peaks once per span, and a running one.
        let standing = |time: f64| 3.0 * (std::f64::consts::PI * time / 1.5).sin().powi(2);
        for kinetic in [&standing as &dyn Fn(f64) -> f64, &|_| 1.5] {
            let mut liveliness = Liveliness::default();
            for k in 0..400 {
                let time = 0.02 * f64::from(k);
                liveliness.note(time, kinetic(time), 1.5);
                match liveliness.energy() {
                    None => assert!(time < 1.55, "{time}"),
                    Some(energy) => assert!((2.99..6.01).contains(&energy), "{time} {energy}"),
                }
            }
        }
        // Water at rest is recognised after two spans.
        let mut liveliness = Liveliness::default();
        for k in 0..400 {
            let time = 0.02 * f64::from(k);
            liveliness.note(time, if time < 2.0 { 1.0 } else { 0.1 }, 1.5);
        }
        assert_eq!(liveliness.energy(), Some(0.2));
    }

    #[test]
    fn a_standing_wave_of_any_length_stays_below_the_bound() {
        // E = ¼ ρ g A² L of half a wave in a basin of length L, in depths.
        for length in [1.0, 2.0, 12.5] {
            for amplitude in [0.01, 0.1, 0.5] {
                let energy = 0.25 * amplitude * amplitude * length;
                let prospect = Prospect::of(energy, None);
                assert!(prospect.runup >= amplitude * (1.0 - 1e-12), "{length} {amplitude}");
                let wave = std::f64::consts::PI / length;
                let linear = 1.0 + 2.0 * amplitude * wave.tanh() / wave;
                assert!(prospect.force >= linear, "{length} {amplitude}");
            }
        }
    }

    #[test]
    fn a_fixed_wall_is_done_once_a_crest_of_all_that_is_left_stays_below_the_maxima() {
        let measures = after_a_wave(0.0);
        // R* < 0.5, where F* < 1.7.
        let edge = 0.25 * 0.5 * 0.5;
        assert!(Prospect::of(0.99 * edge, None).leaves(&measures));
        assert!(!Prospect::of(1.02 * edge, None).leaves(&measures));
    }

    #[test]
    fn a_soft_wall_is_done_only_once_it_cannot_be_moved() {
        let (measures, soft, stiff) = (after_a_wave(0.5), [1.1, 0.3], [1.1, 1e4]);
        // F* = 1.1.
        let edge = (((PRESSING * PRESSING + 1.6).sqrt() - PRESSING) / 8.0).powi(2);
        assert!(Prospect::of(0.99 * edge, Some(soft)).leaves(&measures));
        assert!(!Prospect::of(1.01 * edge, Some(soft)).leaves(&measures));
        assert!(Prospect::of(10.0 * edge, Some(stiff)).leaves(&measures));
        assert!(!Prospect::of(10.0 * edge, Some(stiff)).leaves(&after_a_wave(1e-5)));
    }

    #[test]
    fn nothing_ends_within_the_first_impact() {
        let mut measures = Measures::new([1.1; 2], WATER, None, 0);
        for k in 0..200 {
            let time = 0.005 * f64::from(k);
            let reading = StepReading { time, force: 1.6, runup: 0.3, displacement: 0.0, stops: 0 };
            measures.push(reading, None, None);
        }
        assert!(!Prospect::of(0.0, None).leaves(&measures));
    }
}
