//! Theory of regular waves that only tests ask.

pub mod standing_wave_force;
pub mod stream_function;
