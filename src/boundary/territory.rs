//! Whose ghosts fill which place behind a bed.

use super::profile::Stretch;

/// Places that are looked at along a cell, and across it.
const LOOKS: u32 = 6;

/// A share that is so much off is taken anew.
const OFF: f64 = 0.25;

/// Nearer by less than this is as near, metres.
const AS_NEAR: f64 = 1e-9;

/// The stretches of a bed. A place behind it belongs to the nearest one. Without that, stretches that are no neighbours
/// fill the same place twice. It happens behind steps lower than the support radius, and ridges narrower than two of
/// them. Still water of ten rows then moved at 50 to 80 mm/s after 10 s, over a step of a spacing or less.
pub(super) struct Territory<'a> {
    stretches: &'a [Stretch],
    reach: f64,
}

impl Territory<'_> {
    /// Ghosts reach so far behind their stretches, metres.
    pub(super) fn of(stretches: &[Stretch], reach: f64) -> Territory<'_> {
        Territory { stretches, reach }
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
        let others: Vec<_> = (0..self.stretches.len())
            .filter(|number| !(own[0]..=own[1]).contains(number))
            .map(|number| &self.stretches[number])
            .filter(|other| away(other, middle) < 2.0 * self.reach)
            .collect();
        let at = |look: u32| (f64::from(look) + 0.5) / f64::from(LOOKS) - 0.5;
        let looks = (0..LOOKS * LOOKS).map(|look| cell([at(look % LOOKS), at(look / LOOKS)]));
        let mine = looks.map(|(place, behind)| {
            let nearest =
                others.iter().map(|other| away(other, place)).fold(f64::INFINITY, f64::min);
            match nearest - behind {
                nearer if nearer < -AS_NEAR => 0.0,
                nearer if nearer < AS_NEAR => 0.5,
                _ => 1.0,
            }
        });
        let share = mine.sum::<f64>() / f64::from(LOOKS * LOOKS);
        if (share - usual).abs() > OFF { share } else { usual }
    }
}

/// Between a place and a stretch, metres.
fn away(stretch: &Stretch, place: [f64; 2]) -> f64 {
    let foot = stretch.foot(place);
    (place[0] - foot[0]).hypot(place[1] - foot[1])
}
