//! Fixed ghost particles: they fill the kernel's support beyond a wall.
//!
//! Every ghost mirrors a point in the water (Huang et al. 2019, Fig. 1). In each step an
//! [`Interpolator`] gives weights to the fluid particles around that point. [`Exchange`] turns the
//! weighted sums into the ghost's pressure and velocity, in the same way for every interpolator.
//!
//! A new interpolator needs one file, a line of `interpolators!`, and an arm of
//! `Numerics::interpolator` for its parameters.

mod alongside;
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
mod falling;
mod fill;
mod gathering;
mod ghost_part;
mod ghosts;
mod give_back;
mod giving;
mod image;
mod improved_shepard;
mod layout;
mod mirror;
mod mls_linear;
mod mls_quadratic;
mod normalized;
mod open;
mod plane;
mod profile;
mod rules;
mod sfdi;
mod smooth;
mod sums;
mod tank;
mod territory;
mod wall;
mod waterline;
mod weighing;

pub use closed_box::{box_ghosts, no_ghosts};
pub use crest::Crest;
pub use exchange::Exchange;
pub use ghosts::{BodySites, GhostBody, Ghosts, Reflection, Site};
pub use give_back::Gives;
pub use image::Image;
pub use layout::{CrestShape, FloorBehind, TankLayout};
pub use plane::Plane;
pub use profile::{IN_METRES, Profile, STEEP, Stretch};
pub use rules::{ExchangeRules, GhostGravity};
pub use sfdi::SfdiMatrix;
pub use sums::Water;
pub use tank::tank_ghosts;
#[cfg(test)]
pub use wall::MISSING_ROW;
pub use weighing::{Stencil, Weighing};

use serde::{Deserialize, Serialize};

use crate::math::simd::{LANES, Lanes};

/// Gives fluid particles their weights in the interpolation at a point.
pub trait Interpolator: Copy + Send + Sync + 'static {
    /// With its default parameters, and with all others for tests.
    const TRIED: &'static [Self];
    /// The water is taken around the ghost itself, not around its mirror point.
    const AT_GHOST: bool = false;
    /// Weights may be negative, and a simpler method may have to be used.
    const SIGNED: bool = false;
    /// The nearest particle outweighs all others wherever it is near.
    const PEAKED: bool = false;
    /// The weights passed in are the kernel's, w(|r_j - r|) V_j. Otherwise they have no meaning.
    const FROM_KERNEL: bool = false;

    /// Writes the weights of the stencil's neighbours at its eight points to `weights`. Returns the
    /// factor that makes each lane's weights sum to one. By default weights stay as passed in.
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

/// Declares the family: the names of scene files (in kebab case), each with its parameters; and
/// `with_interpolator!`, which runs a body with the chosen interpolator bound to a name.
macro_rules! interpolators {
    ($d:tt $($(#[$doc:meta])* $name:ident in $file:ident;)+) => {
        $(pub use $file::$name;)+

        /// How ghost particles get their values.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum BoundaryChoice {
            $($(#[$doc])* $name,)+
        }

        /// An interpolator with its parameters.
        #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
        pub enum InterpolatorChoice {
            $($(#[$doc])* $name($name),)+
        }

        macro_rules! with_interpolator {
            ($d choice:expr, $d interpolator:ident => $d body:expr) => {
                match $d choice {
                    $($crate::boundary::InterpolatorChoice::$name($d interpolator) => $d body,)+
                }
            };
        }
        use with_interpolator;

        impl InterpolatorChoice {
            /// Every interpolator, see [`Interpolator::TRIED`].
            pub fn every() -> Vec<InterpolatorChoice> {
                let mut every = Vec::new();
                $(every.extend($name::TRIED.iter().copied().map(InterpolatorChoice::$name));)+
                every
            }
        }
    };
}

interpolators! { $
    /// Improved Shepard interpolation, Huang et al. 2019, Eqs. 17-21.
    ImprovedShepard in improved_shepard;
    /// Normalized kernel, Huang et al. 2019, Eqs. 14-16.
    Normalized in normalized;
    /// Simplified finite difference interpolation, Eqs. 10-13.
    Sfdi in sfdi;
    /// Moving least squares, linear basis, Eqs. 8-9.
    MlsLinear in mls_linear;
    /// Moving least squares, quadratic basis.
    MlsQuadratic in mls_quadratic;
    /// Dummy particles: the normalized kernel around the ghost itself, Adami et al. 2012.
    Dummy in dummy;
}

/// Default bound on Σ|w_j| for usable weights. It is that of linear extrapolation by half a
/// spacing, the farthest that a mirror point of a well-filled wall lies outside its water.
pub const AMPLIFICATION_LIMIT: f64 = 2.0;

impl InterpolatorChoice {
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

    /// See [`Interpolator::weigh`]: for tests, which weigh only a few points.
    pub fn weigh<L: Lanes>(
        &self,
        stencil: &Stencil<'_, L>,
        weights: &mut [[f64; LANES]],
    ) -> Weighing<L> {
        with_interpolator!(self, interpolator => interpolator.weigh(stencil, weights))
    }
}
