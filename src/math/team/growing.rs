//! Lists that grow by items made from their own items.

use std::ops::Range;

use super::{Part, Team, cut};

/// Lets lists grow by the work of a team.
#[derive(Debug)]
pub struct Growing<T> {
    team: Team,
    parts: Vec<Made<T>>,
}

/// The items made from consecutive items.
#[derive(Debug)]
struct Made<T> {
    items: Range<usize>,
    made: Vec<T>,
}

impl<T: Send> Part for Made<T> {
    fn items(&self) -> Range<usize> {
        self.items.clone()
    }
}

impl<T: Copy + Send + Sync> Growing<T> {
    /// For a team.
    pub fn of(team: &Team) -> Growing<T> {
        let nothing = || Made { items: 0..0, made: Vec::new() };
        Growing { team: team.clone(), parts: (0..team.parts()).map(|_| nothing()).collect() }
    }

    /// Appends the items that `make` makes of the items of a list, in order.
    pub fn grow(&mut self, list: &mut Vec<T>, make: impl Fn(&T) -> Option<T> + Sync) {
        let Growing { team, parts } = self;
        let ranges = cut(list.len(), parts.len());
        parts.iter_mut().zip(ranges).for_each(|(part, range)| part.items = range);
        team.share(parts, (), &|Made { items, made }, ()| {
            made.clear();
            made.extend(list[items.clone()].iter().filter_map(&make));
        });
        parts.iter().for_each(|part| list.extend_from_slice(&part.made));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_grows_in_the_order_of_its_items() {
        for threads in [1, 2, 3] {
            let team = Team::of(threads);
            let (mut growing, mut list) = (Growing::of(&team), (0..21).collect::<Vec<u32>>());
            for _ in 0..2 {
                growing.grow(&mut list, |item| item.is_multiple_of(3).then_some(100 + item));
            }
            let first: Vec<u32> = (0..21).step_by(3).map(|item| 100 + item).collect();
            let later = first.iter().filter(|item| **item % 3 == 0).map(|item| 100 + item);
            let second: Vec<u32> = first.iter().copied().chain(later).collect();
            assert_eq!(list[21..28], first, "{threads} threads");
            assert_eq!(list[28..], second, "{threads} threads");
        }
    }
}
