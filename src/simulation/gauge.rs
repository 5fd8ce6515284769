//! The wave gauge: crest of the first wave that passes.

use serde::{Deserialize, Serialize};

/// The crest is past once the level has dropped this share of it.
const PASSED_DROP: f64 = 0.3;
/// Crests lower than this share of the still water depth are ripples.
const SMALLEST_CREST: f64 = 0.01;

/// Follows the surface level over still water, sample by sample.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CrestGauge {
    recent: Vec<f64>,
    crest: f64,
    passed: bool,
}

impl CrestGauge {
    /// Takes a level over still water, over h. The mean of three samples counts, so that a single
    /// noisy one does not.
    pub fn push(&mut self, level: f64) {
        self.recent.push(level);
        if self.recent.len() < 3 || self.passed {
            return;
        }
        if self.recent.len() > 3 {
            self.recent.remove(0);
        }
        let mean = self.recent.iter().sum::<f64>() / 3.0;
        self.crest = self.crest.max(mean);
        self.passed = self.crest > SMALLEST_CREST && mean < (1.0 - PASSED_DROP) * self.crest;
    }

    /// Height of the first crest over h, once one has come.
    pub fn crest(&self) -> Option<f64> {
        (self.crest > SMALLEST_CREST).then_some(self.crest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_crest_counts_not_the_reflected_one() {
        let mut gauge = CrestGauge::default();
        for k in 0..400 {
            let t = 0.005 * f64::from(k);
            let pulse = |centre: f64, height: f64| height / ((t - centre) * 5.0).cosh().powi(2);
            gauge.push(pulse(0.7, 0.5) + pulse(1.6, 0.8));
        }
        assert!((gauge.crest().unwrap() - 0.5).abs() < 1e-3);
    }
}
