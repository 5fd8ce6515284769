//! Divergence and gradient: two operators, each minus the transpose of the other.

use super::Isph;
use super::images::{WallTerms, turned};
use super::state::Neighbour;

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
    /// p L of every point, turned as its image is: what the gradient sums.
    fn stresses(&mut self, source: Source) {
        let options = &self.options;
        let gravity = options.density * options.gravity;
        let carried = &self.carried;
        let points = &self.points;
        self.stress.clear();
        for e in 0..self.loose.len() {
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
            let correction = self.operators.correction[j];
            self.stress.push(turned(points.turn[e], correction).map(|c| c * p));
        }
    }

    /// Accelerations by a pressure, -(1/ρ) Σ F (p_i L_i + p_j L_j) Δ: equal and opposite between
    /// pairs, and repelling where particles crowd.
    pub(super) fn accelerate(&mut self, source: Source) {
        self.stresses(source);
        let per_density = -1.0 / self.options.density;
        let mut own = std::mem::take(&mut self.own_stress);
        own.resize(self.fluid.len(), [0.0; 3]);
        for e in 0..self.loose.len() {
            if self.points.body[e] == super::images::NO_BODY {
                own[self.points.original[e] as usize] = self.stress[e];
            }
        }
        self.own_stress = own;
        let mut accelerations = std::mem::take(&mut self.accelerations);
        accelerations.clear();
        for i in 0..self.fluid.len() {
            let [own_xx, own_xy, own_yy] = self.own_stress[i];
            let [px, py] = self.loose[i].place;
            let (mut x, mut y) = (0.0, 0.0);
            for &Neighbour { point, weight } in self.neighbours(i) {
                let e = point as usize;
                let [xx, xy, yy] = self.stress[e];
                let dx = weight * (self.points.x[e] - px);
                let dy = weight * (self.points.y[e] - py);
                x += (xx + own_xx) * dx + (xy + own_xy) * dy;
                y += (xy + own_xy) * dx + (yy + own_yy) * dy;
            }
            accelerations.push([per_density * x, per_density * y]);
        }
        self.accelerations = accelerations;
    }

    /// ∇·u = Σ F (u_j - u_i)·L_i Δ of a velocity field, images moving as `walls` says.
    pub(super) fn diverge(
        &mut self,
        velocities: &[[f64; 2]],
        walls: impl Fn(&WallTerms) -> [f64; 2],
    ) {
        self.moving.clear();
        for e in 0..self.loose.len() {
            let [u, v] = velocities[self.points.original[e] as usize];
            let [a, b, c, d] = self.points.turn[e];
            let [wx, wy] = walls(&self.points.walls[e]);
            self.moving.push([a * u + b * v + wx, c * u + d * v + wy]);
        }
        let mut divergence = std::mem::take(&mut self.operators.divergence);
        divergence.clear();
        for (i, &[u, v]) in velocities.iter().enumerate() {
            let [px, py] = self.loose[i].place;
            let (mut ux, mut uy, mut vx, mut vy) = (0.0, 0.0, 0.0, 0.0);
            for &Neighbour { point, weight } in self.neighbours(i) {
                let e = point as usize;
                let [ue, ve] = self.moving[e];
                let dx = weight * (self.points.x[e] - px);
                let dy = weight * (self.points.y[e] - py);
                ux += dx * (ue - u);
                uy += dy * (ue - u);
                vx += dx * (ve - v);
                vy += dy * (ve - v);
            }
            let [xx, xy, yy] = self.operators.correction[i];
            divergence.push(xx * ux + xy * (uy + vx) + yy * vy);
        }
        self.operators.divergence = divergence;
    }
}
