//! Where particles stand at the start over a bed that is not level.

use crate::boundary::Profile;

/// Rows over which what does not fit a column is spread, upwards from the bed.
const SPREAD: f64 = 8.0;

/// Columns of particles in level rows from the still surface down. What is left between the lowest whole
/// row and the bed, half a row more or less, is spread over the lowest rows of its column.
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
                below.push([x, y, dx * height]);
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
        // But for the tip of the wedge, thinner than half a row.
        assert!((area / profile.area_below(0.2) - 1.0).abs() < 2e-3, "{area}");
        for &[x, y, _] in &points {
            assert!(y < 0.2 && y > profile.height(x), "{x} {y}");
        }
        let more = BedLattice { rows_above: 4, ..lattice };
        assert_eq!(more.points()[..lattice.points().len()], lattice.points());
    }
}
