//! Whether the force of still water is wrong, before a wave or without one.

use super::super::outcome::Outcome;
use super::Evidence;

/// Still water presses wall and paddle alike. With sound ghosts they differ by less than this many
/// times (Δx/h)².
const LOPSIDED_OF_SPACING: f64 = 0.1;
/// Over a bed paddle and wall cannot be compared. There still water presses by less than this share
/// more or less than ½ρgd², where it rests on three rows or more.
const OFF_OVER_BED: f64 = 0.05;
/// Where nothing makes a wave the force keeps within this share of that of still water.
const OFF_WHILE_STILL: f64 = 0.05;

impl Evidence<'_> {
    /// Still water that presses the wall otherwise than the paddle.
    pub(super) fn at_rest(&self) -> Option<String> {
        let apart = self
            .lopsided
            .filter(|apart| apart.abs() > LOPSIDED_OF_SPACING * self.spacing * self.spacing);
        apart.map(|apart| {
            let percent = 100.0 * apart;
            format!(
                "force at rest: still water pressed the wall {percent:+.2} % more than the paddle"
            )
        })
    }

    /// F\* counts from the force at rest. If that is wrong, so is all that follows.
    pub(super) fn at_rest_over_bed(&self, outcome: &Outcome) -> Option<String> {
        let off = outcome.force_at_rest - 1.0;
        let pressed = self.over_bed && outcome.force_at_rest != 0.0;
        (pressed && off.abs() > OFF_OVER_BED).then(|| {
            let (percent, how) = (100.0 * off.abs(), if off > 0.0 { "more" } else { "less" });
            format!(
                "force at rest: still water pressed the wall {percent:.0} % {how} than it should"
            )
        })
    }

    /// Noise that grows in water that should rest.
    pub(super) fn wanders(&self, outcome: &Outcome) -> Option<String> {
        let (most, end) = (outcome.force_max.value, outcome.force_end);
        // A wall that no particle touches is pressed by nothing.
        let least = if outcome.force_at_rest == 0.0 { 0.0 } else { 1.0 - OFF_WHILE_STILL };
        let off = |force: f64| !(least..=1.0 + OFF_WHILE_STILL).contains(&force);
        (self.stays_still && (off(most) || off(end))).then(|| {
            format!(
                "force at rest: still water did not stay still, F* was {most:.2} at most and {end:.2} at the end"
            )
        })
    }
}
