//! A bed that is not level: a line of straight stretches.

mod nearest;
mod still_water;
mod stretch;

use serde::{Deserialize, Deserializer, Serialize, de};

pub use stretch::{STEEP, Stretch, WALL, ends_low, turn};

/// Shorter stretches, metres, are not allowed.
const SHORTEST: f64 = 1e-9;

/// What one asks whose bed goes elsewhere than its tank.
pub const IN_METRES: &str = "are its points [x, y] in this order, and in metres?";

/// Points of a bed, metres, from the paddle to the wall. x never decreases, and two points at the
/// same x make a step. Before its first point and behind its last one the bed is level.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Profile(Vec<[f64; 2]>);

impl<'de> Deserialize<'de> for Profile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Profile, D::Error> {
        let points = Vec::deserialize(deserializer);
        let points = points.map_err(|_| de::Error::custom("must be a list of points [x, y]"))?;
        Profile::checked(points).map_err(de::Error::custom)
    }
}

impl Profile {
    /// # Errors
    /// Points that make no bed, in words.
    pub fn checked(points: Vec<[f64; 2]>) -> Result<Profile, String> {
        if points.len() < 2 {
            return Err("must have two points [x, y] or more".to_owned());
        }
        if let Some([x, y]) = points.iter().find(|point| !point.iter().all(|v| v.is_finite())) {
            return Err(format!("has a point [{x}, {y}]: both must be finite"));
        }
        if points[0] != [0.0, 0.0] {
            let [x, y] = points[0];
            return Err(format!("must begin at [0, 0], the foot of the paddle, not at [{x}, {y}]"));
        }
        for pair in points.windows(2) {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            if x1 < x0 {
                return Err(format!("goes back from x = {x0} m to {x1} m: {IN_METRES}"));
            }
            if (x1 - x0).hypot(y1 - y0) < SHORTEST {
                return Err(format!("has the point [{x0}, {y0}] twice"));
            }
        }
        Ok(Profile(points))
    }

    /// The points, metres.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// Where it ends, metres.
    pub fn end(&self) -> [f64; 2] {
        self.0[self.0.len() - 1]
    }

    /// Where it stops being level, from the paddle on, metres.
    pub fn level_up_to(&self) -> f64 {
        let first = self.0.iter().position(|point| point[1] != 0.0);
        first.map_or(self.end()[0], |first| self.0[first - 1][0])
    }

    /// Whether all of it is level.
    pub fn is_level(&self) -> bool {
        self.level_up_to() >= self.end()[0]
    }

    /// The same bed, extended by these lengths: before the paddle, and behind the wall if it ends
    /// level there; metres.
    pub(super) fn gone_on(&self, [before, behind]: [f64; 2]) -> Profile {
        let mut points = self.0.clone();
        points[0][0] -= before;
        if behind > 0.0 && self.ends_level() {
            let [x, y] = self.end();
            points.pop();
            points.push([x + behind, y]);
        }
        Profile(points)
    }

    /// Whether its last stretch is level.
    pub fn ends_level(&self) -> bool {
        self.0[self.0.len() - 2][1] == self.end()[1]
    }

    /// Whether its last stretch is upright.
    pub fn ends_upright(&self) -> bool {
        self.0[self.0.len() - 2][0] == self.end()[0]
    }

    /// Where it goes up and down, or down and up, at the same x, metres.
    pub fn plate(&self) -> Option<f64> {
        let turns = |of: &&[[f64; 2]]| {
            of[0][0] == of[2][0] && (of[1][1] - of[0][1]) * (of[2][1] - of[1][1]) < 0.0
        };
        self.0.windows(3).find(turns).map(|of| of[1][0])
    }

    /// Breadth of its narrowest trench between two steep faces, metres.
    pub fn narrowest_trench(&self) -> Option<f64> {
        let stretches: Vec<_> = self.stretches().collect();
        let trenches =
            stretches.windows(3).filter(|of| of[0].along[1] < -STEEP && of[2].along[1] > STEEP);
        trenches.map(|of| of[1].length).min_by(f64::total_cmp)
    }

    /// Its lowest and highest place, metres.
    pub fn range(&self) -> [f64; 2] {
        let heights = self.0.iter().map(|point| point[1]);
        [heights.clone().fold(f64::INFINITY, f64::min), heights.fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Height of the bed at x, metres; on a step the height behind it.
    pub fn height(&self, x: f64) -> f64 {
        let after = self.0.partition_point(|point| point[0] <= x);
        let Some(before) = after.checked_sub(1) else { return self.0[0][1] };
        let ([x0, y0], Some(&[x1, y1])) = (self.0[before], self.0.get(after)) else {
            return self.end()[1];
        };
        y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    }

    /// Its highest place between two x, metres.
    pub fn highest_between(&self, left: f64, right: f64) -> f64 {
        let first = self.0.partition_point(|point| point[0] < left);
        let between = self.0[first..].iter().take_while(|point| point[0] <= right);
        let ends = self.height(left).max(self.height(right));
        between.fold(ends, |highest, point| highest.max(point[1]))
    }

    /// Whether one of these places, neighbours in the water, may be nearer to it than `near`,
    /// metres, or below it. One look at the bed serves all of them.
    pub fn may_be_within(&self, [x, y]: [&[f64]; 2], near: f64) -> bool {
        let least = |row: &[f64]| row.iter().copied().fold(f64::INFINITY, f64::min);
        let most = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        least(y) - near <= self.highest_between(least(x) - near, most + near)
    }

    /// Area between it and a level above it, m². Dry stretches do not count.
    pub fn area_below(&self, level: f64) -> f64 {
        let stretch = |pair: &[[f64; 2]]| {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            let (low, high) = (level - y0.max(y1), level - y0.min(y1));
            let width = x1 - x0;
            match (low >= 0.0, high > 0.0) {
                (true, _) => 0.5 * width * (low + high),
                (false, true) => 0.5 * width * high * high / (high - low),
                _ => 0.0,
            }
        };
        self.0.windows(2).map(stretch).sum()
    }

    /// The stretches, as planes with their ends.
    pub fn stretches(&self) -> impl Iterator<Item = Stretch> + '_ {
        self.0.windows(2).map(|pair| Stretch::between(pair[0], pair[1]))
    }
}

#[cfg(test)]
mod tests;
