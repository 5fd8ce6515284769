//! Particles that are too close to each other.

use crate::pairs::{Fluid, Strips};

/// Memory for the search.
#[derive(Debug, Clone, Default)]
pub struct Crowding {
    strips: Strips,
    order: Vec<u32>,
    /// Distance of each particle's nearest neighbour, metres, if that is near.
    nearest: Vec<f64>,
}

impl Crowding {
    /// The share of particles whose nearest neighbour is closer than `distance`, and the particle
    /// with the closest neighbour of all.
    pub(super) fn look(&mut self, fluid: &Fluid, distance: f64) -> (f64, usize) {
        let Crowding { strips, order, nearest } = self;
        let count = fluid.len();
        let (xs, ys) = (&fluid.x[..count], &fluid.y[..count]);
        strips.renew(xs, ys, &fluid.id[..count], distance, order);
        nearest.clear();
        nearest.resize(count, f64::INFINITY);
        for k in 0..count {
            let (x, y) = (xs[k], ys[k]);
            // The particle on the left finds the pair.
            strips.visit_box([x, x + distance], [y - distance, y + distance], |range| {
                for &other in &order[range] {
                    let other = other as usize;
                    let (dx, dy) = (xs[other] - x, ys[other] - y);
                    if other != k && dx.abs() < distance && dy.abs() < distance {
                        let apart = dx.hypot(dy);
                        nearest[k] = nearest[k].min(apart);
                        nearest[other] = nearest[other].min(apart);
                    }
                }
            });
        }
        let close = nearest.iter().filter(|&&apart| apart < distance).count();
        let closest = (0..count).min_by(|&a, &b| nearest[a].total_cmp(&nearest[b]));
        (close as f64 / count.max(1) as f64, closest.unwrap_or(0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_found_as_by_looking_at_all_of_them() {
        let noise = |k: u32, salt: u32| {
            let mixed = (k.wrapping_mul(2_654_435_761) ^ salt).wrapping_mul(2_246_822_519);
            f64::from(mixed >> 8) / f64::from(1 << 24)
        };
        let fluid = Fluid::at_rest((0..400).map(|k| [noise(k, 7), noise(k, 99), 1000.0, 1.0]));
        let mut crowding = Crowding::default();
        for distance in [0.005, 0.02, 0.05] {
            let close = |k: usize| {
                (0..fluid.len()).any(|j| {
                    j != k && (fluid.x[j] - fluid.x[k]).hypot(fluid.y[j] - fluid.y[k]) < distance
                })
            };
            let naive = (0..fluid.len()).filter(|&k| close(k)).count() as f64 / 400.0;
            assert_eq!(crowding.look(&fluid, distance).0, naive);
        }
    }
}
