//! Particles that have come too close to each other.

use crate::particles::Fluid;

/// Room to look for them.
#[derive(Debug, Clone, Default)]
pub struct Crowding {
    /// Particles by column, then by height.
    order: Vec<(i64, f64, usize)>,
    /// How far each particle's nearest neighbour is, metres.
    nearest: Vec<f64>,
}

impl Crowding {
    /// The share of particles whose nearest neighbour is closer than `distance`, and the particle
    /// whose is the closest of all.
    pub(super) fn look(&mut self, fluid: &Fluid, distance: f64) -> (f64, usize) {
        let Crowding { order, nearest } = self;
        let count = fluid.len();
        // Sorted by column, then by y: a neighbour is in the same or the next column, not far off.
        let column = |k: usize| (fluid.x[k] / distance).floor() as i64;
        order.clear();
        order.extend((0..count).map(|k| (column(k), fluid.y[k], k)));
        order.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        nearest.clear();
        nearest.resize(count, f64::INFINITY);
        for (place, &(at, y, k)) in order.iter().enumerate() {
            let own = order[place + 1..].iter().take_while(|other| other.0 == at);
            let first = order.partition_point(|other| (other.0, other.1) < (at + 1, y - distance));
            let next = order[first..].iter().take_while(|other| other.0 == at + 1);
            let near = |other: &&(i64, f64, usize)| other.1 <= y + distance;
            for &(_, _, other) in own.take_while(near).chain(next.take_while(near)) {
                let (dx, dy) = (fluid.x[other] - fluid.x[k], fluid.y[other] - y);
                let apart = dx.hypot(dy);
                nearest[k] = nearest[k].min(apart);
                nearest[other] = nearest[other].min(apart);
            }
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
