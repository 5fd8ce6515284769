//! What an incomplete support keeps a particle from: being shifted, and taking pressure.

/// Completenesses of the support between which shifting fades in.
pub const SHIFT_INTERIOR: [f64; 2] = [0.85, 0.97];
/// The same for shifting that leaves alone all that feels the surface: where the support is cut off,
/// ∇C points away from the surface in even water, too, and what is shifted along it rises.
pub const SHIFT_DEEP: [f64; 2] = [0.95, 0.99];
/// No shift is longer than this many particle spacings.
pub const SHIFT_LIMIT: f64 = 0.05;

/// How far a support of this completeness lets shifting act: 0 near the surface, 1 inside.
pub fn shifted_share(completeness: f64, [from, full]: [f64; 2]) -> f64 {
    ((completeness - from) / (full - from)).clamp(0.0, 1.0)
}

/// Completenesses of the support at which a scheme lets its water go slack: spray, and water under
/// tension near the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// A particle is spray below the first, and wholly so below the second.
    pub spray: [f64; 2],
    /// Tension begins to be given up below the first, and is wholly so below the second.
    pub tension: [f64; 2],
}

impl Slack {
    /// How much of its pressure a particle of this completeness gives up: 0 or less for nothing, 1 or
    /// more for all. `tense` is water under tension.
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
