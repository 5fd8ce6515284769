//! The surface of the water that stands on the bed, for stills.

use super::stage::{Stage, View, WallKind};
use super::take::Take;

/// Width of a bin, spacings.
const BIN: f64 = 1.5;
/// In undisturbed water the next particle above is at most this many spacings away.
const APART: f64 = 2.5;
/// Particles of a bin within this many spacings above and below belong to a row, however steep it
/// is.
const ROW: f64 = 1.5;
/// Where a jet is narrow, rows move apart in proportion to the number of particles in a bin of a
/// row, because water keeps its area. This is larger than their share, because no row is level.
const SHARE: f64 = 1.2 / BIN;

/// The top of the water that stands on the bed, in bins along the tank.
pub(super) struct Tops {
    left: f64,
    spacing: f64,
    /// The heights of a bin's particles, in rising order.
    bins: Vec<Vec<f64>>,
    /// None where there is no such water.
    heights: Vec<Option<f64>>,
}

impl Tops {
    /// In every bin it goes up from the bed, or from a wall that leans over it, to the first gap.
    pub fn of(stage: &Stage, take: &Take, view: &View) -> Tops {
        let spacing = stage.spacing;
        // Bins end at the wall. A bin that is cut by it would have too few particles.
        let wall = stage.length + take.walls[1];
        let left = wall - ((wall - view.x0) / (BIN * spacing)).ceil() * BIN * spacing;
        let open = stage.wall != WallKind::None && stage.lid.is_none();
        let count = if open { ((view.x1 - left) / (BIN * spacing)).ceil() as usize } else { 0 };
        let mut tops = Tops { left, spacing, bins: vec![Vec::new(); count], heights: Vec::new() };
        for &[x, y, _] in &take.points {
            if let Some(bin) = tops.bin(f64::from(x)) {
                tops.bins[bin].push(f64::from(y));
            }
        }
        tops.bins.iter_mut().for_each(|heights| heights.sort_by(f64::total_cmp));
        let lean = (stage.angle - 90.0).to_radians().tan();
        let climb = |bin: usize| {
            let middle = tops.middle(bin);
            let behind = middle - wall;
            let bed = stage.bed_at(middle);
            // An upright side of a basin cuts a bin. The bin's middle is in the wall, and its
            // particles are no column.
            let highest = tops.bins[bin].last().copied().unwrap_or(bed);
            if bed - highest > BIN * spacing {
                return None;
            }
            tops.climb(bin, if lean > 0.0 { (behind / lean).max(bed) } else { bed })
        };
        let heights: Vec<_> = (0..count).map(climb).collect();
        Tops { heights: closed(&heights), ..tops }
    }

    /// Half a spacing above the highest particle that is reached without gaps.
    fn climb(&self, bin: usize, from: f64) -> Option<f64> {
        let mut top = from;
        let near = |y: &f64| {
            let near = y - top <= self.gap(bin, *y);
            top = if near { *y } else { top };
            near
        };
        let last = self.bins[bin].iter().copied().take_while(near).last();
        last.map(|top| top + 0.5 * self.spacing)
    }

    fn bin(&self, x: f64) -> Option<usize> {
        let bin = ((x - self.left) / (BIN * self.spacing)).floor();
        (bin >= 0.0 && bin < self.bins.len() as f64).then_some(bin as usize)
    }

    fn middle(&self, bin: usize) -> f64 {
        self.left + (bin as f64 + 0.5) * BIN * self.spacing
    }

    /// Height of the water of a particle's row, less the height over which the row itself extends.
    fn gap(&self, bin: usize, y: f64) -> f64 {
        let (heights, reach) = (&self.bins[bin], ROW * self.spacing);
        let below = |limit: f64| heights.partition_point(|height| *height < limit);
        let row = &heights[below(y - reach)..below(y + reach)];
        let high = row.last().zip(row.first()).map_or(0.0, |(last, first)| last - first);
        (APART * self.spacing).max(SHARE * self.spacing * row.len() as f64 - high)
    }

    /// How far apart rows may be at a particle.
    pub fn apart(&self, x: f64, y: f64) -> f64 {
        self.bin(x).map_or(APART * self.spacing, |bin| self.gap(bin, y))
    }

    /// Linear interpolation between the middles of bins.
    pub fn at(&self, x: f64) -> Option<f64> {
        let along = ((x - self.left) / (BIN * self.spacing) - 0.5).max(0.0);
        let bin = along as usize;
        let low = (*self.heights.get(bin)?)?;
        let high = self.heights.get(bin + 1).copied().flatten().unwrap_or(low);
        Some(low + (along - bin as f64) * (high - low))
    }

    /// The surface as lines through the tops of bins. Each goes to the end of its last bin, which is
    /// the wall if that is upright. A line ends where more than one bin has no water.
    pub fn lines(&self) -> Vec<Vec<[f64; 2]>> {
        let wet = |&bin: &usize| self.heights[bin].is_some();
        let wet: Vec<usize> = (0..self.heights.len()).filter(wet).collect();
        let line = |run: &[usize]| {
            let points = run.iter().filter_map(|&bin| Some([self.middle(bin), self.heights[bin]?]));
            let mut line: Vec<_> = points.collect();
            line.extend(line.last().map(|[x, top]| [x + 0.5 * BIN * self.spacing, *top]));
            line
        };
        wet.chunk_by(|bin, next| next - bin <= 2).map(line).collect()
    }
}

/// Without dips of one or two bins: a gap between particles is no trough of the surface.
fn closed(heights: &[Option<f64>]) -> Vec<Option<f64>> {
    let at = |bin: usize| heights.get(bin.wrapping_sub(1)).copied().flatten();
    let highest = |bin: usize| {
        [bin.wrapping_sub(1), bin, bin + 1].into_iter().filter_map(at).reduce(f64::max)
    };
    let lowest =
        |bin: usize| [bin - 1, bin, bin + 1].into_iter().filter_map(highest).reduce(f64::min);
    (1..=heights.len()).map(|bin| at(bin).and_then(|_| lowest(bin))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_between_particles_is_no_trough() {
        let tops = |heights: &[f64]| -> Vec<_> {
            let known = |height: &f64| (*height > 0.0).then_some(*height);
            closed(&heights.iter().map(known).collect::<Vec<_>>())
                .into_iter()
                .map(|top| top.unwrap_or(0.0))
                .collect()
        };
        assert_eq!(tops(&[1.0, 2.0, 0.5, 0.4, 3.0, 4.0]), [1.0, 2.0, 2.0, 2.0, 3.0, 4.0]);
        let slope = [1.0, 1.5, 2.0, 4.0, 3.0, 1.0];
        assert_eq!(tops(&slope), slope);
        let trough = [3.0, 1.0, 1.0, 1.0, 3.0];
        assert_eq!(tops(&trough), trough);
        assert_eq!(tops(&[0.0, 2.0, 1.0, 2.0, 0.0]), [0.0, 2.0, 2.0, 2.0, 0.0]);
    }

    /// The top of a bin with rows of these numbers of particles, at these heights in spacings.
    fn top(rows: &[(usize, f64)]) -> f64 {
        let heights = rows.iter().flat_map(|&(count, y)| vec![y; count]).collect();
        let tops = Tops { left: 0.0, spacing: 1.0, bins: vec![heights], heights: Vec::new() };
        tops.climb(0, 0.0).unwrap()
    }

    #[test]
    fn a_squeezed_jet_is_water_and_spray_is_not() {
        let still = [(1, 0.5), (2, 1.5), (1, 2.5)];
        assert_eq!(top(&still), 3.0);
        assert_eq!(top(&[&still[..], &[(1, 5.7)]].concat()), 3.0, "a drop");
        assert_eq!(top(&[&still[..], &[(5, 5.7), (5, 8.9)]].concat()), 9.4, "rows of five");
        assert_eq!(top(&[&still[..], &[(5, 7.0)]].concat()), 3.0, "a sheet that flies");
    }

    #[test]
    fn a_steep_row_is_water_where_it_is_squeezed() {
        // Near the largest runup at a fixed wall, steep rows once counted as spray, and the surface
        // had notches there.
        let still = [(1, 0.5), (2, 1.5), (1, 2.5)];
        let steep = |apart: f64| -> Vec<_> {
            let count = (3.0 / apart) as usize;
            (0..=count).map(|k| (1, 6.5 + apart * k as f64)).collect()
        };
        assert_eq!(top(&[&still[..], &steep(0.125)].concat()), 10.0);
        assert_eq!(top(&[&still[..], &steep(0.5)].concat()), 3.0, "spray, one above the other");
    }

    /// The sides of a basin cut bins, and the surface once fell to the floor there.
    #[test]
    fn the_surface_of_a_basin_goes_on_to_its_sides() {
        let scene = "behind = \"basin\"\ncrest_freeboard_m = 0.08\ncrest_width_m = 0.1\nfloor_height_m = 0\n\
                     floor_length_m = 0.4\nbasin_level_m = 0.1\nwave_height_ratio = 0.5";
        let config = crate::scene::CaseConfig::of(scene, "particle_spacing_m = 0.01");
        let particle = |k: usize| {
            // Columns begin and end beside the basin's sides.
            let [x, y] = [2.6 + 0.01 * (k / 10) as f64, 0.01 * (k % 10) as f64];
            [(x + 0.005) as f32, (y + 0.005) as f32, 0.0]
        };
        let mut points: Vec<_> = (0..400).map(particle).collect();
        points.push([2.6005, 0.005, 0.0]);
        points.push([2.9995, 0.005, 0.0]);
        let take = Take { time_s: 0.0, walls: [0.0; 2], points };
        let stage = Stage::of(&config, std::slice::from_ref(&take));
        let tops = Tops::of(&stage, &take, &stage.whole);
        let lines = tops.lines();
        assert!(lines.iter().flatten().count() > 20);
        for [x, top] in lines.into_iter().flatten() {
            assert!((top - 0.1).abs() < 0.011, "{top} m at {x} m");
        }
    }

    #[test]
    fn no_line_goes_through_the_air() {
        let heights = [Some(1.0), None, Some(1.1), None, None, Some(3.0), None, None, Some(0.5)];
        let tops =
            Tops { left: 0.0, spacing: 1.0, bins: vec![Vec::new(); 9], heights: heights.into() };
        let ends: Vec<_> =
            tops.lines().iter().map(|line| (line[0], *line.last().unwrap())).collect();
        assert_eq!(
            ends,
            [([0.75, 1.0], [4.5, 1.1]), ([8.25, 3.0], [9.0, 3.0]), ([12.75, 0.5], [13.5, 0.5]),]
        );
    }
}
