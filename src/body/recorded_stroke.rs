//! A paddle that plays a stroke from a file.

mod file;
mod shape;

use serde::{Deserialize, Deserializer, Serialize, de};

use self::file::rows;
use self::shape::{hole, sets_off, speeds, turns, widest};
use super::{BodyMotion, PaddleLaw};
use crate::keys::{Shared, section};

section! {
    /// The keys of a recorded stroke.
    pub struct RecordedStrokeKeys in "scene" {
        /// Path, from where the program is started, of a CSV file with the columns `time_s` and
        /// `stroke_m`: three or more times that rise. The run's clock starts at the first. What it
        /// says is part of a case's identity, its name is not.
        recorded_stroke: Stroke, plain().only("paddle", &["recorded-stroke"]);
    }
}

/// A stroke that turns so often makes one wave after another.
const TURNS: usize = 3;

/// Times, s, and positions, m, read from a CSV file. In a case they replace the file's name. So the
/// contents are part of the case's identity, and no other process needs the file.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Stroke(Shared<Played>);

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
struct Played {
    points: Vec<[f64; 2]>,
    /// How far the spline through them goes back and forth, metres.
    #[serde(skip)]
    range: [f64; 2],
    /// How often it turns back.
    #[serde(skip)]
    turns: usize,
}

/// As in a scene file, or as in a case.
#[derive(Deserialize)]
#[serde(untagged, expecting = "must be the path of a CSV file")]
enum Given {
    Path(String),
    Points(Vec<[f64; 2]>),
}

impl<'de> Deserialize<'de> for Stroke {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Stroke, D::Error> {
        let stroke = match Given::deserialize(deserializer)? {
            Given::Path(path) => Stroke::read(&path),
            Given::Points(points) => Stroke::checked(points, &[]),
        };
        stroke.map_err(de::Error::custom)
    }
}

impl Stroke {
    /// Reads a file with the columns `time_s` and `stroke_m`.
    fn read(path: &str) -> Result<Stroke, String> {
        let rows: Vec<_> = rows(path)?.collect::<Result<_, _>>()?;
        let (points, lines): (_, Vec<_>) = rows.into_iter().unzip();
        Stroke::checked(points, &lines)
    }

    /// The clock at the first point of a file, s; `None` where it cannot be read.
    pub fn start_of(path: &str) -> Option<f64> {
        rows(path).ok()?.next()?.ok().map(|([time, _], _)| time)
    }

    /// `lines` has the line of each point in its file; empty if the points come from no file.
    fn checked(points: Vec<[f64; 2]>, lines: &[u64]) -> Result<Stroke, String> {
        if points.len() < 3 {
            return Err("must have three points or more".to_owned());
        }
        let wrong = |at: usize, why: String| {
            let line = lines.get(at).map(|line| format!("line {line}: ")).unwrap_or_default();
            Err(line + &why)
        };
        if let Some(at) = points.iter().position(|p| !p.iter().all(|v| v.is_finite())) {
            let [time, place] = points[at];
            return wrong(at, format!("has a point at {time} s, {place} m: both must be finite"));
        }
        if points[0][0] < 0.0 {
            return wrong(0, format!("must begin at 0 s or later, not at {} s", points[0][0]));
        }
        if let Some(at) = points.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
            let [before, after] = [points[at][0], points[at + 1][0]];
            let how = if after == before {
                format!("has two points at {before} s")
            } else {
                format!("goes from {before} s back to {after} s")
            };
            return wrong(at + 1, format!("{how}: times must rise"));
        }
        let range = RecordedStroke::through(&points).range;
        let turns = turns(&points);
        Ok(Stroke(Shared::from(Played { points, range, turns })))
    }

    /// The clock at its first point, seconds.
    pub fn start_s(&self) -> f64 {
        self.0.points[0][0]
    }

    /// The farthest that the spline through it goes from its first position, metres.
    pub fn reach(&self) -> f64 {
        let [back, forth] = self.0.range;
        forth.max(-back)
    }

    /// Where it ends, from its first position, metres.
    pub fn ends_at(&self) -> f64 {
        self.0.points.last().map_or(0.0, |last| last[1] - self.0.points[0][1])
    }

    /// Its speeds at the first points, at the last ones and the largest, m/s.
    pub fn speeds(&self) -> [f64; 3] {
        speeds(&self.0.points)
    }

    /// When the paddle has gone a tenth of its reach, seconds; none if it stands still.
    pub fn sets_off_s(&self) -> Option<f64> {
        sets_off(&self.0.points, self.reach())
    }

    /// How much farther than the points the spline goes, back or forth, metres.
    pub fn overshoot(&self) -> f64 {
        let Played { points, range, .. } = &*self.0;
        let start = points[0][1];
        let [back, forth] = widest(points.iter().map(|point| point[1] - start));
        (range[1] - forth).max(back - range[0])
    }

    /// Whether it makes one wave after another. One takes a way forth, and at most the way back.
    pub fn goes_on(&self) -> bool {
        self.turns() >= TURNS
    }

    /// How often it turns back, small swings aside.
    pub fn turns(&self) -> usize {
        self.0.turns
    }

    /// The points beside the widest gap across which it moves, and the usual distance of points, s.
    pub fn hole(&self) -> Option<([[f64; 2]; 2], f64)> {
        hole(&self.0.points, self.reach())
    }
}

/// A cubic spline through the points of a stroke, from the first on, at rest at its ends and after.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedStroke {
    points: Vec<[f64; 2]>,
    /// Velocity at each point, m/s.
    velocities: Vec<f64>,
    /// How far it goes back (zero or less) and forth, between its points too, metres.
    range: [f64; 2],
}

impl RecordedStroke {
    /// Of a stroke.
    pub fn new(stroke: &Stroke) -> RecordedStroke {
        RecordedStroke::through(&stroke.0.points)
    }

    fn through(points: &[[f64; 2]]) -> RecordedStroke {
        let start = points[0][1];
        let points: Vec<_> = points.iter().map(|&[time, at]| [time, at - start]).collect();
        // Continuous acceleration: h₊ v₋ + 2 (h₋ + h₊) v + h₋ v₊ = 3 (h₊ s₋ + h₋ s₊), slopes s.
        let (mut velocities, mut above) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        for k in 1..points.len() - 1 {
            let [before, here, after] = [points[k - 1], points[k], points[k + 1]];
            let (left, right) = (here[0] - before[0], after[0] - here[0]);
            let slopes = [(here[1] - before[1]) / left, (after[1] - here[1]) / right];
            let middle = 2.0 * (left + right) - right * above[k - 1];
            let aim = 3.0 * (right * slopes[0] + left * slopes[1]);
            above[k] = left / middle;
            velocities[k] = (aim - right * velocities[k - 1]) / middle;
        }
        for k in (1..points.len() - 1).rev() {
            velocities[k] -= above[k] * velocities[k + 1];
        }
        let mut spline = RecordedStroke { points, velocities, range: [0.0; 2] };
        let turns = (0..spline.points.len() - 1).flat_map(|k| spline.turns(k));
        spline.range = widest(spline.points.iter().map(|point| point[1]).chain(turns));
        spline
    }

    /// The stretch that begins at a point: its span, s, and v0, b, c of x0 + span (v0 u + b u² + c
    /// u³).
    fn stretch(&self, k: usize) -> (f64, [f64; 3]) {
        let ([t0, x0], [t1, x1]) = (self.points[k], self.points[k + 1]);
        let (span, [v0, v1]) = (t1 - t0, [self.velocities[k], self.velocities[k + 1]]);
        let slope = (x1 - x0) / span;
        (span, [v0, 3.0 * slope - 2.0 * v0 - v1, v0 + v1 - 2.0 * slope])
    }

    /// The positions at which the paddle turns within a stretch, v0 + 2 b u + 3 c u² = 0, metres.
    fn turns(&self, k: usize) -> impl Iterator<Item = f64> + use<> {
        let (span, [v0, b, c]) = self.stretch(k);
        let x0 = self.points[k][1];
        let root = (b * b - 3.0 * c * v0).sqrt();
        let q = -(b + root.copysign(b));
        // NaN, or outside the stretch, if it does not turn.
        let within = [q / (3.0 * c), v0 / q].into_iter().filter(|u| (0.0..1.0).contains(u));
        within.map(move |u| x0 + span * u * (v0 + u * (b + u * c)))
    }
}

impl PaddleLaw for RecordedStroke {
    fn motion(&self, time: f64) -> BodyMotion {
        let after = self.points.partition_point(|point| point[0] <= time);
        if after == self.points.len() {
            let end = self.points.last().map_or(0.0, |point| point[1]);
            return BodyMotion { offset: end, ..BodyMotion::default() };
        }
        let Some(k) = after.checked_sub(1) else { return BodyMotion::default() };
        let ([t0, x0], (span, [v0, b, c])) = (self.points[k], self.stretch(k));
        let u = (time - t0) / span;
        BodyMotion {
            offset: x0 + span * u * (v0 + u * (b + u * c)),
            velocity: v0 + u * (2.0 * b + 3.0 * c * u),
            acceleration: (2.0 * b + 6.0 * c * u) / span,
        }
    }

    fn stroke_centre(&self) -> Option<f64> {
        None
    }

    fn goes_back(&self) -> f64 {
        -self.range[0]
    }

    fn goes_forth(&self) -> f64 {
        self.range[1]
    }

    fn still_from(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }
}

#[cfg(test)]
mod tests;
