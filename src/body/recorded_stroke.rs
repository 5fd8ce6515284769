//! A paddle that plays a stroke from a file.

use serde::{Deserialize, Deserializer, Serialize, de};

use super::{BodyMotion, PaddleLaw};
use crate::keys::section;

section! {
    /// The keys of a recorded stroke.
    pub struct RecordedStrokeKeys in "scene" {
        /// Path, from where the program is started, of a CSV file with the columns `time_s` and
        /// `stroke_m`: three or more times that rise. The run's clock starts at the first. What it
        /// says is part of a case's identity, its name is not.
        recorded_stroke: Stroke, plain().only("paddle", &["recorded-stroke"]);
    }
}

/// Times, s, and positions, m, read from a CSV file. In a case they stand for the file, so that its
/// contents are part of the case's identity, and no other process needs it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Stroke(Vec<[f64; 2]>);

/// As a scene file gives it, and as a case has it.
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
            Given::Points(points) => Stroke::checked(points),
        };
        stroke.map_err(de::Error::custom)
    }
}

impl Stroke {
    /// Reads a file with the columns `time_s` and `stroke_m`.
    fn read(path: &str) -> Result<Stroke, String> {
        let mut reader =
            csv::Reader::from_path(path).map_err(|error| format!("cannot be read: {error}"))?;
        let columns = reader.headers().map_err(|error| error.to_string())?;
        if columns.iter().map(str::trim).ne(["time_s", "stroke_m"]) {
            return Err("must be a CSV file with the columns time_s and stroke_m".to_owned());
        }
        let mut points = Vec::new();
        for row in reader.records() {
            let row = row.map_err(|error| in_words(&error))?;
            let line = row.position().map_or(0, csv::Position::line);
            let cell = |place: usize| {
                let text = row.get(place).unwrap_or_default().trim();
                text.parse::<f64>().map_err(|_| format!("line {line}: {text:?} is no number"))
            };
            points.push([cell(0)?, cell(1)?]);
        }
        Stroke::checked(points)
    }

    fn checked(points: Vec<[f64; 2]>) -> Result<Stroke, String> {
        if points.len() < 3 {
            return Err("must have three points or more".to_owned());
        }
        if let Some([time, place]) = points.iter().find(|p| !p.iter().all(|v| v.is_finite())) {
            return Err(format!("has a point at {time} s, {place} m: both must be finite"));
        }
        if points[0][0] < 0.0 {
            return Err(format!("must begin at 0 s or later, not at {} s", points[0][0]));
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[1][0] <= pair[0][0]) {
            return Err(format!("goes from {} s back to {} s", pair[0][0], pair[1][0]));
        }
        Ok(Stroke(points))
    }

    /// The clock at its first point, seconds.
    pub fn start_s(&self) -> f64 {
        self.0[0][0]
    }

    /// The farthest that it goes from its first position, metres.
    pub fn reach(&self) -> f64 {
        let start = self.0[0][1];
        self.0.iter().map(|point| (point[1] - start).abs()).fold(0.0, f64::max)
    }
}

/// What is wrong with a line, in words.
fn in_words(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos: Some(position), len, .. } => {
            format!("line {}: must have two columns, not {len}", position.line())
        }
        _ => error.to_string(),
    }
}

/// A cubic spline through the points of a stroke, at rest at both ends, relative to the first. It
/// stays where the last point is.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedStroke {
    points: Vec<[f64; 2]>,
    /// Velocity at each point, m/s.
    velocities: Vec<f64>,
}

impl RecordedStroke {
    /// Of a stroke.
    pub fn new(stroke: &Stroke) -> RecordedStroke {
        let start = stroke.0[0][1];
        let points: Vec<_> = stroke.0.iter().map(|&[time, at]| [time, at - start]).collect();
        // No jump of acceleration: h₊ v₋ + 2 (h₋ + h₊) v + h₋ v₊ = 3 (h₊ s₋ + h₋ s₊), s the slopes.
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
        RecordedStroke { points, velocities }
    }
}

impl PaddleLaw for RecordedStroke {
    fn motion(&self, time: f64) -> BodyMotion {
        let after = self.points.partition_point(|point| point[0] <= time);
        let Some(&[t1, x1]) = self.points.get(after) else {
            let end = self.points.last().map_or(0.0, |point| point[1]);
            return BodyMotion { offset: end, ..BodyMotion::default() };
        };
        let Some(&[t0, x0]) = after.checked_sub(1).map(|k| &self.points[k]) else {
            return BodyMotion::default();
        };
        let (span, [v0, v1]) = (t1 - t0, [self.velocities[after - 1], self.velocities[after]]);
        let (u, slope) = ((time - t0) / span, (x1 - x0) / span);
        // x0 + span (v0 u + b u² + c u³)
        let (b, c) = (3.0 * slope - 2.0 * v0 - v1, v0 + v1 - 2.0 * slope);
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
        self.points.iter().map(|point| -point[1]).fold(0.0, f64::max)
    }

    fn goes_forth(&self) -> f64 {
        self.points.iter().map(|point| point[1]).fold(0.0, f64::max)
    }

    fn still_from(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::Shape;

    fn smooth(time: f64) -> f64 {
        0.1 - 0.1 * libm::cos(time)
    }

    #[test]
    fn it_goes_through_its_points_smoothly_and_stays_at_the_last() {
        // Uneven times, from rest to rest: half a period of a cosine.
        let times: Vec<_> = (0..=20).map(|k| f64::from(k) / 20.0).collect();
        let times = times.iter().map(|s| std::f64::consts::PI * s * (0.7 + 0.3 * s));
        let points: Vec<_> = times.map(|time| [time, 5.0 + smooth(time)]).collect();
        let end = points[20][0];
        let paddle = RecordedStroke::new(&Stroke::checked(points.clone()).unwrap());
        for &[time, place] in &points {
            assert!((paddle.motion(time).offset - (place - 5.0)).abs() < 1e-15);
            let [before, after] = [-1e-9, 1e-9].map(|off| paddle.motion(time + off));
            assert!((before.velocity - after.velocity).abs() < 1e-9);
            let inside = time > 0.0 && time < end;
            assert!(!inside || (before.acceleration - after.acceleration).abs() < 1e-6);
        }
        for k in 0..100 {
            let time = end * f64::from(k) / 100.0;
            let motion = paddle.motion(time);
            assert!((motion.offset - smooth(time)).abs() < 1e-6, "{time}");
            assert!((motion.velocity - 0.1 * libm::sin(time)).abs() < 1e-4, "{time}");
            assert!((motion.acceleration - 0.1 * libm::cos(time)).abs() < 2e-3, "{time}");
        }
        let later = paddle.motion(end + 1.0);
        assert_eq!((later.offset, later.velocity), (points[20][1] - 5.0, 0.0));
        assert_eq!(paddle.still_from(), end);
    }

    #[test]
    fn a_file_gives_its_path() {
        assert_eq!(Shape::of::<Stroke>(), Shape::Text);
    }

    #[test]
    fn a_bad_file_is_told_with_its_line() {
        let told = |text: &str| {
            let file = std::env::temp_dir().join(format!("stroke_{}.csv", std::process::id()));
            std::fs::write(&file, text).unwrap();
            let read = Stroke::read(file.to_str().unwrap());
            std::fs::remove_file(file).unwrap();
            read.map(|stroke| stroke.0.len())
        };
        assert_eq!(told("time_s,stroke_m\n0,0\n1, 0.1\n2,0.3\n"), Ok(3));
        let bad = [
            ("t,x\n0,0\n", "must be a CSV file with the columns time_s and stroke_m"),
            ("time_s,stroke_m\n0,0\n1,a\n", "line 3: \"a\" is no number"),
            ("time_s,stroke_m\n0,0\n1,2\n", "must have three points or more"),
            ("time_s,stroke_m\n-1,0\n2,0\n3,0\n", "must begin at 0 s or later, not at -1 s"),
            ("time_s,stroke_m\n0,0\n2,0\n1,0\n", "goes from 2 s back to 1 s"),
            ("time_s,stroke_m\n0,0\n1,inf\n2,0\n", "has a point at 1 s, inf m: both"),
        ];
        for (text, message) in bad {
            let told = told(text).unwrap_err();
            assert!(told.starts_with(message), "{told}");
        }
        assert!(Stroke::read("no/such/file.csv").unwrap_err().starts_with("cannot be read"));
    }
}
