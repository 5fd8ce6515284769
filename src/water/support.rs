//! Effects of an incomplete support: less shifting, and less pressure.

/// Completenesses of the support between which shifting fades in.
pub const SHIFT_INTERIOR: [f64; 2] = [0.85, 0.97];
/// The same for shifting that leaves out all particles that feel the surface. Where the support is
/// cut off, ∇C points away from the surface even in evenly spread water, and shifted particles
/// rise.
pub const SHIFT_DEEP: [f64; 2] = [0.95, 0.99];
/// No shift is longer than this many particle spacings.
pub const SHIFT_LIMIT: f64 = 0.05;

/// Share of shifting at this completeness of the support: 0 near the surface, 1 inside.
pub fn shifted_share(completeness: f64, [from, full]: [f64; 2]) -> f64 {
    ((completeness - from) / (full - from)).clamp(0.0, 1.0)
}

/// Completenesses of the support below which a scheme reduces the pressure: of spray, and of water
/// under tension near the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// A particle starts to be spray below the first, and is fully so below the second.
    pub spray: [f64; 2],
    /// Tension starts to be reduced below the first, and is zero below the second.
    pub tension: [f64; 2],
}

impl Slack {
    /// The share of its pressure that a particle of this completeness gives up; up to 0 is none,
    /// from 1 on is all. `tense` is whether the water is under tension.
    pub fn share(&self, completeness: f64, tense: bool) -> f64 {
        let given_up = |[from, full]: [f64; 2]| (from - completeness) / (from - full);
        let slack = if tense { given_up(self.tension) } else { 0.0 };
        given_up(self.spray).max(slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spray_goes_slack_and_whole_water_only_under_tension() {
        let slack = Slack { spray: [0.4, 0.2], tension: [0.9, 0.6] };
        assert_eq!(slack.share(0.2, false), 1.0);
        assert!((slack.share(0.3, false) - 0.5).abs() < 1e-15);
        assert_eq!(slack.share(0.75, false), 0.0);
        assert!((slack.share(0.75, true) - 0.5).abs() < 1e-15);
        assert!(slack.share(0.95, true) < 0.0 || slack.share(0.95, true) == 0.0);
    }
}
