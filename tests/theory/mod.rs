//! Theory of regular waves that only tests ask.

pub mod front;
pub mod harmonics;
pub mod set_down;
pub mod standing_wave_force;
pub mod stream_function;
