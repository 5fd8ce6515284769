//! Fixed ghost particles: what fills the kernel's support beyond a wall.
//!
//! Every ghost mirrors a point in the water (Huang et al. 2019, Fig. 1). Each step an
//! [`Interpolator`] gives weights to the fluid particles around that point; [`Exchange`] turns the
//! weighted sums into the ghost's pressure and velocity, the same way for every interpolator.
//! A new interpolator is one file and one arm of [`with_interpolator!`](crate::with_interpolator).

mod bed;
mod behind;
mod closed_box;
mod corner;
mod crest;
mod crested;
mod dummy;
mod exchange;
mod face_pressures;
mod faces;
mod fill;
mod gathering;
mod ghosts;
mod image;
mod improved_shepard;
mod layout;
mod mirror;
mod mls_linear;
mod mls_quadratic;
mod normalized;
mod open;
mod pack;
mod plane;
mod pressure;
mod profile;
mod rules;
mod sfdi;
mod stretch;
mod sums;
mod tank;
mod wall;
mod waterline;
mod weighing;

pub use closed_box::{box_ghosts, no_ghosts};
pub use crest::Crest;
pub use dummy::Dummy;
pub use exchange::Exchange;
pub use ghosts::{BodySites, GhostBody, Ghosts, Reflection, Site};
pub use image::Image;
pub use improved_shepard::ImprovedShepard;
pub use layout::{CrestShape, FloorBehind, TankLayout};
pub use mls_linear::MlsLinear;
pub use mls_quadratic::MlsQuadratic;
pub use normalized::Normalized;
pub use plane::Plane;
pub use profile::{Profile, Stretch};
pub use rules::ExchangeRules;
pub use sfdi::{Sfdi, SfdiMatrix};
pub use sums::Water;
pub use tank::tank_ghosts;
#[cfg(test)]
pub use wall::MISSING_ROW;
pub use weighing::{Stencil, Weighing};

use serde::{Deserialize, Serialize};

use crate::math::simd::{LANES, Lanes};

/// Gives fluid particles their weights in the interpolation at a point.
pub trait Interpolator: Copy + Send + Sync + 'static {
    /// The water around the ghost itself is taken, rather than around the point that it mirrors.
    const AT_GHOST: bool = false;
    /// Weights may be negative, and a simpler method may have to stand in.
    const SIGNED: bool = false;
    /// The nearest particle outweighs all others wherever it is near.
    const PEAKED: bool = false;
    /// The weights handed in are the kernel's, w(|r_j - r|) V_j; else they are left-overs.
    const FROM_KERNEL: bool = false;

    /// Weights of the stencil's neighbours at its eight points, written to `weights`, and the
    /// factor that makes each lane's weights sum to one. By default weights stay as handed in.
    #[inline(always)]
    fn weigh<L: Lanes>(
        &self,
        _stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        let mut sum = L::splat(0.0);
        for weight in weights {
            sum += L::load(weight);
        }
        Weighing::of_sum(sum, L::splat(0.0))
    }
}

/// Runs `$body` with `$interpolator` bound to the interpolator of a choice.
#[macro_export]
macro_rules! with_interpolator {
    ($choice:expr, $interpolator:ident => $body:expr) => {
        match $choice {
            $crate::boundary::InterpolatorChoice::ImprovedShepard($interpolator) => $body,
            $crate::boundary::InterpolatorChoice::Normalized($interpolator) => $body,
            $crate::boundary::InterpolatorChoice::Sfdi($interpolator) => $body,
            $crate::boundary::InterpolatorChoice::MlsLinear($interpolator) => $body,
            $crate::boundary::InterpolatorChoice::MlsQuadratic($interpolator) => $body,
            $crate::boundary::InterpolatorChoice::Dummy($interpolator) => $body,
        }
    };
}

/// An interpolator with its parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum InterpolatorChoice {
    /// Improved Shepard, Huang et al. 2019, Eqs. 17-21.
    ImprovedShepard(ImprovedShepard),
    /// The normalized kernel, Eqs. 14-16.
    Normalized(Normalized),
    /// Simplified finite difference interpolation, Eqs. 10-13.
    Sfdi(Sfdi),
    /// Moving least squares with a linear basis, Eqs. 8-9.
    MlsLinear(MlsLinear),
    /// Moving least squares with a quadratic basis.
    MlsQuadratic(MlsQuadratic),
    /// The normalized kernel around the ghost itself, Adami et al. 2012.
    Dummy(Dummy),
}

/// Bound on Σ|w_j| with which weights count as fit, by default: that of linear extrapolation by half
/// a spacing, the farthest that a mirror point of a well-filled wall lies outside its water.
pub const AMPLIFICATION_LIMIT: f64 = 2.0;

impl InterpolatorChoice {
    /// Every interpolator, with its default parameters (and the source's matrix for SFDI, too).
    pub const EVERY: [InterpolatorChoice; 7] = [
        InterpolatorChoice::ImprovedShepard(ImprovedShepard { lambda: 2.0, sigma: 1.0 }),
        InterpolatorChoice::Normalized(Normalized),
        InterpolatorChoice::Sfdi(Sfdi {
            matrix: SfdiMatrix::Full,
            amplification_limit: AMPLIFICATION_LIMIT,
        }),
        InterpolatorChoice::Sfdi(Sfdi {
            matrix: SfdiMatrix::Diagonal,
            amplification_limit: AMPLIFICATION_LIMIT,
        }),
        InterpolatorChoice::MlsLinear(MlsLinear { amplification_limit: AMPLIFICATION_LIMIT }),
        InterpolatorChoice::MlsQuadratic(MlsQuadratic { amplification_limit: AMPLIFICATION_LIMIT }),
        InterpolatorChoice::Dummy(Dummy),
    ];

    /// See [`Interpolator::FROM_KERNEL`].
    pub fn from_kernel(&self) -> bool {
        fn told<I: Interpolator>(_: &I) -> bool {
            I::FROM_KERNEL
        }
        with_interpolator!(self, interpolator => told(interpolator))
    }

    /// See [`Interpolator::AT_GHOST`].
    pub fn at_ghost(&self) -> bool {
        fn told<I: Interpolator>(_: &I) -> bool {
            I::AT_GHOST
        }
        with_interpolator!(self, interpolator => told(interpolator))
    }
}
