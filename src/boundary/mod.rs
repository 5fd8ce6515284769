//! Fixed ghost particles: what fills the kernel's support beyond a wall.
//!
//! Every ghost mirrors a point in the water (Huang et al. 2019, Fig. 1). Each step an
//! [`Interpolator`] gives weights to the fluid particles around that point; [`Exchange`] turns the
//! weighted sums into the ghost's pressure and velocity, the same way for every interpolator.
//! A new interpolator is one file and one arm of [`with_interpolator!`](crate::with_interpolator).

mod exchange;
mod faces;
mod ghosts;
mod improved_shepard;
mod mirror;
mod sums;
mod tank;
mod waterline;

pub use exchange::{Exchange, ExchangeRules};
pub use ghosts::{BodySites, GhostBody, Ghosts, Plane, Reflection, Site};
pub use improved_shepard::ImprovedShepard;
pub use sums::Water;
pub use tank::{TankLayout, tank_ghosts};

use serde::{Deserialize, Serialize};

use crate::kernel::Kernel;
use crate::math::simd::{LANES, Lanes};
use crate::particles::Record;

/// Gives fluid particles their weights in the interpolation at a point.
pub trait Interpolator: Copy + Send + Sync + 'static {
    /// Weights of `neighbours` at eight points (`x`, `y`, in support radii), written to `weights`;
    /// returns the factor that makes each lane's weights sum to one, 0 where nothing is in reach.
    fn weigh<K: Kernel, L: Lanes>(
        &self,
        x: L,
        y: L,
        neighbours: &[u32],
        records: &[Record],
        weights: &mut [[f64; LANES]],
    ) -> L;
}

/// An interpolator with its parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum InterpolatorChoice {
    /// Improved Shepard, Huang et al. 2019, Eqs. 17-21.
    ImprovedShepard(ImprovedShepard),
}

/// Runs `$body` with `$interpolator` bound to the interpolator of a choice.
#[macro_export]
macro_rules! with_interpolator {
    ($choice:expr, $interpolator:ident => $body:expr) => {
        match $choice {
            $crate::boundary::InterpolatorChoice::ImprovedShepard($interpolator) => $body,
        }
    };
}
