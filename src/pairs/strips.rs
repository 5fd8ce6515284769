//! A sorted point set: vertical strips, by height within each.

use std::ops::Range;

/// Points sorted into strips of equal width, by y within a strip, upwards and downwards in turn. So
/// any eight consecutive points lie close together, even across a change of strip.
#[derive(Debug, Clone, Default)]
pub struct Strips {
    origin: f64,
    width: f64,
    starts: Vec<u32>,
    shelves: Shelves,
}

/// A strip holds this many columns of particles: eight particles then form a square.
const STRIP_COLUMNS: f64 = 2.83;
/// Points farther out than this many strips share the last one, so that a runaway particle takes no
/// memory.
const MOST_STRIPS: usize = 100_000;

/// The strip of a place, counted from an origin.
#[inline(always)]
fn strip(x: f64, origin: f64, width: f64) -> usize {
    // Places before the origin, and NaN, are in the first strip.
    (((x - origin) / width) as usize).min(MOST_STRIPS - 1)
}

/// Number of points of a strip below certain heights. There are as many shelves of equal height as
/// points.
#[derive(Debug, Clone, Default)]
struct Shelves {
    /// Of each strip: the lowest height, and shelves per metre.
    scales: Vec<[f64; 2]>,
    /// For each strip: how many points are below each shelf, then the number of points.
    below: Vec<u32>,
}

impl Shelves {
    /// The shelf of a height, of `count` shelves. It never decreases with height.
    #[inline(always)]
    fn shelf([bottom, per_metre]: [f64; 2], count: usize, height: f64) -> usize {
        // Heights below the bottom, and NaN, are on the lowest shelf.
        (((height - bottom) * per_metre) as usize).min(count - 1)
    }

    fn clear(&mut self) {
        self.scales.clear();
        self.below.clear();
    }

    /// Adds the next strip, of points sorted upwards or downwards.
    fn push(&mut self, heights: impl ExactSizeIterator<Item = f64> + DoubleEndedIterator + Clone) {
        let count = heights.len();
        let start = self.below.len();
        self.below.resize(start + count + 1, 0);
        let ends = (heights.clone().next(), heights.clone().next_back());
        let (Some(first), Some(last)) = ends else {
            self.scales.push([0.0; 2]);
            return;
        };
        let scale = [first.min(last), count as f64 / (first - last).abs()];
        self.scales.push(scale);
        let below = &mut self.below[start..];
        for height in heights {
            below[Shelves::shelf(scale, count, height) + 1] += 1;
        }
        for shelf in 0..count {
            below[shelf + 1] += below[shelf];
        }
    }

    /// A range of a strip's points that has all those between two heights. `members` are the
    /// strip's points.
    #[inline(always)]
    fn between(&self, strip: usize, members: &Range<usize>, [low, high]: [f64; 2]) -> Range<usize> {
        let count = members.len();
        let scale = self.scales[strip];
        let below = &self.below[members.start + strip..members.end + strip + 1];
        let shelf = |height| Shelves::shelf(scale, count, height);
        below[shelf(low)] as usize..below[shelf(high) + 1] as usize
    }
}

impl Strips {
    /// Width of the strips for points this far apart, same unit.
    pub fn width(spacing: f64) -> f64 {
        STRIP_COLUMNS * spacing
    }

    /// Sorts points; returns the strips and the order (entry k is the point that comes k-th).
    /// Equal heights keep the order of `tie_breakers`.
    pub fn sort(x: &[f64], y: &[f64], tie_breakers: &[u32], width: f64) -> (Strips, Vec<u32>) {
        let (mut strips, mut order) = (Strips::default(), Vec::new());
        strips.renew(x, y, tie_breakers, width, &mut order);
        (strips, order)
    }

    /// [`Strips::sort`] into the existing arrays, without new memory.
    pub fn renew(
        &mut self,
        x: &[f64],
        y: &[f64],
        tie_breakers: &[u32],
        width: f64,
        order: &mut Vec<u32>,
    ) {
        let origin = x.iter().copied().fold(f64::INFINITY, f64::min);
        let origin = if origin.is_finite() { origin } else { 0.0 };
        let strip_of = |x: f64| strip(x, origin, width);
        let count = x.iter().map(|&x| strip_of(x) + 1).max().unwrap_or(0);
        let starts = &mut self.starts;
        starts.clear();
        if starts.capacity() <= count {
            // Water that spreads needs more strips, a few at a time.
            starts.reserve(2 * count + 1);
        }
        starts.resize(count + 1, 0);
        for &x in x {
            starts[strip_of(x) + 1] += 1;
        }
        for strip in 0..count {
            starts[strip + 1] += starts[strip];
        }
        order.clear();
        order.resize(x.len(), 0);
        for (point, &x) in x.iter().enumerate() {
            let slot = &mut starts[strip_of(x)];
            order[*slot as usize] = point as u32;
            *slot += 1;
        }
        // Every start has moved to the place of the next one.
        starts.copy_within(..count, 1);
        starts[0] = 0;
        for strip in 0..count {
            let members = &mut order[starts[strip] as usize..starts[strip + 1] as usize];
            let key = |&point: &u32| (y[point as usize], tie_breakers[point as usize]);
            members.sort_unstable_by(|a, b| {
                let ((ya, ta), (yb, tb)) = (key(a), key(b));
                let upwards = ya.total_cmp(&yb).then(ta.cmp(&tb));
                if strip % 2 == 0 { upwards } else { upwards.reverse() }
            });
        }
        self.shelves.clear();
        for strip in 0..count {
            let members = &order[starts[strip] as usize..starts[strip + 1] as usize];
            self.shelves.push(members.iter().map(|&point| y[point as usize]));
        }
        (self.origin, self.width) = (origin, width);
    }

    /// The strips of points that are already in order (as after a restart).
    pub fn of_sorted(x: &[f64], y: &[f64], width: f64) -> Strips {
        let ties: Vec<u32> = (0..x.len() as u32).collect();
        Strips::sort(x, y, &ties, width).0
    }

    /// Number of strips.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The points of a strip.
    pub fn members(&self, strip: usize) -> Range<usize> {
        self.starts[strip] as usize..self.starts[strip + 1] as usize
    }

    /// Calls `visit` with ranges of points that contain all points of a box.
    #[inline(always)]
    pub fn visit_box(
        &self,
        [left, right]: [f64; 2],
        [bottom, top]: [f64; 2],
        mut visit: impl FnMut(Range<usize>),
    ) {
        if self.count() == 0 || right < self.origin {
            return;
        }
        let first = strip(left, self.origin, self.width);
        let last = strip(right, self.origin, self.width);
        for strip in first..=last.min(self.count() - 1) {
            let members = self.members(strip);
            if members.is_empty() {
                continue;
            }
            let Range { start, end } = self.shelves.between(strip, &members, [bottom, top]);
            if start < end {
                visit(if strip % 2 == 0 {
                    members.start + start..members.start + end
                } else {
                    members.end - end..members.end - start
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_holds_what_brute_force_finds() {
        let points: Vec<[f64; 2]> = (0..500)
            .map(|k| {
                let k = f64::from(k);
                [(k * 0.618_033_988).fract() * 3.0, (k * 0.754_877_666).fract()]
            })
            .collect();
        let x: Vec<f64> = points.iter().map(|p| p[0]).collect();
        let y: Vec<f64> = points.iter().map(|p| p[1]).collect();
        let ties: Vec<u32> = (0..500).collect();
        let (strips, order) = Strips::sort(&x, &y, &ties, 0.17);
        let mut seen = order.clone();
        seen.sort_unstable();
        assert_eq!(seen, ties);
        for k in 0..50 {
            let [cx, cy] = points[k];
            let mut found = Vec::new();
            strips.visit_box([cx - 0.2, cx + 0.2], [cy - 0.1, cy + 0.1], |range| {
                found.extend(range.map(|k| order[k]));
            });
            for (point, p) in points.iter().enumerate() {
                if (p[0] - cx).abs() <= 0.2 && (p[1] - cy).abs() <= 0.1 {
                    assert!(found.contains(&(point as u32)));
                }
            }
        }
    }
}
