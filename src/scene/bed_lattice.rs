//! The particles at the start over a bed that is not level.

use crate::boundary::{Profile, Stretch};

/// The rest of a column is spread over this many rows, upwards from the bed. The rest before a step
/// is spread over this many columns.
const SPREAD: f64 = 8.0;

/// Smaller differences than this share of a column are ignored.
const FITS: f64 = 1e-6;

/// Columns of particles in level rows from the still surface down. Between the lowest whole row and
/// the bed there is a rest of up to half a row, more or less. It is spread over the lowest rows of
/// its column. The rest between the last whole column and the face of an upright step is spread
/// over the columns before the step.
pub(super) struct BedLattice<'a> {
    pub profile: &'a Profile,
    pub columns: usize,
    /// Of columns and of rows, metres.
    pub spacing: [f64; 2],
    /// Height of the still surface, metres.
    pub surface: f64,
    /// Rows on top of it.
    pub rows_above: usize,
}

impl BedLattice<'_> {
    /// Particles over the bed: (x, y, area), those below the still surface first.
    pub(super) fn points(&self) -> Vec<[f64; 3]> {
        let [dx, dy] = self.spacing;
        let mut below = Vec::new();
        let mut above = Vec::new();
        let steps = self.steps();
        for column in 0..self.columns {
            let x = (column as f64 + 0.5) * dx;
            let bed = self.profile.height(x);
            let depth = self.surface - bed;
            let rows = (depth / dy).round().max(0.0);
            let spread = rows.min(SPREAD);
            let stretched = dy + (depth - rows * dy) / spread.max(1.0);
            for row in 0..rows as usize {
                let lowest = row as f64;
                let (y, height) = if lowest < spread {
                    (bed + (lowest + 0.5) * stretched, stretched)
                } else {
                    (self.surface - (rows - lowest - 0.5) * dy, dy)
                };
                let place = |step: &Step| step.fitted([x, y]);
                let [x, width] = steps.iter().find_map(place).unwrap_or([x, 1.0]);
                below.push([x, y, dx * width * height]);
            }
            for row in 0..self.rows_above {
                let y = self.surface + (row as f64 + 0.5) * dy;
                if y > bed + 0.5 * dy {
                    above.push([x, y, dx * dy]);
                }
            }
        }
        below.append(&mut above);
        below
    }

    /// The upright steps whose faces are not between two columns.
    fn steps(&self) -> Vec<Step> {
        let dx = self.spacing[0];
        let upright: Vec<_> = self.profile.stretches().filter(|it| it.along[0] == 0.0).collect();
        let walls = [0.0, self.columns as f64 * dx];
        let step = |it: &Stretch| {
            let x = it.from[0];
            let others = upright.iter().map(|other| other.from[0]).chain(walls);
            let away = others.map(|other| (other - x).abs()).filter(|&away| away > 0.0);
            let ends = [it.from[1], it.from[1] + it.along[1] * it.length];
            let before = (0..self.columns).take_while(|&column| (column as f64 + 0.5) * dx < x);
            let between = before.count() as f64 * dx;
            let span = away.fold(SPREAD, |least, away| least.min(0.5 * away / dx));
            Step {
                between,
                off: x - between,
                water: -it.along[1].signum(),
                heights: [ends[0].min(ends[1]), ends[0].max(ends[1])],
                span: span.floor().max(1.0) * dx,
            }
        };
        upright.iter().map(step).filter(|step| step.off.abs() > FITS * dx).collect()
    }
}

/// The face of a step that lies across a column, metres.
struct Step {
    /// The place between two columns where it would fit.
    between: f64,
    /// Its distance from there.
    off: f64,
    /// On which side of it the water is.
    water: f64,
    heights: [f64; 2],
    /// The length over which the rest is spread.
    span: f64,
}

impl Step {
    /// The new x of a particle before the face, and its breadth over that of its column.
    fn fitted(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let away = self.water * (x - self.between);
        let before = (0.0..self.span).contains(&away) && y > self.heights[0] && y < self.heights[1];
        let place = x + self.off * (1.0 - away / self.span);
        before.then(|| [place, 1.0 - self.water * self.off / self.span])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_fill_the_water_and_lie_in_it() {
        let points = vec![[0.0, 0.0], [1.0, 0.0], [3.0, 0.3]];
        let profile = Profile::checked(points).unwrap();
        let lattice = BedLattice {
            profile: &profile,
            columns: 150,
            spacing: [0.02; 2],
            surface: 0.2,
            rows_above: 0,
        };
        let points = lattice.points();
        let area: f64 = points.iter().map(|point| point[2]).sum();
        // Except for the tip of the wedge, thinner than half a row.
        assert!((area / profile.area_below(0.2) - 1.0).abs() < 2e-3, "{area}");
        for &[x, y, _] in &points {
            assert!(y < 0.2 && y > profile.height(x), "{x} {y}");
        }
        let more = BedLattice { rows_above: 4, ..lattice };
        assert_eq!(more.points()[..lattice.points().len()], lattice.points());
    }

    #[test]
    fn columns_fill_the_water_before_a_step_that_lies_across_one() {
        for at in [1.0, 1.005, 1.01, 1.015, 1.02] {
            for points in [
                vec![[0.0, 0.0], [at, 0.0], [at, 0.1], [2.0, 0.1]],
                vec![[0.0, 0.0], [0.5, 0.1], [at, 0.1], [at, 0.0], [2.0, 0.0]],
            ] {
                let profile = Profile::checked(points).unwrap();
                let spacing = [0.02; 2];
                let rest = BedLattice {
                    profile: &profile,
                    columns: 100,
                    spacing,
                    surface: 0.2,
                    rows_above: 0,
                };
                let points = rest.points();
                let area: f64 = points.iter().map(|point| point[2]).sum();
                assert!((area / profile.area_below(0.2) - 1.0).abs() < 1e-3, "{at}: {area}");
                let low = points.iter().filter(|point| point[1] < 0.1);
                let nearest = low.map(|point| (point[0] - at).abs()).fold(1.0, f64::min);
                assert!((nearest - 0.01).abs() < 1e-3, "{at}: {nearest}");
            }
        }
    }
}
