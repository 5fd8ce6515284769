//! The surface of a flume and how it moves: η and φ at columns that go with the paddle.

use seawall::body::PaddleLaw;
use seawall::boundary::Profile;

use super::columns::Columns;

/// Columns give way to the paddle over this many depths, or up to the wall.
const GIVES_WAY: f64 = 15.0;
/// A sawtooth loses this share in a step.
const SMOOTHING: f64 = 0.1;

/// The water's surface at the columns.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// Metres over the datum.
    pub level: Vec<f64>,
    /// Φ, m²/s.
    pub potential: Vec<f64>,
}

/// Water between a paddle and a wall.
pub struct Flume<'a> {
    pub paddle: &'a dyn PaddleLaw,
    pub bed: Option<&'a Profile>,
    pub depth: f64,
    pub gravity: f64,
    pub length: f64,
    pub columns: usize,
    pub layers: usize,
    pub time: f64,
    pub surface: Surface,
}

impl Flume<'_> {
    /// Puts the water to rest.
    pub fn rest(&mut self) {
        let count = self.columns + 1;
        self.surface = Surface { level: vec![self.depth; count], potential: vec![0.0; count] };
    }

    /// Share of the paddle's motion that a column takes, by its place at rest.
    fn share(&self, rest: f64) -> f64 {
        (1.0 - rest / self.length.min(GIVES_WAY * self.depth)).max(0.0).powi(2)
    }

    fn at_rest(&self, column: usize) -> f64 {
        self.length * column as f64 / self.columns as f64
    }

    fn places(&self, time: f64) -> Vec<f64> {
        let offset = self.paddle.motion(time).offset;
        (0..=self.columns)
            .map(|column| self.at_rest(column))
            .map(|rest| rest + offset * self.share(rest))
            .collect()
    }

    fn bed_at(&self, x: &[f64]) -> Vec<f64> {
        x.iter().map(|x| self.bed.map_or(0.0, |bed| bed.height(x.max(0.0)))).collect()
    }

    fn rates(&self, surface: &Surface, time: f64) -> Surface {
        let motion = self.paddle.motion(time);
        let x = self.places(time);
        let bed = self.bed_at(&x);
        let columns = Columns { x: &x, bed: &bed, top: &surface.level, layers: self.layers };
        let flow = columns.outflow(&surface.potential, motion.velocity);
        let rise = per_length(&x, flow);
        let (steepness, along) = (slope(&x, &surface.level), slope(&x, &surface.potential));
        let mut rates = Surface::default();
        for column in 0..x.len() {
            let (e, p, g) = (steepness[column], along[column], rise[column]);
            let moves = motion.velocity * self.share(self.at_rest(column));
            let upward = (g + e * p) / (1.0 + e * e);
            rates.level.push(g + moves * e);
            rates.potential.push(
                -self.gravity * (surface.level[column] - self.depth) - 0.5 * p * p
                    + 0.5 * upward * upward * (1.0 + e * e)
                    + moves * p,
            );
        }
        rates
    }

    /// A Runge-Kutta step of fourth order.
    pub fn step(&mut self, dt: f64) {
        let (from, time) = (&self.surface, self.time);
        let first = self.rates(from, time);
        let second = self.rates(&from.moved(&first, 0.5 * dt), time + 0.5 * dt);
        let third = self.rates(&from.moved(&second, 0.5 * dt), time + 0.5 * dt);
        let fourth = self.rates(&from.moved(&third, dt), time + dt);
        let mut next = from
            .moved(&first, dt / 6.0)
            .moved(&second, dt / 3.0)
            .moved(&third, dt / 3.0)
            .moved(&fourth, dt / 6.0);
        smooth(&mut next.level);
        smooth(&mut next.potential);
        self.surface = next;
        self.time += dt;
    }

    /// The largest slope of the surface.
    pub fn steepest(&self) -> f64 {
        let slopes = slope(&self.places(self.time), &self.surface.level);
        slopes.into_iter().fold(0.0, |most: f64, s| if s.is_nan() { s } else { most.max(s.abs()) })
    }

    /// The surface over still water at a place, metres.
    pub fn level(&self, x: f64) -> f64 {
        let places = self.places(self.time);
        let after = places.partition_point(|at| *at < x).clamp(1, places.len() - 1);
        let (from, to) = (places[after - 1], places[after]);
        let share = (x - from) / (to - from);
        let level = &self.surface.level;
        level[after - 1] + share * (level[after] - level[after - 1]) - self.depth
    }

    /// Water that was won, as a share of all.
    pub fn volume_error(&self) -> f64 {
        let area = |x: &[f64], level: &[f64]| -> f64 {
            let bed = self.bed_at(x);
            let height = |k: usize| level[k] - bed[k];
            (1..x.len()).map(|k| 0.5 * (x[k] - x[k - 1]) * (height(k) + height(k - 1))).sum()
        };
        let rest: Vec<f64> = (0..=self.columns).map(|column| self.at_rest(column)).collect();
        let before = area(&rest, &vec![self.depth; rest.len()]);
        area(&self.places(self.time), &self.surface.level) / before - 1.0
    }
}

impl Surface {
    fn moved(&self, rates: &Surface, dt: f64) -> Surface {
        let add = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + dt * b).collect();
        Surface {
            level: add(&self.level, &rates.level),
            potential: add(&self.potential, &rates.potential),
        }
    }
}

/// From integrals with the columns' hats to values at the columns: M v = f, M the mass matrix of the hats.
fn per_length(x: &[f64], mut flow: Vec<f64>) -> Vec<f64> {
    let count = x.len();
    let gap = |k: usize| x[k] - x[k - 1];
    let mut above = vec![0.0; count];
    for k in 0..count {
        let (left, right) =
            (if k > 0 { gap(k) } else { 0.0 }, if k + 1 < count { gap(k + 1) } else { 0.0 });
        let mut middle = (left + right) / 3.0;
        if k > 0 {
            middle -= left / 6.0 * above[k - 1];
            flow[k] -= left / 6.0 * flow[k - 1];
        }
        above[k] = right / 6.0 / middle;
        flow[k] /= middle;
    }
    for k in (0..count - 1).rev() {
        flow[k] -= above[k] * flow[k + 1];
    }
    flow
}

/// d/dx of second order, to one side at the ends.
fn slope(x: &[f64], values: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let through = |at: usize, k: usize| {
        let (left, right) = (x[k] - x[k - 1], x[k + 1] - x[k]);
        let (s0, s1) = ((values[k] - values[k - 1]) / left, (values[k + 1] - values[k]) / right);
        let bend = (s1 - s0) / (left + right);
        s0 + bend * (2.0 * x[at] - x[k - 1] - x[k])
    };
    (0..=last).map(|at| through(at, at.clamp(1, last - 1))).collect()
}

/// Takes [`SMOOTHING`] of a sawtooth out by a sixth difference, where it fits: at a moving paddle the surface is tilted.
fn smooth(values: &mut [f64]) {
    let from = values.to_vec();
    for (value, w) in values[3..].iter_mut().zip(from.windows(7)) {
        let seen = 20.0 * w[3] - 15.0 * (w[2] + w[4]) + 6.0 * (w[1] + w[5]) - (w[0] + w[6]);
        *value -= SMOOTHING / 64.0 * seen;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use seawall::body::GoringPaddle;

    /// Crest and runup of `results/potential/fixed.csv`, which another method computes.
    #[test]
    fn a_solitary_wave_is_that_of_the_level_tank() {
        let (depth, gravity) = (0.2, 9.81);
        let paddle = GoringPaddle::new(0.3, depth, gravity, 0.05);
        let surface = Surface::default();
        let (length, columns, layers, time) = (2.5, 125, 8, 0.0);
        let bed = None;
        let mut flume =
            Flume { paddle: &paddle, bed, depth, gravity, length, columns, layers, time, surface };
        flume.rest();
        let [mut crest, mut runup] = [0.0_f64; 2];
        while flume.time < 2.8 {
            flume.step(0.01);
            crest = crest.max(if flume.time < 2.2 { flume.level(1.5) / depth } else { 0.0 });
            runup = runup.max(flume.level(length) / depth);
        }
        assert!((crest - 0.3006).abs() < 1e-3, "{crest}");
        assert!((runup - 0.6539).abs() < 3e-3, "{runup}");
        assert!(flume.volume_error().abs() < 1e-4);
    }
}
