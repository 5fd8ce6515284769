//! Pure formulas: no state, no particles.

pub mod goring;
pub mod hydrostatics;
pub mod oscillator;
