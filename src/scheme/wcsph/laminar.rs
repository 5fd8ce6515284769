//! Physical viscosity, for water that has one.
//!
//! ```text
//! ρ_i du_i/dt = 8 ν ρ0 Σ_j V_j (u_ij · x_ij)/|x_ij|² ∇W_ij
//! ```
//! This is ν∇²u in the form of Monaghan & Gingold 1983, which conserves linear and angular
//! momentum. 8 is 2 (d + 2) in d = 2 dimensions.

use super::Workspace;
use super::viscosity::halfway;
use crate::pairs::{
    Double, Eight, Fluid, Held, HeldEquation, Here, Neighbour, Other, Pair, Real, Record, Term,
    loaded,
};

/// Σ_j V_j (u_ij · x_ij)/|x_ij|² ∇W.
#[derive(Clone, Copy)]
struct Drag<'a>(&'a Fluid);

impl Term for Drag<'_> {
    /// The velocity.
    type Own<R: Real> = [R; 2];
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> [R; 2] {
        here.all([&self.0.vx, &self.0.vy])
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        &[u, v]: &[R; 2],
        pair: &Pair<R>,
        other: Other<'_, N>,
        [x, y]: &mut [R; 2],
    ) {
        let [their_u, their_v] = other.velocity();
        let (du, dv) = (u - their_u, v - their_v);
        let approach = du.mul_add(pair.dx, dv * pair.dy).div(pair.square());
        let drag = pair.slope() * approach;
        *x = drag.mul_add(pair.dx, *x);
        *y = drag.mul_add(pair.dy, *y);
    }
}

/// Adds the term to the accelerations, over the pairs that the momentum equation has just held.
/// Like artificial viscosity it acts in a full step for all steps until the next full one.
pub(super) struct Laminar<'a> {
    pub fluid: &'a Fluid,
    pub work: &'a Workspace,
    pub records: &'a [Record],
    pub bodies: usize,
    /// 8 ν ρ0 / R.
    pub viscosity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
    /// Half of this one, seconds.
    pub half_step: f64,
}

/// The rows: accelerations along x and y.
pub(super) type Rows<'r> = [&'r mut [f64]; 2];

impl HeldEquation<Rows<'_>> for Laminar<'_> {
    const FORCES: bool = true;

    #[inline(always)]
    fn at<D: Double>(&self, here: Here, held: &mut Held<'_, '_>, [along, up]: &mut Rows<'_>) {
        let (fluid, work, viscosity) = (self.fluid, self.work, D::splat(self.viscosity));
        let inverse_density: D = here.of(&work.inverse_density);
        let volume = here.of::<D>(&fluid.mass) * inverse_density;
        let places: [&[f64]; 2] = [&work.scaled_x, &work.scaled_y];
        let (mut sum_x, mut sum_y) = (D::splat(0.0), D::splat(0.0));
        for group in 0..=self.bodies {
            let drag = held.terms::<D, _>(group, places, self.records, Drag(fluid));
            let Some(drag) = drag else { continue };
            let [x, y] = loaded::<D, 2>(&drag);
            let (x, y) = (x * viscosity, y * viscosity);
            if group > 0 {
                let viscous = (x * volume).sum();
                held.tally.loads.push((group - 1, [-viscous, -viscous, 0.0]));
            }
            sum_x += x;
            sum_y += y;
        }
        let share = inverse_density * D::splat(self.steps);
        let all = [
            sum_x.mul_add(share, here.in_rows::<D>(along)),
            sum_y.mul_add(share, here.in_rows::<D>(up)),
        ];
        here.put(along, all[0]);
        here.put(up, all[1]);
        let [u, v] = halfway(fluid, here, all, self.half_step);
        held.tally.add_power(sum_x.mul_add(u, sum_y * v) * volume);
    }
}
