//! Gaps in a record or in a case: nothing in them counts.

use crate::math::lists::median;

/// A gap is longer than this many times the median distance in time of the points.
const WIDE: f64 = 5.0;

/// Stretches without values, from and to, s: in the order of time, and apart.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Gaps(Vec<[f64; 2]>);

impl Gaps {
    /// The gaps of one or of the other.
    pub(super) fn of(both: [&[(f64, f64)]; 2]) -> Gaps {
        let mut all: Vec<_> = both.into_iter().flat_map(wide).collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut apart: Vec<[f64; 2]> = Vec::new();
        for [from, to] in all {
            match apart.last_mut().filter(|last| from <= last[1]) {
                Some(last) => last[1] = last[1].max(to),
                None => apart.push([from, to]),
            }
        }
        Gaps(apart)
    }

    /// Whether a time lies in a gap. The times at its ends do not.
    pub(super) fn hold(&self, time: f64) -> bool {
        self.around(time).is_some()
    }

    fn around(&self, time: f64) -> Option<[f64; 2]> {
        let next = self.0.partition_point(|gap| gap[1] <= time);
        self.0.get(next).filter(|gap| gap[0] < time).copied()
    }

    /// A stretch of time, s, without the gaps in which it begins or ends. It may become empty: its
    /// end is then before its start.
    pub(super) fn trimmed(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        [self.around(from).map_or(from, |gap| gap[1]), self.around(to).map_or(to, |gap| gap[0])]
    }

    /// Those within a stretch of time.
    pub(super) fn within(&self, [from, to]: [f64; 2]) -> Gaps {
        Gaps(self.0.iter().filter(|gap| from <= gap[0] && gap[1] <= to).copied().collect())
    }

    /// How long they are together, s.
    pub fn seconds(&self) -> f64 {
        self.0.iter().map(|[from, to]| to - from).sum()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// The longest one.
    pub fn longest(&self) -> Option<[f64; 2]> {
        self.0.iter().copied().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))
    }

    /// Points in pieces, with a break at each gap.
    pub(super) fn pieces<'a>(
        &'a self,
        points: &'a [(f64, f64)],
    ) -> impl Iterator<Item = &'a [(f64, f64)]> {
        let joined = |a: &(f64, f64), b: &(f64, f64)| {
            let next = self.0.partition_point(|gap| gap[0] < a.0);
            self.0.get(next).is_none_or(|gap| gap[1] > b.0)
        };
        points.chunk_by(joined)
    }
}

/// The gaps of points.
fn wide(points: &[(f64, f64)]) -> Vec<[f64; 2]> {
    let pairs = points.windows(2).map(|pair| [pair[0].0, pair[1].0]);
    let apart: Vec<f64> = pairs.clone().map(|[from, to]| to - from).collect();
    let Some(usual) = median(&apart).filter(|usual| *usual > 0.0) else { return Vec::new() };
    pairs.filter(|[from, to]| to - from > WIDE * usual).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(times: &[f64]) -> Vec<(f64, f64)> {
        times.iter().map(|&time| (time, 0.0)).collect()
    }

    #[test]
    fn what_either_lacks_is_a_gap() {
        let own = at(&[0.0, 1.0, 2.0, 3.0, 4.0, 20.0, 21.0, 22.0, 50.0]);
        let other = at(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 18.0, 19.0, 20.0, 21.0, 22.0, 23.0, 31.0]);
        let gaps = Gaps::of([&own, &other]);
        assert_eq!(gaps.0, [[4.0, 20.0], [22.0, 50.0]]);
        let inside = [3.0, 4.0, 4.5, 20.0, 21.0, 49.0, 50.0].map(|time| gaps.hold(time));
        assert_eq!(inside, [false, false, true, false, false, true, false]);
        assert_eq!(gaps.trimmed([0.0, 31.0]), [0.0, 22.0]);
        assert_eq!(gaps.trimmed([5.0, 9.0]), [20.0, 4.0], "nothing is left");
        let inner = gaps.within([0.0, 22.0]);
        assert_eq!((inner.count(), inner.seconds()), (1, 16.0));
        assert_eq!(gaps.longest(), Some([22.0, 50.0]));
        let pieces = gaps.pieces(&own).map(<[_]>::len).collect::<Vec<_>>();
        assert_eq!(pieces, [5, 3, 1]);
        assert_eq!(Gaps::of([&at(&[0.0, 9.0]), &[]]), Gaps::default(), "two points have no usual");
    }
}
