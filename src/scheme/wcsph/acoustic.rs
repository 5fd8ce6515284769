//! The pressure term of the momentum equation over pairs whose geometry is held. It is all that an
//! acoustic step needs of that equation.
//!
//! ```text
//! Σ_j V_j p_j L_j ∇W = Σ_j g P_j (r_i - r_j) = (Σ_j g P_j) r_i - Σ_j g P_j r_j
//! ```
//! P = p L is a neighbour's pressure times its correction. g is the factor of (r_i - r_j) in V_j
//! ∇W.

use super::Workspace;
use super::momentum::own_pressure;
use crate::pairs::{Double, Factors, Fluid, Held, HeldEquation, Here};

/// The pressure term with new pressures, at the places, volumes and corrections of the last full
/// step. That step also gives the viscous loads and the response to the wall's acceleration. It has
/// already given the water the whole impulse of viscosity.
pub(super) struct Acoustic<'a> {
    pub fluid: &'a Fluid,
    pub work: &'a Workspace,
    /// Of each neighbour: P_xx, P_xy, P_yy, (P r)_x, (P r)_y.
    pub factors: &'a [Factors],
    pub corrected: bool,
    pub bodies: usize,
    /// Gravity, m/s².
    pub gravity: f64,
}

/// The rows: accelerations along x and y.
pub(super) type Rows<'r> = [&'r mut [f64]; 2];

impl HeldEquation<Rows<'_>> for Acoustic<'_> {
    const FORCES: bool = true;

    #[inline(always)]
    fn at<D: Double>(&self, here: Here, held: &mut Held<'_, '_>, [along, up]: &mut Rows<'_>) {
        let (fluid, work) = (self.fluid, self.work);
        let inverse_density: D = here.of(&work.inverse_density);
        let [mut push_x, mut push_y] = self.pressed::<D>(here, held, 0);
        for body in 0..self.bodies {
            if !held.reaches(body) {
                continue;
            }
            let [more_x, more_y] = self.pressed::<D>(here, held, body + 1);
            push_x += more_x;
            push_y += more_y;
            // The body also bears the particles' own part of these pairs.
            let near = held.next_gradient();
            let [own_x, _] = own_pressure::<D>(work, self.corrected, here, near);
            let volume = here.of::<D>(&fluid.mass) * inverse_density;
            let force = ((more_x + own_x) * volume).sum();
            held.tally.loads.push((body, [force, 0.0, 0.0]));
        }
        let all = here.all([&work.concentration_x, &work.concentration_y]);
        let [own_x, own_y] = own_pressure::<D>(work, self.corrected, here, all);
        let (still, fall) = (D::splat(0.0), D::splat(-self.gravity));
        here.put(along, (push_x + own_x).negated_mul_add(inverse_density, still));
        here.put(up, (push_y + own_y).negated_mul_add(inverse_density, fall));
    }
}

impl Acoustic<'_> {
    /// Σ g P_j (r_i - r_j) over the water or a body's ghosts.
    #[inline(always)]
    fn pressed<D: Double>(&self, here: Here, held: &Held<'_, '_>, group: usize) -> [D; 2] {
        let [x, y] = here.all::<D, 2>([&self.work.scaled_x, &self.work.scaled_y]);
        let [xx, xy, yy, at_x, at_y] = held.sum::<D, 5>(group, self.factors);
        let (push_x, push_y) = (x.mul_sub(xx, at_x), x.mul_sub(xy, at_y));
        [y.mul_add(xy, push_x), y.mul_add(yy, push_y)]
    }
}
