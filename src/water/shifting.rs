//! Where particles are shifted, and how far at most.

/// Shifting fades in from this completeness of the support ...
pub const SHIFT_FROM: f64 = 0.85;
/// ... to this one.
pub const SHIFT_FULL: f64 = 0.97;
/// No shift is longer than this many particle spacings.
pub const SHIFT_LIMIT: f64 = 0.05;

/// How far a support of this completeness lets shifting act: 0 near the surface, 1 inside.
pub fn shifted_share(completeness: f64) -> f64 {
    ((completeness - SHIFT_FROM) / (SHIFT_FULL - SHIFT_FROM)).clamp(0.0, 1.0)
}
