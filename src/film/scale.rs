//! The scale of colours.

use crate::math::decimal::significant;

/// The quantity that colours the particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Colour {
    /// Pressure, kPa.
    Pressure,
    /// Speed, m/s.
    Speed,
}

/// Number of colours of a film; brighter means more.
pub(super) const LEVELS: usize = 64;
/// This share of the water is not above the scale's end.
const SHARE_WITHIN: f64 = 0.997;
/// Red, green and blue along the scale. It is viridis without its darkest and brightest end, to be
/// visible on black and on white.
const STOPS: [[f64; 3]; 7] = [
    [69.0, 55.0, 129.0],
    [57.0, 86.0, 140.0],
    [40.0, 125.0, 142.0],
    [31.0, 150.0, 139.0],
    [60.0, 187.0, 117.0],
    [134.0, 213.0, 73.0],
    [220.0, 227.0, 25.0],
];

impl Colour {
    /// Its name, its unit, and how many of the run's own units this unit has.
    pub(super) fn legend(self) -> (&'static str, &'static str, f64) {
        match self {
            Colour::Pressure => ("pressure", "kPa", 1000.0),
            Colour::Speed => ("speed", "m/s", 1.0),
        }
    }
}

/// The value at the end of the scale: two digits, above nearly all of these values.
pub(super) fn end(values: impl Iterator<Item = f32>) -> f64 {
    let mut values: Vec<f32> = values.collect();
    if values.is_empty() {
        return 1.0;
    }
    let at = ((values.len() - 1) as f64 * SHARE_WITHIN) as usize;
    let (_, value, _) = values.select_nth_unstable_by(at, f32::total_cmp);
    let rounded = significant(f64::from(*value), 2);
    if rounded > 0.0 { rounded } else { 1.0 }
}

/// The level of a value, with its fraction.
pub(super) fn level(value: f32, end: f64) -> f32 {
    (value / end as f32).clamp(0.0, 1.0) * (LEVELS - 1) as f32
}

/// Its colours, from the lowest level to the highest.
pub(super) fn colours() -> Vec<String> {
    let colour = |level: usize| {
        let along = level as f64 / (LEVELS - 1) as f64 * (STOPS.len() - 1) as f64;
        let below = (along as usize).min(STOPS.len() - 2);
        let mix = |k: usize| {
            let [low, high] = [STOPS[below][k], STOPS[below + 1][k]];
            (low + (along - below as f64) * (high - low)).round() as u8
        };
        format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
    };
    (0..LEVELS).map(colour).collect()
}
