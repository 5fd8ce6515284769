//! Pure formulas: no state, no particles.

pub mod dam_break;
pub mod goring;
pub mod hydrostatics;
pub mod oscillator;
