//! Pure formulas: no state, no particles.

pub mod central_field;
pub mod dam_break;
pub mod elliptic_drop;
pub mod goda;
pub mod hydrostatics;
pub mod oscillator;
pub mod rotating_patch;
pub mod solitary_wave;
pub mod standing_wave;
pub mod taylor_green;
pub mod wall_potential;
pub mod wavemaker;
