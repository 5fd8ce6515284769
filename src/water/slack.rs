//! Where water takes no pressure: spray, and water under tension near the surface.

/// Completenesses of the support at which a scheme lets its water go slack.
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
