//! Density diffusion: one type for each formulation, with its data.
//!
//! ```text
//! D_i = δ h c0 Σ_j V_j s_j ψ_ij · ∇W,   ψ_ij = 2 (ψ_j - ψ_i) x_ji/|x_ji|²,  or as the formulation has it
//! ```
//! So D_i is a sum of differences: 2 δ h c0/R (ψ_i Σ g s_j - Σ g s_j ψ_j). g is the factor of Δ in
//! V_j ∇W.

use super::correction::solve_symmetric;
use super::{DensityDiffusion, Wcsph};
use crate::math::simd::dispatch;
use crate::pairs::{Double, Eight, Factors, Held, Here, Neighbour, Other, Pair, Ramp, Real, Term};

/// A formulation.
pub(super) trait Diffusion: Copy + Sync {
    /// Whether there is any diffusion.
    const ON: bool = true;
    /// Whether it reads the share of each particle in the diffusion (`diffused_share`).
    const FADES: bool = false;
    /// Whether it reads the renormalised gradient of ψ, and the sums of slants.
    const SLANTS: bool = false;
    /// Of a neighbour, from the smoothed field: its share times ψ, and its share.
    #[inline(always)]
    fn neighbour<D: Double>(self, _: Here, smoothed: D) -> [D; 2] {
        [smoothed, D::splat(1.0)]
    }
    /// The sum over the pairs without the factor δ h c0/R. It is made from the particle's own ψ, Σ
    /// g s_j ψ_j and Σ g s_j.
    #[inline(always)]
    fn rate<D: Double>(self, _: Here, _: &Held<'_, '_>, own: D, [smoothed, share]: [D; 2]) -> D {
        own.mul_sub(share, smoothed) * D::splat(2.0)
    }
    /// The rate times the particle's own share in the diffusion.
    #[inline(always)]
    fn faded<D: Double>(self, _: Here, rate: D) -> D {
        rate
    }
}

/// What the scheme finds for a formulation: see its constants of these names.
pub(super) struct Reads {
    pub fades: bool,
    pub slants: bool,
}

impl DensityDiffusion {
    /// What its formulation reads.
    pub(super) fn reads(self) -> Reads {
        match self {
            DensityDiffusion::None => reads::<NoDiffusion>(),
            DensityDiffusion::Molteni => reads::<Molteni>(),
            DensityDiffusion::Hydrostatic => reads::<Hydrostatic<'_>>(),
            DensityDiffusion::Renormalised => reads::<Renormalised<'_>>(),
        }
    }
}

fn reads<F: Diffusion>() -> Reads {
    Reads { fades: F::FADES, slants: F::SLANTS }
}

/// Runs `$body` with the chosen formulation: an arm for each.
macro_rules! with_diffusion {
    ($choice:expr, $work:expr, $slants:expr, $formulation:ident => $body:expr) => {{
        use $crate::scheme::wcsph::{DensityDiffusion, diffusion};
        let work = $work;
        match $choice {
            DensityDiffusion::None => {
                let $formulation = diffusion::NoDiffusion;
                $body
            }
            DensityDiffusion::Molteni => {
                let $formulation = diffusion::Molteni;
                $body
            }
            DensityDiffusion::Hydrostatic => {
                let $formulation = diffusion::Hydrostatic { share: &work.diffused_share };
                $body
            }
            DensityDiffusion::Renormalised => {
                let gradient = [&*work.gradient_x, &*work.gradient_y];
                let places = [&*work.scaled_x, &*work.scaled_y];
                let $formulation = diffusion::Renormalised { gradient, places, slants: $slants };
                $body
            }
        }
    }};
}
pub(super) use with_diffusion;

/// No diffusion: standard weakly compressible SPH.
#[derive(Clone, Copy)]
pub(super) struct NoDiffusion;

impl Diffusion for NoDiffusion {
    const ON: bool = false;
}

/// Of Molteni & Colagrossi 2009: ψ = ρ, and every share 1.
#[derive(Clone, Copy)]
pub(super) struct Molteni;

impl Diffusion for Molteni {}

/// Molteni's with ψ = ρ_s (ln(ρ/ρ_s) + g y/c0²), which is uniform in still water. It fades out
/// towards the free surface, on both sides of a pair.
#[derive(Clone, Copy)]
pub(super) struct Hydrostatic<'a> {
    /// Share of each particle in the diffusion.
    pub share: &'a [f64],
}

impl Diffusion for Hydrostatic<'_> {
    const FADES: bool = true;
    #[inline(always)]
    fn neighbour<D: Double>(self, here: Here, smoothed: D) -> [D; 2] {
        let share = here.of::<D>(self.share);
        [share * smoothed, share]
    }
    #[inline(always)]
    fn faded<D: Double>(self, here: Here, rate: D) -> D {
        rate * here.of(self.share)
    }
}

/// Of Antuono et al. 2010 (Huang et al. 2019, Eqs. 5-6). The mean of both renormalised gradients is
/// subtracted from ψ_ij: a neighbour's ψ becomes 2 ψ - r·∇ψ.
#[derive(Clone, Copy)]
pub(super) struct Renormalised<'a> {
    /// R ∇ψ.
    pub gradient: [&'a [f64]; 2],
    /// Places over R.
    pub places: [&'a [f64]; 2],
    /// R ∇ψ and the place of each particle, four numbers: only for the rate.
    pub slants: &'a [Factors],
}

impl Diffusion for Renormalised<'_> {
    const SLANTS: bool = true;
    #[inline(always)]
    fn neighbour<D: Double>(self, here: Here, smoothed: D) -> [D; 2] {
        let ([slope_x, slope_y], [x, y]) =
            (here.all::<D, 2>(self.gradient), here.all::<D, 2>(self.places));
        [D::splat(2.0) * smoothed - (slope_x * x + slope_y * y), D::splat(1.0)]
    }
    #[inline(always)]
    fn rate<D: Double>(
        self,
        here: Here,
        held: &Held<'_, '_>,
        own: D,
        [smoothed, share]: [D; 2],
    ) -> D {
        let plain = (own * D::splat(2.0)).mul_sub(share, smoothed);
        let [slopes_x, slopes_y, places_x, places_y] = held.sum::<D, 4>(0, self.slants);
        let ([own_x, own_y], [x, y]) =
            (here.all::<D, 2>(self.gradient), here.all::<D, 2>(self.places));
        // Subtracts (∇_i + ∇_j)·(r_i - r_j).
        let (near_x, near_y) = (x.mul_sub(share, places_x), y.mul_sub(share, places_y));
        let slant = own_x.mul_add(near_x, own_y * near_y);
        plain - y.mul_add(slopes_y, x.mul_add(slopes_x, slant))
    }
}

/// Σ_j V_j (ψ_j - ψ_i) ∇W, for the renormalised gradient of ψ.
#[derive(Clone, Copy)]
pub(super) struct DensityGradient<'a> {
    diffused: &'a [f64],
    /// Rest density, kg/m³.
    rest: f64,
}

impl<'a> DensityGradient<'a> {
    /// The gradient of this field.
    pub fn of(diffused: &'a [f64], rest: f64) -> DensityGradient<'a> {
        DensityGradient { diffused, rest }
    }

    /// R ∇ψ, from the sum and the water's moment.
    #[inline(always)]
    pub fn renormalised<D: Double>(sum: [D; 2], moment: [D; 3]) -> [D; 2] {
        solve_symmetric(moment, sum)
    }
}

impl Term for DensityGradient<'_> {
    type Own<R: Real> = R;
    type Sum<R: Real> = [R; 2];
    type Total = [Eight; 2];

    #[inline(always)]
    fn own<R: Real, N: Neighbour>(&self, here: Here) -> R {
        N::own_diffused(here, self.diffused, self.rest)
    }

    #[inline(always)]
    fn add<R: Real, N: Neighbour>(
        &self,
        own: &R,
        pair: &Pair<R>,
        other: Other<'_, N>,
        [x, y]: &mut [R; 2],
    ) {
        let rise = other.diffused::<R>(self.diffused) - *own;
        let [gx, gy] = pair.gradient();
        *x = rise.mul_add(gx, *x);
        *y = rise.mul_add(gy, *y);
    }
}

/// Hydrostatic density diffusion fades in from this completeness ... Near the surface the discrete
/// balance differs from the exact one, and diffusion would always work against it.
const DIFFUSE_FROM: f64 = 0.9;
/// ... to this one, where it is full.
const DIFFUSE_FULL: f64 = 0.99;

impl Wcsph {
    /// Finds the share of each particle in the density diffusion until the next full step.
    pub(super) fn find_diffused_shares(&mut self) {
        if self.options.density_diffusion.reads().fades {
            let (values, shares) = (&*self.work.completeness, &mut *self.work.diffused_share);
            let (from, to) = (DIFFUSE_FROM, DIFFUSE_FULL);
            dispatch(self.pairs.path, Ramp { values, from, to, shares });
        }
    }
}
