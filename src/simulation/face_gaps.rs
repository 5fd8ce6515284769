//! The two readings of the force on the wall, side by side at every sample.

use serde::{Deserialize, Serialize};

/// The gap at a largest force is that of means over this span around it, over √(h/g).
const SPAN: f64 = 0.14;
/// If the ratio of the two at the start is farther from one than this, the spacing is not the
/// reason.
const LARGEST_BIAS: f64 = 0.2;

/// The force from the pressure on the wall's face, and from the momentum that the water transfers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FaceGaps {
    span: f64,
    /// Time, s; F* of the face; F* of the momentum.
    samples: Vec<[f64; 3]>,
}

impl FaceGaps {
    /// No samples yet; √(h/g) in seconds.
    pub fn new(unit_time: f64) -> FaceGaps {
        FaceGaps { span: SPAN * unit_time, samples: Vec::new() }
    }

    /// Samples so far.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Makes room for this many more samples.
    pub fn make_room(&mut self, more: usize) {
        self.samples.reserve_exact(more);
    }

    /// Takes a sample: face and force, both as F*.
    pub fn push(&mut self, time: f64, [face, force]: [f64; 2]) {
        self.samples.push([time, face, force]);
    }

    /// The ratio of face to force at the start, where the water is at rest. It is the effect of a
    /// coarse row of points on the pressure, and no void.
    fn bias(&self) -> f64 {
        let ratio = self.samples.first().map_or(1.0, |[_, face, force]| face / force);
        if (ratio - 1.0).abs() < LARGEST_BIAS { ratio } else { 1.0 }
    }

    /// How much larger the face's force is than the momentum's, in percent of the larger of the
    /// momentum's and the hydrostatic force. It is the mean over the span around a time, s, or the
    /// nearest sample. The ratio at the start is taken out.
    pub fn around(&self, time: f64) -> f64 {
        let apart = |sample: &[f64; 3]| (sample[0] - time).abs();
        let nearest = self.samples.iter().map(apart).fold(f64::INFINITY, f64::min);
        let within = (0.5 * self.span).max(nearest);
        let near = self.samples.iter().filter(|sample| apart(sample) <= within);
        let sums =
            near.fold([0.0; 3], |[a, b, n], [_, face, force]| [a + face, b + force, n + 1.0]);
        let [face, force, hydrostatic] = sums;
        let scale = f64::max(force, hydrostatic);
        if scale > 0.0 { 100.0 * (face / self.bias() - force) / scale } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_is_that_of_the_means_around_a_time() {
        let mut gaps = FaceGaps::new(0.1428);
        assert_eq!(gaps.around(1.0), 0.0);
        gaps.push(0.0, [1.0, 1.0]);
        for k in 1..400 {
            let time = 0.005 * f64::from(k);
            // Sound of 10 % of alternating sign, and a void of 10 % before 0.5 s.
            let sound = if k % 2 == 0 { 0.2 } else { -0.2 };
            let void = if time < 0.5 { 0.2 } else { 0.0 };
            gaps.push(time, [2.0 + sound - void, 2.0]);
        }
        assert!(gaps.around(1.0).abs() < 5.0, "{}", gaps.around(1.0));
        assert!((gaps.around(0.3) + 10.0).abs() < 5.0, "{}", gaps.around(0.3));
    }

    #[test]
    fn where_samples_are_far_apart_the_nearest_one_counts() {
        let mut gaps = FaceGaps::new(0.1428);
        for (time, face) in [(0.0, 1.0), (1.0, 1.1), (2.0, 3.0)] {
            gaps.push(time, [face, 1.0]);
        }
        assert!((gaps.around(1.2) - 10.0).abs() < 1e-9);
    }

    #[test]
    fn what_the_two_differ_by_at_rest_is_no_gap() {
        let mut gaps = FaceGaps::new(0.1428);
        for k in 0..400 {
            let time = 0.005 * f64::from(k);
            let force = 1.0 + time;
            gaps.push(time, [1.046 * force, force]);
        }
        assert!(gaps.around(1.0).abs() < 1e-9);
        let mut dry = FaceGaps::new(0.1428);
        (0..400).for_each(|k| dry.push(0.005 * f64::from(k), [0.5, 1.0]));
        assert!((dry.around(1.0) + 50.0).abs() < 1e-9);
    }
}
