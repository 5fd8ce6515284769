//! The momentum equation of δ-SPH (Huang et al. 2019, Eq. 5), term by term.
//!
//! ```text
//! ρ_i du_i/dt = - Σ_j V_j (p_i L_i + p_j L_j) ∇W_ij     pressure
//!               + α h c0 ρ0 Σ_j V_j π_ij ∇W_ij          artificial viscosity
//!               - ρ_i g                                 gravity
//! π_ij = (u_ij · x_ij) / |x_ij|²
//! ```
//! L is the correction of the kernel's gradient from one step before; without `CORRECTED` it is the
//! identity. Pairs are antisymmetric, with ρ0 in place of the paper's ρ_i before π_ij. So momentum
//! is conserved. Distances are over R, the support radius.

use super::Workspace;
use super::diffusion::DensityGradient;
use super::response::Response;
use super::support::{Moment, Support};
use super::viscosity::{ArtificialViscosity, halfway};
use crate::pairs::{
    Around, Double, Eight, Equation, Fluid, Here, If, Neighbour, Other, Pair, Real, Sums, Term,
    loaded,
};

/// Number of fields that the equation writes: see [`Workspace::found_mut`].
pub(super) const FOUND: usize = 11;

/// Σ_j V_j p_j L_j ∇W: the neighbours' part of the pressure term. A particle's own part is
/// [`own_pressure`].
#[derive(Clone, Copy)]
struct Pressure<const CORRECTED: bool>;

impl<const CORRECTED: bool> Term for Pressure<CORRECTED> {
    type Own<R: Real> = ();
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, _: Here) {}

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        (): &(),
        pair: &Pair<R>,
        other: Other<'_, N>,
        [x, y]: &mut [R; 2],
    ) {
        let [xx, xy, yy] = other.pressure::<R>();
        let [gx, gy] = pair.gradient();
        *x = xx.mul_add(gx, *x);
        if CORRECTED {
            *x = xy.mul_add(gy, *x);
            *y = xy.mul_add(gx, *y);
        }
        *y = yy.mul_add(gy, *y);
    }
}

/// The equation, with other results of the same pairs: the support of each particle, and with
/// `GRADIENTS` the renormalised density gradient.
pub(super) struct Momentum<'a, const CORRECTED: bool, const VISCOUS: bool, const GRADIENTS: bool> {
    pub fluid: &'a Fluid,
    /// Fields that are not written: see [`Workspace::found_mut`].
    pub work: &'a Workspace,
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    /// R/2 (∂u/∂x - ∂v/∂y)/2 and R/2 (∂u/∂y + ∂v/∂x).
    pub strain: &'a [[f64; 2]],
    /// Responses of the ghosts' pressures to their wall's acceleration.
    pub responses: &'a [[f64; 3]],
    /// Body whose ghosts respond to its acceleration.
    pub responds: usize,
    /// How the support of a particle is evaluated.
    pub support: Support,
    /// α h c0 ρ0 / R.
    pub viscosity: f64,
    /// See [`ArtificialViscosity`].
    pub limited_viscosity: bool,
    /// Rest density, kg/m³.
    pub density: f64,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Steps until the next full one, this one included.
    pub steps: f64,
    /// Half of this one, seconds.
    pub half_step: f64,
}

/// Sums over some neighbours: force per volume of pressure and of viscosity, Σ V_j ∇W and its moment.
#[derive(Clone, Copy)]
struct Share<D> {
    push: [D; 2],
    drag: [D; 2],
    gradient: [D; 2],
    moment: [D; 3],
}

impl<D: Double> Share<D> {
    #[inline(always)]
    fn add(&mut self, more: &Share<D>) {
        for n in 0..2 {
            self.push[n] += more.push[n];
            self.drag[n] += more.drag[n];
            self.gradient[n] += more.gradient[n];
        }
        for n in 0..3 {
            self.moment[n] += more.moment[n];
        }
    }
}

impl<const CORRECTED: bool, const VISCOUS: bool, const GRADIENTS: bool>
    Momentum<'_, CORRECTED, VISCOUS, GRADIENTS>
{
    #[inline(always)]
    fn viscosity<const GHOSTS: bool>(
        &self,
    ) -> If<VISCOUS, ArtificialViscosity<'_, CORRECTED, GHOSTS>> {
        let limited = self.limited_viscosity;
        If(ArtificialViscosity { fluid: self.fluid, strain: self.strain, limited })
    }

    #[inline(always)]
    fn share<D: Double>(
        &self,
        here: Here,
        gradient: &[Eight; 2],
        (pressure, drag, moment): (&[Eight; 2], &[Eight; 2], &[Eight; 3]),
    ) -> Share<D> {
        let gradient = loaded(gradient);
        let [own_x, own_y] = own_pressure::<D>(self.work, CORRECTED, here, gradient);
        let ([x, y], [drag_x, drag_y]) = (loaded::<D, 2>(pressure), loaded::<D, 2>(drag));
        let (zero, viscosity) = (D::splat(0.0), D::splat(self.viscosity));
        Share {
            push: [zero - x - own_x, zero - y - own_y],
            drag: [drag_x * viscosity, drag_y * viscosity],
            gradient,
            moment: loaded(moment),
        }
    }

    /// A wall's share, and how it responds to the wall's acceleration.
    #[inline(always)]
    fn of_wall<D: Double>(
        &self,
        body: usize,
        here: Here,
        around: &mut Around<'_>,
    ) -> Option<(Share<D>, Option<[D; 2]>)> {
        let terms = (Pressure::<CORRECTED>, self.viscosity::<true>(), Moment);
        if body == self.responds {
            let (responses, first_ghost) = (self.responses, self.fluid.padded_len());
            let all = (terms, Response { responses, first_ghost });
            let Sums { gradient, terms: (terms, response), .. } =
                around.ghosts::<D, _>(body, all)?;
            let (pressure, drag, moment) = &terms;
            let share = self.share(here, &gradient, (pressure, drag, moment));
            Some((share, Some(loaded(&response))))
        } else {
            let Sums { gradient, terms, .. } = around.ghosts::<D, _>(body, terms)?;
            let (pressure, drag, moment) = &terms;
            Some((self.share(here, &gradient, (pressure, drag, moment)), None))
        }
    }
}

impl<const CORRECTED: bool, const VISCOUS: bool, const GRADIENTS: bool>
    Equation<[&mut [f64]; FOUND]> for Momentum<'_, CORRECTED, VISCOUS, GRADIENTS>
{
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, around: &mut Around<'_>, rows: &mut [&mut [f64]; FOUND]) {
        let [
            inverse_densities,
            acceleration_x,
            acceleration_y,
            gradient_x,
            gradient_y,
            concentration_x,
            concentration_y,
            support @ ..,
        ] = rows;
        let density: D = here.of(&self.fluid.density);
        let inverse_density = D::splat(1.0).div(density);
        here.put(inverse_densities, inverse_density);
        let volume = here.of::<D>(&self.fluid.mass) * inverse_density;
        let rise = If::<GRADIENTS, _>(DensityGradient::of(self.diffused, self.density));
        let terms = (Pressure::<CORRECTED>, self.viscosity::<false>(), Moment, rise);
        let Sums { gradient, terms: (pressure, drag, moment, rise), .. } =
            around.water::<D, _>(terms);
        let water = self.share::<D>(here, &gradient, (&pressure, &drag, &moment));
        let mut all = water;
        for body in 0..around.bodies() {
            let Some((wall, response)) = self.of_wall::<D>(body, here, around) else { continue };
            all.add(&wall);
            // The body's reaction is minus the force of its ghosts on the water.
            let viscous = (wall.drag[0] * volume).sum();
            let force = viscous + (wall.push[0] * volume).sum();
            let mut added_mass = 0.0;
            if let Some([x, y]) = response {
                let minus = D::splat(0.0) - inverse_density;
                added_mass = (x * volume).sum();
                around.tally.respond(here, [x * minus, y * minus]);
            }
            around.tally.loads.push((body, [-force, -viscous, -added_mass]));
        }
        let Share { push, drag, gradient, moment } = all;
        // Viscosity acts now for all steps until the next full one.
        let steps = D::splat(self.steps);
        let force = [drag[0].mul_add(steps, push[0]), drag[1].mul_add(steps, push[1])];
        let along = force[0] * inverse_density;
        let up = force[1].mul_sub(inverse_density, D::splat(self.gravity));
        here.put(acceleration_x, along);
        here.put(acceleration_y, up);
        if VISCOUS {
            let [u, v] = halfway(self.fluid, here, [along, up], self.half_step);
            around.tally.add_power(drag[0].mul_add(u, drag[1] * v) * volume);
        }
        if GRADIENTS {
            let [x, y] = DensityGradient::renormalised(loaded(&rise), water.moment);
            here.put(gradient_x, x);
            here.put(gradient_y, y);
        }
        here.put(concentration_x, gradient[0]);
        here.put(concentration_y, gradient[1]);
        self.support.put(here, moment, water.moment, support);
    }
}

/// p_i L_i Σ_j V_j ∇W: a particle's own part of the pressure term.
#[inline(always)]
pub(super) fn own_pressure<D: Double>(
    work: &Workspace,
    corrected: bool,
    here: Here,
    [x, y]: [D; 2],
) -> [D; 2] {
    let pressure: D = here.of(&work.pressure);
    if !corrected {
        return [pressure * x, pressure * y];
    }
    let [xx, xy, yy] = work.correction::<D>(here);
    [pressure * xx.mul_add(x, xy * y), pressure * xy.mul_add(x, yy * y)]
}
