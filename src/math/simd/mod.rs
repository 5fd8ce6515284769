//! Eight-lane vectors of `f64`, with the instruction set chosen at run time.

use serde::{Deserialize, Serialize};

/// An instruction set for the hot loops. AVX-512 and AVX2 give the same bits; the portable path
/// has no fused multiply-add and differs in rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SimdPath {
    /// Plain Rust.
    Portable,
    /// 256-bit vectors with fused multiply-add.
    Avx2,
    /// 512-bit vectors.
    Avx512,
}

impl SimdPath {
    /// The widest that this processor has.
    pub fn widest() -> SimdPath {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl")
            {
                return SimdPath::Avx512;
            }
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                return SimdPath::Avx2;
            }
        }
        SimdPath::Portable
    }

    /// The name used in files.
    pub fn name(self) -> &'static str {
        match self {
            SimdPath::Portable => "portable",
            SimdPath::Avx2 => "avx2",
            SimdPath::Avx512 => "avx512",
        }
    }
}
