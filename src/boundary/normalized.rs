//! The normalized interpolation of Huang et al. 2019.

use serde::{Deserialize, Serialize};

use super::Interpolator;

/// w_j = W(r_j - r) V_j / Σ W V (Huang et al. 2019, Eqs. 14-16): the kernel, made to sum to one.
///
/// Exact for constants, and for linear fields only where the water around the point is symmetric.
/// It cannot fail; the methods with a matrix fall back to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Normalized;

impl Interpolator for Normalized {
    const TRIED: &'static [Normalized] = &[Normalized];
    const FROM_KERNEL: bool = true;
}
