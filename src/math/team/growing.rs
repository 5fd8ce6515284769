//! Lists that grow by what their own items make.

use std::ops::Range;

use super::{Part, Team, cut};

/// A team that makes lists grow.
#[derive(Debug)]
pub struct Growing<T> {
    team: Team,
    parts: Vec<Made<T>>,
}

/// What consecutive items have made.
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
    /// By the work of a team.
    pub fn of(team: &Team) -> Growing<T> {
        let nothing = || Made { items: 0..0, made: Vec::new() };
        Growing { team: team.clone(), parts: (0..team.parts()).map(|_| nothing()).collect() }
    }

    /// Appends what the items of a list make, in their order.
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
