//! How long a list lasts: until some pair may have come into reach unseen.

use super::strips::Strips;

/// Displacements since the last rebuild, strip by strip.
///
/// Fluid pairs can only have come closer by the *difference* of their displacements, which is
/// bounded by the spread of displacements over neighbouring strips; a wave that carries its
/// particles along together does not wear a list out. Ghosts stand still or move with their body,
/// so for them the displacement itself counts, against a wider margin.
#[derive(Debug, Clone, Default)]
pub struct Drift {
    boxes: Vec<[f64; 4]>,
}

impl Drift {
    /// Measures displacements: returns the largest relative displacement between fluid particles
    /// of strips up to `reach` apart, and the largest displacement of any particle.
    pub fn measure(
        &mut self,
        strips: &Strips,
        [x, y]: [&[f64]; 2],
        [reference_x, reference_y]: [&[f64]; 2],
        reach: usize,
    ) -> (f64, f64) {
        self.boxes.clear();
        let mut farthest: f64 = 0.0;
        for strip in 0..strips.count() {
            let mut extent = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
            for k in strips.members(strip) {
                let (dx, dy) = (x[k] - reference_x[k], y[k] - reference_y[k]);
                extent = merge(extent, [dx, dx, dy, dy]);
            }
            if extent[0] <= extent[1] {
                let far_x = extent[0].abs().max(extent[1].abs());
                let far_y = extent[2].abs().max(extent[3].abs());
                farthest = farthest.max(far_x.hypot(far_y));
            }
            self.boxes.push(extent);
        }
        let mut relative: f64 = 0.0;
        for strip in 0..self.boxes.len() {
            let last = (strip + reach).min(self.boxes.len() - 1);
            let extent = self.boxes[strip..=last].iter().copied().reduce(merge).unwrap_or_default();
            if extent[0] <= extent[1] {
                relative = relative.max((extent[1] - extent[0]).hypot(extent[3] - extent[2]));
            }
        }
        (relative, farthest)
    }
}

#[inline(always)]
fn merge(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    // Plain comparisons: min and max with NaN handling would not vectorise as well.
    let low = |p: f64, q: f64| if p < q { p } else { q };
    let high = |p: f64, q: f64| if p > q { p } else { q };
    [low(a[0], b[0]), high(a[1], b[1]), low(a[2], b[2]), high(a[3], b[3])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_common_shift_does_not_count_between_particles() {
        let x: Vec<f64> = (0..100).map(f64::from).collect();
        let y = vec![0.0; 100];
        let strips = Strips::of_sorted(&x, &y, 10.0);
        let moved: Vec<f64> = x.iter().map(|x| x + 3.0).collect();
        let mut drift = Drift::default();
        let (relative, farthest) = drift.measure(&strips, [&moved, &y], [&x, &y], 2);
        assert_eq!((relative, farthest), (0.0, 3.0));
    }

    #[test]
    fn no_pair_in_reach_moves_more_than_the_bound() {
        let x: Vec<f64> = (0..200).map(|k| f64::from(k) * 0.1).collect();
        let y: Vec<f64> = (0..200).map(|k| (f64::from(k) * 0.618).fract()).collect();
        let strips = Strips::of_sorted(&x, &y, 1.0);
        let to_x: Vec<f64> = x.iter().map(|x| x + 0.02 * (x * 3.0).sin()).collect();
        let to_y: Vec<f64> = y.iter().zip(&x).map(|(y, x)| y + 0.03 * x.cos()).collect();
        let (relative, _) = Drift::default().measure(&strips, [&to_x, &to_y], [&x, &y], 2);
        for i in 0..200_usize {
            for j in i..200.min(i + 20) {
                let dx = (to_x[j] - x[j]) - (to_x[i] - x[i]);
                let dy = (to_y[j] - y[j]) - (to_y[i] - y[i]);
                assert!(dx.hypot(dy) <= relative + 1e-12);
            }
        }
    }
}
