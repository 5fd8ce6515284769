//! Divergence and gradient: two operators, each minus the transpose of the other.

use super::Isph;
use super::images::{NO_BODY, WallTerms, turned};
use super::sums::{Divergence, Gradient};
use crate::math::simd::dispatch;

/// Which pressure a gradient is taken of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Source {
    /// The pressure itself, the responding wall's acceleration left out.
    Pressure,
    /// What the walls alone add per unit acceleration of the responding one.
    Walls,
    /// The response of the pressure to that acceleration, walls included.
    Response,
}

impl Isph {
    /// L of every point, turned as its image is.
    pub(super) fn turn_corrections(&mut self) {
        let (points, correction) = (&self.points, &self.operators.correction);
        self.turned.clear();
        self.turned.extend(
            (points.turn.iter().zip(&points.original))
                .map(|(&turn, &j)| turned(turn, correction[j as usize])),
        );
    }

    /// p of the water and p L of every point: what the gradient sums.
    fn stresses(&mut self, source: Source) {
        let options = &self.options;
        let gravity = options.density * options.gravity;
        let carried = &self.carried;
        let points = &self.points;
        for (e, at) in self.numbers.iter_mut().enumerate() {
            let j = points.original[e] as usize;
            let walls = &points.walls[e];
            let p = match source {
                Source::Pressure => {
                    self.pressure[j]
                        + walls.pressure
                        + gravity * (options.still_level - points.y[e])
                }
                Source::Walls => walls.pressure_response,
                Source::Response => carried.response[j] + walls.pressure_response,
            };
            if points.body[e] == NO_BODY {
                self.own_pressure[j] = p;
            }
            at.tensor = self.turned[e].map(|correction| correction * p);
        }
    }

    /// Accelerations by a pressure, -(1/ρ) Σ F (p_i L_i + p_j L_j) Δ: equal and opposite between
    /// pairs, and repelling where particles crowd.
    pub(super) fn accelerate(&mut self, source: Source) {
        self.own_pressure.resize(self.fluid.len(), 0.0);
        self.stresses(source);
        let mut slope = std::mem::take(&mut self.accelerations);
        slope.resize(self.fluid.len(), [0.0; 2]);
        dispatch(
            self.path,
            Gradient {
                lists: self.lists(),
                pressure: &self.own_pressure,
                numbers: &self.numbers,
                slope: &mut slope,
            },
        );
        let per_density = -1.0 / self.options.density;
        slope.iter_mut().for_each(|slope| *slope = slope.map(|s| per_density * s));
        self.accelerations = slope;
    }

    /// The velocities at hand as the walls mirror them.
    pub(super) fn mirror(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2]) {
        for (e, at) in self.numbers.iter_mut().enumerate() {
            let [u, v] = self.velocities[self.points.original[e] as usize];
            let [a, b, c, d] = self.points.turn[e];
            let [wx, wy] = walls(&self.points.walls[e]);
            at.velocity = [a * u + b * v + wx, c * u + d * v + wy];
        }
    }

    /// ∇·u = Σ F (u_j - u_i)·L_i Δ of the velocities at hand, images moving as `walls` says.
    pub(super) fn diverge(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2]) {
        self.mirror(walls);
        let mut divergence = std::mem::take(&mut self.operators.divergence);
        divergence.resize(self.fluid.len(), 0.0);
        dispatch(
            self.path,
            Divergence {
                lists: self.lists(),
                own: &self.velocities,
                numbers: &self.numbers,
                divergence: &mut divergence,
            },
        );
        self.operators.divergence = divergence;
    }
}
