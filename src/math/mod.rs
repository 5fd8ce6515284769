//! SIMD lanes, sparse systems, and threads that share the work of one case.

pub mod decimal;
pub mod name;
pub mod simd;
pub mod sparse;
pub mod team;
