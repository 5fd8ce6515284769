//! When a run has no more to tell: `stop_when_settled`.

use serde::{Deserialize, Serialize};

use super::measures::Measures;
use super::outcome::Maximum;

/// A maximum stands once the energy left is this share of what it was raised with: waves grow with
/// the root of their energy, so what is to come would be below half of it.
const SHARE: f64 = 0.2;

/// A recorded maximum, and the energy that was there when it was last raised.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
struct Raised {
    value: f64,
    energy: f64,
}

/// Follows the maxima of force, runup and displacement, from one check to the next.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Settling {
    raised: [Raised; 3],
    last_energy: f64,
}

impl Settling {
    /// Takes up the maxima so far, and the energy that can still be turned into a wave, J/m. True
    /// once none of them can be passed: each was reached with five times the energy.
    pub fn settled(&mut self, measures: &Measures, energy: f64) -> bool {
        let value = |maximum: Option<Maximum>| maximum.map_or(0.0, |maximum| maximum.value);
        let values = [measures.force, measures.runup, measures.displacement].map(value);
        // The maximum may be older than this check by one.
        let with = energy.max(self.last_energy);
        self.last_energy = energy;
        for (raised, value) in self.raised.iter_mut().zip(values) {
            if value > raised.value {
                *raised = Raised { value, energy: with };
            }
        }
        let moved = self.raised.iter().filter(|raised| raised.value > 0.0);
        let mut stands = moved.map(|raised| energy < SHARE * raised.energy);
        self.raised[0].value > 0.0 && stands.all(|stands| stands)
    }
}

#[cfg(test)]
mod tests {
    use super::super::measures::Reading;
    use super::*;

    /// When a decaying oscillation of force and runup, with the energy of its envelope, is settled.
    fn settled_at(decay: f64, end: f64) -> Option<f64> {
        let mut measures = Measures::new(1.1, 0.2, 9.81);
        let mut settling = Settling::default();
        (0..(1000.0 * end) as u32).map(|k| 0.001 * f64::from(k)).find(|&time| {
            let envelope = (-decay * time).exp();
            let wave = envelope * (5.0 * time).sin();
            let reading =
                Reading { time, force: 1.0 + wave, runup: wave, displacement: None, stops: 0 };
            measures.push(reading);
            settling.settled(&measures, 40.0 * envelope * envelope)
        })
    }

    #[test]
    fn a_decaying_wave_settles_when_its_energy_is_down_to_the_share() {
        // The highest crest is the first, at t = 0.31; e^(-2 d (t - 0.31)) is the share then.
        for decay in [0.2, 0.5] {
            let expected = 0.31 - 0.5 * f64::ln(SHARE) / decay;
            let time = settled_at(decay, 20.0).unwrap();
            assert!((time - expected).abs() < 0.06, "{time} {expected}");
        }
    }

    #[test]
    fn a_wave_that_does_not_decay_never_settles() {
        assert_eq!(settled_at(0.0, 20.0), None);
        assert_eq!(settled_at(0.01, 20.0), None);
    }
}
