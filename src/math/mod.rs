//! SIMD lanes and small dense solves.

pub mod simd;
