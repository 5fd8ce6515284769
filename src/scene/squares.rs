//! Search for the places near a given one, among very many.

use std::collections::HashMap;

/// Squares are larger than the reach by this factor, because divisions are rounded.
const ROOM: f64 = 1.001;

/// Numbered places, sorted into the squares of a lattice. Nine squares contain all places near a
/// given one.
pub(super) struct Squares {
    /// Distance within which places are near, metres.
    reach: f64,
    squares: HashMap<[i64; 2], Vec<(u32, [f64; 2])>>,
}

impl Squares {
    /// For places that are near each other if they are closer than `reach`, metres.
    pub(super) fn new(reach: f64, places: impl IntoIterator<Item = (u32, [f64; 2])>) -> Squares {
        let mut sorted = Squares { reach, squares: HashMap::new() };
        for (number, place) in places {
            let square = sorted.square(place);
            sorted.squares.entry(square).or_default().push((number, place));
        }
        sorted
    }

    fn square(&self, place: [f64; 2]) -> [i64; 2] {
        place.map(|part| (part / (ROOM * self.reach)).floor() as i64)
    }

    /// The numbers of those near a place, in their order.
    pub(super) fn near(&self, here: [f64; 2]) -> Vec<u32> {
        let [column, row] = self.square(here);
        let around =
            (column - 1..=column + 1).flat_map(|x| (row - 1..=row + 1).map(move |y| [x, y]));
        let all = around.filter_map(|square| self.squares.get(&square)).flatten();
        let is_near = |&&(_, [x, y]): &&(u32, [f64; 2])| {
            let (dx, dy) = (x - here[0], y - here[1]);
            dx * dx + dy * dy < self.reach * self.reach
        };
        let mut near: Vec<u32> = all.filter(is_near).map(|&(number, _)| number).collect();
        near.sort_unstable();
        near
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_are_found_as_by_looking_at_all_of_them() {
        let mut random = 7_u64;
        let mut next = move || {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            (random >> 11) as f64 / (1_u64 << 53) as f64
        };
        let scattered = (0..500).map(|_| [next() - 0.5, 0.3 * next()]);
        // In a lattice many places are exactly at that distance.
        let lattice = (0..400).map(|k| [f64::from(k % 20) * 0.01, f64::from(k / 20) * 0.01]);
        let places: Vec<[f64; 2]> = scattered.chain(lattice).collect();
        for reach in [0.01, 0.03, 0.4] {
            let squares = Squares::new(reach, (0..).zip(places.iter().copied()));
            for here in &places {
                let is_near = |(_, place): &(u32, &[f64; 2])| {
                    let (dx, dy) = (place[0] - here[0], place[1] - here[1]);
                    dx * dx + dy * dy < reach * reach
                };
                let all = (0..).zip(&places).filter(is_near).map(|(number, _)| number);
                assert_eq!(squares.near(*here), all.collect::<Vec<_>>(), "{reach}: {here:?}");
            }
        }
    }
}
