//! SIMD lanes and sparse systems.

pub mod simd;
pub mod sparse;
