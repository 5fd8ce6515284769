//! Divergence, gradient and drag of the water with its images. Divergence and gradient are each minus
//! the transpose of the other.

use super::Isph;
use super::divergence::{divergence, strain};
use super::gradient::gradient;
use super::images::{NO_BODY, Point, WallTerms};
use super::viscosity::Viscosity;

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
    /// p of the water and p L of every point: what the gradient sums.
    fn stresses(&mut self, source: Source) {
        let options = &self.options;
        let gravity = options.density * options.gravity;
        let carried = &self.carried;
        let points = self.points.iter().zip(&self.turned);
        for (at, (point, turned)) in self.near.records.iter_mut().zip(points) {
            let Point { original, walls, place: [_, y], .. } = point;
            let j = *original as usize;
            let p = match source {
                Source::Pressure => {
                    self.pressure[j] + walls.pressure + gravity * (options.still_level - y)
                }
                Source::Walls => walls.pressure_response,
                Source::Response => carried.response[j] + walls.pressure_response,
            };
            if point.body == NO_BODY {
                self.own_pressure[j] = p;
            }
            at.set_pressure(turned.map(|correction| correction * p));
        }
    }

    /// Accelerations by a pressure, -(1/ρ) Σ F (p_i L_i + p_j L_j) Δ: equal and opposite between
    /// pairs, and repelling where particles crowd.
    pub(super) fn accelerate(&mut self, source: Source) {
        self.stresses(source);
        let near = (&self.near, &self.operators);
        gradient(near, &self.own_pressure, &mut self.accelerations);
        let per_density = -1.0 / self.options.density;
        self.accelerations.iter_mut().for_each(|slope| *slope = slope.map(|s| per_density * s));
    }

    /// The velocities at hand as the walls mirror them.
    fn mirror(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2]) {
        for (at, point) in self.near.records.iter_mut().zip(&self.points) {
            let [u, v] = point.turned(self.velocities[point.original as usize]);
            let [wall_u, wall_v] = walls(&point.walls);
            at.set_velocity([u + wall_u, v + wall_v]);
        }
    }

    /// ∇·u = Σ F (u_j - u_i)·L_i Δ of the velocities at hand, images moving as `walls` says.
    pub(super) fn diverge(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2]) {
        self.mirror(walls);
        let near = (&self.near, &self.operators);
        divergence(near, &self.velocities, &mut self.divergence);
    }

    /// Viscous accelerations, with walls that slip freely, and the divergence of the velocities.
    pub(super) fn find_drag(&mut self) {
        let (n, options) = (self.fluid.len(), &self.options);
        let smoothing = options.kernel.smoothing_length_ratio() * options.support_radius;
        let viscosity = Viscosity {
            artificial: options.artificial_viscosity * smoothing * options.viscous_speed,
            physical: options.viscosity,
            spacing: options.spacing,
        };
        self.drag.clear();
        self.drag.resize(n, [0.0; 2]);
        self.drag_on_bodies.fill(0.0);
        self.velocities.clear();
        self.velocities.extend((0..n).map(|i| [self.fluid.vx[i], self.fluid.vy[i]]));
        self.mirror(|walls| walls.start_velocity);
        let found = (&mut self.strain[..], &mut self.divergence[..]);
        strain((&self.near, &self.operators), &self.velocities, found);
        let on = (&mut self.drag[..], &mut self.drag_on_bodies[..]);
        viscosity.drag((&mut self.near, &self.points), (&self.strain, &self.fluid.mass), on);
    }
}
