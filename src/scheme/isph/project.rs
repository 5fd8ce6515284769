//! Divergence, gradient and drag of the water with its images. Divergence and gradient are minus
//! the transpose of each other.

use super::Isph;
use super::divergence::{divergence, strain};
use super::gradient::gradient;
use super::images::{Point, WallTerms};
use super::viscosity::Viscosity;
use crate::pairs::Field;

/// Of which pressure a gradient is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Source {
    /// The pressure itself, without the responding wall's acceleration.
    Pressure,
    /// The part that the walls add per unit acceleration of the responding one.
    Walls,
    /// The response of the pressure to that acceleration, walls included.
    Response,
}

impl Isph {
    /// Writes p of the water, and p L of every point for the gradient's sums.
    fn stresses(&mut self, source: Source) {
        let (options, carried) = (&self.options, &self.carried);
        let (points, turned, pressure) = (&self.points, &self.turned, &self.pressure);
        let of = |e: usize| {
            let Point { original, walls, place: [_, y], .. } = &points[e];
            let j = *original as usize;
            match source {
                Source::Pressure => options.whole_pressure(pressure[j] + walls.pressure, *y),
                Source::Walls => walls.pressure_response,
                Source::Response => carried.response[j] + walls.pressure_response,
            }
        };
        self.near.each_point(|[e, _], at| {
            let ([xx, xy, yy], p) = (turned[e], of(e));
            at.set_pressure([xx * p, xy * p, yy * p]);
        });
        self.near.each(Field(&mut self.own_pressure), of);
    }

    /// Accelerations by a pressure, -(1/ρ) Σ F (p_i L_i + p_j L_j) Δ. They are equal and opposite
    /// within a pair, and repel where particles are crowded.
    pub(super) fn accelerate(&mut self, source: Source) {
        self.stresses(source);
        let near = (&self.near, &self.operators);
        let pressure = (&self.own_pressure[..], -1.0 / self.options.density);
        gradient(near, pressure, &mut self.accelerations);
    }

    /// Mirrors the present velocities in the walls.
    fn mirror(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2] + Sync) {
        let (points, velocities) = (&self.points, &self.velocities);
        self.near.each_point(|[e, j], at| {
            let point = &points[e];
            let [u, v] = point.turned(velocities[j]);
            let [wall_u, wall_v] = walls(&point.walls);
            at.set_velocity([u + wall_u, v + wall_v]);
        });
    }

    /// ∇·u = Σ F (u_j - u_i)·L_i Δ of the present velocities. `walls` gives the velocities of
    /// images.
    pub(super) fn diverge(&mut self, walls: impl Fn(&WallTerms) -> [f64; 2] + Sync) {
        self.mirror(walls);
        let near = (&self.near, &self.operators);
        divergence(near, &self.velocities, &mut self.divergence, |_, divergence| divergence);
    }

    /// Viscous accelerations with free-slip walls, and the divergence of the velocities.
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
