//! The continuity equation of δ-SPH (Huang et al. 2019, Eq. 5), with the new velocities at the old places.
//!
//! ```text
//! dρ_i/dt = ρ_i Σ_j V_j (u_i - u_j) · L_i ∇W_ij     divergence
//!           + D_i                                   density diffusion
//! ```
//! L is that of the momentum equation. This form is the adjoint of the pressure term: together they
//! conserve energy. Ghosts take part in the divergence. They take no part in the diffusion: no
//! density flows through a wall. Ghosts of a body that gives back (`boundary/giving.rs`) enter by
//! what they give, not by a velocity.

use super::Workspace;
use super::correction::surface_share;
use super::diffusion::Diffusion;
use crate::boundary::Gives;
use crate::pairs::{Double, Factors, Flow, FlowSums, Fluid, Held, HeldEquation, Here, Own};

/// The rows that the equation writes. The first has the strain rate. Of the other three the first
/// has the rates of change of density. The second sums g times the neighbours' shares in the
/// diffusion. The third has tr (∇u)² at the last strain rate, 1/s².
pub(super) type Rows<'r> = (&'r mut [[f64; 2]], [&'r mut [f64]; 3]);

/// The equation.
pub(super) struct Continuity<'a, D> {
    pub fluid: &'a Fluid,
    pub work: &'a Workspace,
    /// What is wanted, and the numbers of each neighbour for it.
    pub flow: Flow,
    pub factors: &'a [Factors],
    /// What density diffusion smooths, kg/m³.
    pub diffused: &'a [f64],
    pub formulation: D,
    /// δ h c0 / R.
    pub diffusion: f64,
    pub bodies: usize,
    /// The bodies that give their work on the water back to it.
    pub gives: &'a [Gives<'a>],
    /// The numbers of a bed's ghosts, with velocities relative to the water's beside a wall.
    pub of_bed: &'a [Factors],
    pub support_radius: f64,
    /// See [`super::correction::first_row_share`].
    pub first_row: f64,
    /// Length of the step, seconds.
    pub dt: f64,
    /// Whether to sum the power that diffusion takes out of the elastic energy.
    pub sample: bool,
}

impl<F: Diffusion> HeldEquation<Rows<'_>> for Continuity<'_, F> {
    const FORCES: bool = false;

    #[inline(always)]
    fn at<D: Double>(&self, here: Here, held: &mut Held<'_, '_>, rows: &mut Rows<'_>) {
        let (strain, [rate, shares, turning]) = rows;
        let sums = held.flow::<D>(self.flow, self.factors, 0..=self.bodies);
        let density = here.of::<D>(&self.fluid.density);
        let mut diffusion = D::splat(0.0);
        if F::ON {
            if let Some(found) = sums.shares::<D>() {
                here.put(shares, found);
            }
            let all = [sums.smoothed(), here.in_rows::<D>(shares)];
            diffusion = self.formulation.rate(here, held, here.of(self.diffused), all);
        }
        let diffusion = self.formulation.faded(here, diffusion * D::splat(self.diffusion));
        let mut divergence = self.divergence(here, &sums, strain, turning);
        if !self.gives.is_empty() {
            divergence += self.given(here, held);
        }
        here.put(rate, density.mul_add(divergence, diffusion));
        if self.sample {
            // dE/dt = Σ m p/ρ² dρ/dt, of diffusion alone.
            let share = here.of::<D>(&self.fluid.mass) * here.of(&self.work.pressure);
            held.tally.add_power((share * diffusion).div(density * density));
        }
    }
}

impl<F: Diffusion> Continuity<'_, F> {
    /// Σ_j V_j (u_i - u_j) · L_i ∇W, corrected for the age of the places.
    ///
    /// The velocities are those of mid-step, but the places are half a step older. At those places
    /// ∇u seems to be ∇u + ½ Δt (∇u)², and a flow without divergence seems to have ½ Δt tr (∇u)².
    /// That much is subtracted. Without this, water that is strained loses energy and volume in
    /// proportion to Δt.
    #[inline(always)]
    fn divergence<D: Double>(
        &self,
        here: Here,
        sums: &FlowSums,
        strain: &mut [[f64; 2]],
        turning: &mut [f64],
    ) -> D {
        let work = self.work;
        let own = Own {
            place: here.all::<D, 2>([&work.scaled_x, &work.scaled_y]),
            velocity: here.all([&self.fluid.vx, &self.fluid.vy]),
            gradient: here.all([&work.concentration_x, &work.concentration_y]),
        };
        let divergence = self.contracted(here, sums, &own);
        if !self.flow.corrected {
            return divergence;
        }
        if self.flow.strained {
            let ([u_x, v_y], [u_y, v_x]) = (sums.along(&own), sums.across(&own));
            let correction = work.correction(here);
            self.keep_strain(here, correction, [[u_x, u_y], [v_x, v_y]], strain, turning);
        }
        here.in_rows::<D>(turning).mul_add(D::splat(0.5 * self.dt), divergence)
    }

    /// L : Σ V_j (u_i - u_j) ⊗ ∇W_ij.
    #[inline(always)]
    fn contracted<D: Double>(&self, here: Here, sums: &FlowSums, own: &Own<D>) -> D {
        let [u_x, v_y] = sums.along(own);
        if !self.flow.corrected {
            return u_x + v_y;
        }
        let [xx, xy, yy]: [D; 3] = self.work.correction(here);
        xx.mul_add(u_x, yy * v_y) + xy * sums.aslant(own)
    }

    /// What ghosts give, less what their velocities have added to the divergence. Over a bed, water
    /// within the support radius of a wall moves along with that wall.
    #[inline(always)]
    fn given<D: Double>(&self, here: Here, held: &Held<'_, '_>) -> D {
        let (work, zero) = (self.work, D::splat(0.0));
        let place = here.all::<D, 2>([&work.scaled_x, &work.scaled_y]);
        let own = Own { place, velocity: [zero; 2], gradient: [zero; 2] };
        let mut of_velocities = zero;
        for Gives { group, share, alongside } in self.gives {
            let put_in = |factors: &[Factors]| {
                self.contracted(here, &held.flow::<D>(self.flow, factors, *group..=*group), &own)
            };
            let mut of_body = put_in(self.factors);
            if let Some(alongside) = alongside {
                let (before, one) = (zero - alongside.beyond(place), D::splat(1.0));
                if before.any_less(one) {
                    of_body = before.select_less(one, put_in(self.of_bed), of_body);
                }
            }
            of_velocities += of_body * D::splat(*share);
        }
        let given = here.of::<D>(&work.given) * here.of(&self.fluid.density);
        // Padding has no mass.
        let mass = here.of::<D>(&self.fluid.mass).max(D::splat(f64::MIN_POSITIVE));
        given.div(mass) - of_velocities
    }

    /// Stores the strain rate for the next full step's viscosity, and tr (∇u)², from sums Σ g (u_i
    /// - u_j) Δ.
    #[inline(always)]
    fn keep_strain<D: Double>(
        &self,
        here: Here,
        [xx, xy, yy]: [D; 3],
        [[ux, uy], [wx, wy]]: [[D; 2]; 2],
        strain: &mut [[f64; 2]],
        turning: &mut [f64],
    ) {
        // Of the gradient itself, without the share in the correction that balances still water.
        let share = surface_share(here.of::<D>(&self.work.completeness), self.first_row);
        let minus = D::splat(-1.0).div(share);
        let [u_x, u_y] = [xx.mul_add(ux, xy * uy), xy.mul_add(ux, yy * uy)];
        let [v_x, v_y] = [xx.mul_add(wx, xy * wy), xy.mul_add(wx, yy * wy)];
        let squares = u_x.mul_add(u_x, v_y * v_y);
        let crossed = u_y * v_x;
        here.put(turning, (squares + crossed + crossed) * minus * minus);
        let minus_half = D::splat(0.5 * self.support_radius) * minus;
        let stretch = (u_x - v_y) * minus_half * D::splat(0.5);
        here.put_both(strain, [stretch, (u_y + v_x) * minus_half]);
    }
}
