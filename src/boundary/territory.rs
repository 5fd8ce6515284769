//! Which stretch of a bed fills a place behind it with its ghosts.

use super::profile::Stretch;

/// Number of sample places along a cell, and across it.
const LOOKS: u32 = 6;

/// A share that is wrong by more than this is replaced.
const OFF: f64 = 0.25;

/// Distances that differ by less than this count as equal, metres.
const AS_NEAR: f64 = 1e-9;

/// Distances that differ by more than this differ despite rounding, metres.
const CLEAR: f64 = 1e-6;

/// The stretches of a bed. A place behind the bed belongs to the nearest stretch. Otherwise
/// stretches that are not neighbours fill the same place twice. This happens behind steps lower
/// than the support radius, and behind ridges narrower than two radii. Still water of ten rows then
/// moved at 50 to 80 mm/s after 10 s, over a step of a spacing or less.
pub(super) struct Territory<'a> {
    stretches: &'a [Stretch],
    /// The lowest and the highest corner of each stretch's bounding box.
    boxes: Vec<[[f64; 2]; 2]>,
    reach: f64,
}

impl Territory<'_> {
    /// `reach` is how far ghosts reach behind their stretches, metres.
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

    /// The share of a cell that is nearer to these stretches (from the first number to the last)
    /// than to any other. `usual` is the share by the bisectors of bends; it is returned unless it
    /// is far off. `cell` gives places of the cell, from -½ to ½ along and across it, and their
    /// distances behind its stretches, metres.
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

    /// Numbers of the stretches that may be within `near` of a place, metres. Of thousands only few
    /// are. From the paddle to the wall no stretch goes back, so they are found by bisection.
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

/// Distance between a place and a stretch, metres.
fn away(stretch: &Stretch, place: [f64; 2]) -> f64 {
    let foot = stretch.foot(place);
    (place[0] - foot[0]).hypot(place[1] - foot[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::Profile;

    /// The share from a search over every stretch at every place.
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

    /// Of a bed of 4,000 points, every stretch was once compared with every cell of ghosts.
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
