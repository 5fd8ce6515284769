//! Dummy particles after Adami, Hu & Adams 2012.

use serde::{Deserialize, Serialize};

use super::Interpolator;

/// w_j = W(r_j - r) V_j / Σ W V around the ghost itself: no point is mirrored (Adami, Hu & Adams
/// 2012, *Journal of Computational Physics* 231, Eqs. 22-27).
///
/// With gravity in the sum this is their p_w = [Σ p_f W + (g - a_w)·Σ ρ r_wf W] / Σ W. Their
/// velocity is u = 2 u_w - ū. Here it also takes account of the distance of the water of ū, as for
/// every interpolator. A ghost that no water can feel has no water in reach either, so this method
/// cannot fail.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Dummy;

impl Interpolator for Dummy {
    const TRIED: &'static [Dummy] = &[Dummy];
    const AT_GHOST: bool = true;
    const FROM_KERNEL: bool = true;
}
