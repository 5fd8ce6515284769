//! A bed in still water: which of its stretches are covered, and which rise out of it.

use super::Profile;
use super::stretch::{Stretch, ends_low};

impl Profile {
    /// Whether still water of this depth covers a stretch steeper than `rise`: its rise or fall per
    /// length.
    pub fn is_steep_under(&self, depth: f64, rise: f64) -> bool {
        self.stretches().any(|stretch| stretch.rise() > rise && stretch.heights()[1] < depth)
    }

    /// Whether such a stretch rises out of still water of this depth.
    pub fn is_steep_at(&self, depth: f64, rise: f64) -> bool {
        let through = |stretch: &Stretch| {
            let [low, high] = stretch.heights();
            low < depth && high >= depth
        };
        self.stretches().any(|stretch| stretch.rise() > rise && through(&stretch))
    }

    /// Whether such a stretch ends in still water of this depth, within `near` of its surface; both
    /// in metres.
    pub fn is_steep_just_under(&self, depth: f64, rise: f64, near: f64) -> bool {
        let ends = |stretch: &Stretch| (depth - near..depth).contains(&stretch.heights()[1]);
        self.stretches().any(|stretch| stretch.rise() > rise && ends(&stretch))
    }

    /// Whether one of its faces rises out of still water of this depth and ends low above it; all
    /// in metres.
    pub fn ends_low(&self, depth: f64, reach: [f64; 2]) -> bool {
        let stretches: Vec<_> = self.stretches().collect();
        stretches.windows(2).any(|of| ends_low([&of[0], &of[1]], depth, reach))
    }

    /// Whether it ends dry, above still water of this depth and below a level; both in metres.
    pub fn ends_dry(&self, depth: f64, below: f64) -> bool {
        (depth..below).contains(&self.end()[1])
    }

    /// Whether it rises to a shore of still water of this depth without falling. This is asked from
    /// where the water is no thicker than `thickness` onwards; both in metres.
    pub fn rises_where_thinner(&self, depth: f64, thickness: f64) -> bool {
        let thick = |stretch: &Stretch| stretch.heights()[1] <= depth - thickness;
        self.stretches().skip_while(thick).all(|stretch| {
            let rise = stretch.along[1];
            rise > 0.0 || rise == 0.0 && stretch.from[1] >= depth
        })
    }

    /// Whether still water of this depth stands at its end, behind a place that rises out of it.
    pub fn has_lagoon(&self, depth: f64) -> bool {
        let [_, top] = self.range();
        self.end()[1] < depth && depth <= top
    }

    /// Where the shore of still water of this depth begins. From there up to the dry bed the water
    /// is nowhere deeper than `shallow`; all in metres.
    pub fn shore(&self, depth: f64, shallow: f64) -> Option<f64> {
        let dry = self.points().iter().position(|point| point[1] >= depth)?;
        let deep = self.points()[..dry].iter().rposition(|point| point[1] <= depth - shallow)?;
        let ([x0, y0], [x1, y1]) = (self.points()[deep], self.points()[deep + 1]);
        Some(x0 + (x1 - x0) * (depth - shallow - y0) / (y1 - y0))
    }
}
