//! SIMD lanes, sparse systems, threads that share the work of one case, scales and curves through points,
//! lists, tallies, words, roots, comma-separated text, checksums, large pages.

pub mod bend;
pub mod comma;
pub mod decimal;
pub mod digest;
#[cfg(target_os = "linux")]
pub mod large_pages;
pub mod lists;
pub mod name;
pub mod root;
pub mod scale;
pub mod simd;
pub mod sparse;
pub mod tally;
pub mod team;
pub mod words;
