//! Whose ghosts fill which place behind a bed.

use super::profile::Stretch;

/// Places that are looked at along a cell, and across it.
const LOOKS: u32 = 6;

/// A share that is so much off is taken anew.
const OFF: f64 = 0.25;

/// Nearer by less than this is as near, metres.
const AS_NEAR: f64 = 1e-9;

/// Farther by so much is farther with all rounding, metres.
const CLEAR: f64 = 1e-6;

/// The stretches of a bed. A place behind it belongs to the nearest one. Without that, stretches that are no neighbours
/// fill the same place twice. It happens behind steps lower than the support radius, and ridges narrower than two of
/// them. Still water of ten rows then moved at 50 to 80 mm/s after 10 s, over a step of a spacing or less.
pub(super) struct Territory<'a> {
    stretches: &'a [Stretch],
    /// The lowest and the highest corner of the upright rectangle around each.
    boxes: Vec<[[f64; 2]; 2]>,
    reach: f64,
}

impl Territory<'_> {
    /// Ghosts reach so far behind their stretches, metres.
    pub(super) fn of(stretches: &[Stretch], reach: f64) -> Territory<'_> {
        let rectangle = |it: &Stretch| {
            let end = it.place(it.length, 0.0);
            [
                [0, 1].map(|axis| it.from[axis].min(end[axis])),
                [0, 1].map(|axis| it.from[axis].max(end[axis])),
            ]
        };
        Territory { stretches, boxes: stretches.iter().map(rectangle).collect(), reach }
    }

    /// How much of a cell is nearer to these stretches, the first and the last one's numbers, than to any other.
    /// `usual` is what the lines that halve bends leave to it; it stays unless that is far off. `cell` gives places of
    /// the cell, from -½ to ½ along and across it, and how far behind its stretches they lie, metres.
    pub(super) fn share(
        &self,
        own: [usize; 2],
        usual: f64,
        cell: impl Fn([f64; 2]) -> ([f64; 2], f64),
    ) -> f64 {
        let (middle, _) = cell([0.0, 0.0]);
        let at = |look: u32| (f64::from(look) + 0.5) / f64::from(LOOKS) - 0.5;
        let looks = (0..LOOKS * LOOKS).map(|look| cell([at(look % LOOKS), at(look / LOOKS)]));
        let mine = looks.map(|(place, behind)| {
            let others = self.within(place, behind + CLEAR);
            let others = others.filter(|number| !(own[0]..=own[1]).contains(number));
            let others = others
                .map(|number| &self.stretches[number])
                .filter(|other| away(other, middle) < 2.0 * self.reach);
            let nearest = others.map(|other| away(other, place)).fold(f64::INFINITY, f64::min);
            match nearest - behind {
                nearer if nearer < -AS_NEAR => 0.0,
                nearer if nearer < AS_NEAR => 0.5,
                _ => 1.0,
            }
        });
        let share = mine.sum::<f64>() / f64::from(LOOKS * LOOKS);
        if (share - usual).abs() > OFF { share } else { usual }
    }

    /// Numbers of the stretches that may be so near to a place, metres. Of thousands they are few, and from the paddle to
    /// the wall no stretch goes back.
    fn within(&self, [x, y]: [f64; 2], near: f64) -> impl Iterator<Item = usize> + '_ {
        let first = self.boxes.partition_point(|[_, high]| high[0] < x - near);
        let last = self.boxes.partition_point(|[low, _]| low[0] <= x + near);
        let square = move |&number: &usize| {
            let [low, high] = self.boxes[number];
            let gap =
                |place: f64, axis: usize| (low[axis] - place).max(place - high[axis]).max(0.0);
            gap(x, 0).powi(2) + gap(y, 1).powi(2)
        };
        (first..last.max(first)).filter(move |number| square(number) <= near * near)
    }
}

/// Between a place and a stretch, metres.
fn away(stretch: &Stretch, place: [f64; 2]) -> f64 {
    let foot = stretch.foot(place);
    (place[0] - foot[0]).hypot(place[1] - foot[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Profile;

    /// The share as a look at every stretch from every place tells it.
    fn plainly(
        of: &Territory<'_>,
        own: [usize; 2],
        usual: f64,
        cell: impl Fn([f64; 2]) -> ([f64; 2], f64),
    ) -> f64 {
        let numbers = (0..of.stretches.len()).filter(|it| !(own[0]..=own[1]).contains(it));
        let others: Vec<_> = numbers.map(|number| &of.stretches[number]).collect();
        let at = |look: u32| (f64::from(look) + 0.5) / f64::from(LOOKS) - 0.5;
        let mut sum = 0.0;
        for look in 0..LOOKS * LOOKS {
            let (place, behind) = cell([at(look % LOOKS), at(look / LOOKS)]);
            let nearest =
                others.iter().map(|other| away(other, place)).fold(f64::INFINITY, f64::min);
            let over = nearest - behind;
            sum += if over < -AS_NEAR { 0.0 } else { f64::from(u8::from(over >= AS_NEAR)) };
            sum += if over.abs() < AS_NEAR { 0.5 } else { 0.0 };
        }
        let share = sum / f64::from(LOOKS * LOOKS);
        if (share - usual).abs() > OFF { share } else { usual }
    }

    /// The story: of a bed of 4,000 points every stretch was held against every cell of ghosts.
    #[test]
    fn a_share_is_that_of_a_look_at_all_stretches() {
        let mut points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [1.04, 0.1], [1.04, 0.0]];
        for step in 1..=300 {
            let x = 1.04 + 0.003 * f64::from(step);
            points.push([x, 0.02 * libm::sin(40.0 * x).abs()]);
        }
        let profile = Profile::checked(points).unwrap();
        let stretches: Vec<_> = profile.stretches().collect();
        let territory = Territory::of(&stretches, 0.05);
        let (mut shares, mut differ) = (0, 0);
        for (number, stretch) in stretches.iter().enumerate() {
            for depth in [0.005, 0.015, 0.045] {
                let cell = |[a, b]: [f64; 2]| {
                    let behind = depth + 0.01 * b;
                    (stretch.place((0.5 + a) * stretch.length, behind), behind)
                };
                let own = [number, number];
                let share = territory.share(own, 1.0, cell);
                assert_eq!(share, plainly(&territory, own, 1.0, cell), "{number}, {depth}");
                (shares, differ) = (shares + 1, differ + i32::from(share < 1.0));
            }
        }
        assert!(differ > 50 && shares > 900, "{differ} of {shares}");
    }
}
