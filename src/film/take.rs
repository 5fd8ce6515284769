//! The water at an instant, as a film stores it.

use super::codec::Point;

/// The water at an instant.
#[derive(Debug, Clone)]
pub(super) struct Take {
    /// Simulated time, seconds.
    pub time_s: f64,
    /// Positions of both end walls, metres from rest.
    pub walls: [f64; 2],
    /// For every particle, by its number: x and y in metres, and the value of its colour.
    pub points: Vec<Point>,
}

/// Index of the instant nearest to a time.
pub(super) fn nearest(takes: &[Take], time: f64) -> usize {
    let gap = |&at: &usize| (takes[at].time_s - time).abs();
    (0..takes.len()).min_by(|a, b| gap(a).total_cmp(&gap(b))).unwrap_or(0)
}
