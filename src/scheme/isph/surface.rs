//! The free surface: which particles are at it, and where its zero pressure takes hold.

use super::Isph;

/// A particle is at the surface where ∇·r is below this (Liang et al. 2017, Eq. 13).
pub(super) const SURFACE_DIVERGENCE: f64 = 1.5;
/// The surface lies this far outside the centres of its particles, in spacings.
const SKIN: f64 = 0.5;
/// No particle is closer to the surface than this, in spacings.
const CLOSEST: f64 = 0.25;

impl Isph {
    /// Finds surface particles by ∇·r = Σ V_j (r_j - r_i)·∇_iW_ij < 1.5 (Eq. 13, sign corrected) and
    /// sets the condition p = 0 half a spacing outside them.
    ///
    /// Not the surface particle's own pressure is zero: that would put the surface half a spacing
    /// too low. The part of a particle's support that sticks out of the water is thought filled
    /// with points whose pressure goes on linearly from p_i through zero at the surface, at the
    /// distance d_i. Their sum 2 Σ F (p_v - p_i) is -2 |s_i|/d_i p_i, s_i = Σ F Δ over what is there:
    /// a term on the diagonal alone, exact for a linear pressure (compare Nair & Tomar 2014, whose
    /// full-support diagonal 2 (Σ_full F - Σ F) is its lower bound here).
    pub(super) fn find_surface(&mut self) {
        let n = self.fluid.len();
        let spacing = self.options.spacing;
        let operators = &mut self.operators;
        operators.at_surface.clear();
        operators
            .at_surface
            .extend(operators.moment.iter().map(|[xx, _, yy]| xx + yy < SURFACE_DIVERGENCE));
        let normal = |sway: [f64; 2]| {
            let length = (sway[0] * sway[0] + sway[1] * sway[1]).sqrt();
            if length > 0.0 { [-sway[0] / length, -sway[1] / length] } else { [0.0, 1.0] }
        };
        let of = |i: usize| self.list_starts[i] as usize..self.list_starts[i + 1] as usize;
        let near = &mut self.near_surface;
        near.clear();
        near.resize(n, false);
        for i in (0..n).filter(|&i| operators.at_surface[i]) {
            for neighbour in &self.list[of(i)] {
                near[self.points.original[neighbour.point as usize] as usize] = true;
            }
        }
        for i in (0..n).filter(|&i| near[i]) {
            let neighbours = &self.list[of(i)];
            // Mean height of the surface particles in reach over this one, and mean normal.
            let place = self.loose[i].place;
            let (mut sum, mut height, mut up) = (0.0, 0.0, [0.0; 2]);
            for neighbour in neighbours {
                let point = neighbour.point as usize;
                let original = self.points.original[point] as usize;
                if !operators.at_surface[original] {
                    continue;
                }
                let [nx, ny] = normal(operators.sway[original]);
                let [a, b, c, d] = self.points.turn[point];
                let to = [a * nx + b * ny, c * nx + d * ny];
                let apart = [self.points.x[point] - place[0], self.points.y[point] - place[1]];
                let weight = neighbour.weight;
                sum += weight;
                height += weight * (apart[0] * to[0] + apart[1] * to[1]);
                up[0] += weight * to[0];
                up[1] += weight * to[1];
            }
            let distance = (SKIN * spacing + height / sum).max(CLOSEST * spacing);
            let length = (up[0] * up[0] + up[1] * up[1]).sqrt().max(1e-300);
            let sway = operators.sway[i];
            let outwards = -(sway[0] * up[0] + sway[1] * up[1]) / length;
            let missing = (self.full_weight - operators.weight[i]).max(0.0);
            operators.grip[i] = 2.0 * (outwards / distance).max(missing);
        }
    }
}
