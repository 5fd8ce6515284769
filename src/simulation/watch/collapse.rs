//! Results of a dam break besides its probes: front, cavity, balances.

use super::cavity::Raster;
use super::{Watch, remembers};
use crate::pairs::Fluid;
use crate::scene::Frame;
use crate::simulation::named_readings::Readings;
use crate::theory::dam_break::ritter_front;

/// Smallest area of enclosed air that counts, over H². The tongue that falls from the wall encloses
/// 0.1 or more. Before that the splash of the front encloses less than 0.008.
const SMALLEST_CAVITY: f64 = 0.02;
/// The air must be enclosed for this long, over √(H/g).
const CAVITY_LASTS: f64 = 0.1;
/// Water that never moves faster than this as a whole, over √(gH), is at rest: its momentum is
/// rounding.
const STILL: f64 = 1e-6;

pub(super) struct Collapse {
    frame: Frame,
    column: f64,
    spacing: f64,
    raster: Raster,
    /// Particles from the foremost back.
    order: Vec<usize>,
    mass_at_start: f64,
    front_at_wall: Option<f64>,
    fronts: Vec<(f64, f64)>,
    cavity_since: Option<f64>,
    closure: Option<f64>,
    impulse: f64,
    largest_momentum: f64,
}

impl Collapse {
    /// For a column of this length, metres, at rest.
    pub(super) fn new(frame: Frame, column: f64, spacing: f64, fluid: &Fluid) -> Collapse {
        Collapse {
            frame,
            column,
            spacing,
            raster: Raster::new(frame.length, 4.0 * frame.depth, spacing),
            order: Vec::with_capacity(fluid.len()),
            mass_at_start: fluid.mass.iter().sum(),
            front_at_wall: None,
            fronts: Vec::new(),
            cavity_since: None,
            closure: None,
            impulse: 0.0,
            largest_momentum: 0.0,
        }
    }

    fn unit(&self) -> f64 {
        (self.frame.depth / self.frame.gravity).sqrt()
    }

    /// The foremost particle that is not a single drop (two others within two spacings), plus half
    /// a spacing.
    fn front(&mut self, fluid: &Fluid) -> f64 {
        let reach = 2.0 * self.spacing;
        let order = &mut self.order;
        order.clear();
        order.extend(0..fluid.len());
        order.sort_unstable_by(|&a, &b| {
            fluid.x[b].total_cmp(&fluid.x[a]).then(fluid.id[a].cmp(&fluid.id[b]))
        });
        let close = |j: usize, k: usize| {
            j != k && (fluid.x[j] - fluid.x[k]).hypot(fluid.y[j] - fluid.y[k]) < reach
        };
        let foremost = order.iter().copied().find(|&k| {
            let ahead = order.iter().take_while(|&&j| fluid.x[j] > fluid.x[k] - reach);
            ahead.filter(|&&j| close(j, k)).take(2).count() == 2
        });
        foremost.map_or(0.0, |k| fluid.x[k] + 0.5 * self.spacing)
    }
}

impl Watch for Collapse {
    remembers!(front_at_wall, fronts, cavity_since, closure, impulse, largest_momentum);

    /// Adds the force of the water on all walls along x over one step.
    fn push(&mut self, force: f64, dt: f64) {
        self.impulse += force * dt;
    }

    /// Takes a sample at the history's times.
    fn sample(&mut self, time: f64, fluid: &Fluid) {
        let n = fluid.len();
        self.largest_momentum = self.largest_momentum.max(momentum(fluid).abs());
        if self.front_at_wall.is_none() {
            let front = self.front(fluid);
            self.fronts.push((time, front));
            if front >= self.frame.length - self.spacing {
                self.front_at_wall = Some(time);
            }
        } else if self.closure.is_none() {
            let area = self.raster.largest_cavity(&fluid.x[..n], &fluid.y[..n]);
            if area > SMALLEST_CAVITY * self.frame.depth * self.frame.depth {
                let since = *self.cavity_since.get_or_insert(time);
                if time - since >= CAVITY_LASTS * self.unit() {
                    self.closure = Some(since);
                }
            } else {
                self.cavity_since = None;
            }
        }
    }

    /// Times over √(H/g), lengths over H, balances in percent.
    fn tell(&self, fluid: &Fluid, all: &mut Readings) {
        let unit = self.unit();
        all.tell("front_at_wall", self.front_at_wall.map(|time| time / unit), "sqrt(H/g)");
        for at in [1.0, 1.5, 2.0] {
            let front = place_at(&self.fronts, at * unit);
            let name = |what: &str| format!("{what}_at_{at}");
            all.tell(&name("front"), front.map(|x| x / self.frame.depth), "H");
            let Frame { depth, gravity, .. } = self.frame;
            let ritter = front.map(|_| ritter_front(self.column, depth, gravity, at * unit));
            all.tell(&name("ritter_front"), ritter.map(|x| x / depth), "H");
        }
        all.tell("cavity_closure", self.closure.map(|time| time / unit), "sqrt(H/g)");
        let mass: f64 = fluid.mass.iter().sum();
        all.tell("mass_gap", 100.0 * (mass / self.mass_at_start - 1.0), "%");
        let moves = self.largest_momentum > STILL * mass * self.frame.depth / unit;
        let gap = moves.then(|| (momentum(fluid) + self.impulse) / self.largest_momentum);
        let percent = gap.map(|gap| 100.0 * gap);
        all.tell("horizontal_momentum_gap", percent, "% of the largest momentum");
    }
}

/// The place of a front at this time, seconds, interpolated linearly between its samples; none
/// after the last.
fn place_at(samples: &[(f64, f64)], time: f64) -> Option<f64> {
    let after = samples.iter().position(|(sampled, _)| *sampled >= time)?;
    let (t1, x1) = samples[after];
    let (t0, x0) = samples[after.saturating_sub(1)];
    let share = if t1 > t0 { (time - t0) / (t1 - t0) } else { 1.0 };
    Some(x0 + share * (x1 - x0))
}

/// Σ m u, N s per metre of width.
fn momentum(fluid: &Fluid) -> f64 {
    fluid.mass.iter().zip(&fluid.vx).map(|(mass, velocity)| mass * velocity).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_is_told_at_the_time_asked_for() {
        let samples = [(0.0, 1.0), (0.3, 1.6), (0.5, 2.2)];
        for (time, place) in [(0.0, 1.0), (0.1, 1.2), (0.3, 1.6), (0.4, 1.9), (0.5, 2.2)] {
            assert!((place_at(&samples, time).unwrap() - place).abs() < 1e-12, "{time}");
        }
        assert_eq!(place_at(&samples, 0.51), None);
        assert_eq!(place_at(&[], 0.1), None);
    }
}
