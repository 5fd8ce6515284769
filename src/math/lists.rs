//! Functions of lists: different items, counts, ends and medians.

use std::collections::{BTreeMap, HashMap};
use std::hash::Hash;

/// The different items, in the order of the first of each.
pub fn different<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut different = Vec::new();
    for item in items {
        if !different.contains(&item) {
            different.push(item);
        }
    }
    different
}

/// How often each item occurs.
pub fn counts<T: Ord>(items: impl IntoIterator<Item = T>) -> BTreeMap<T, usize> {
    let mut counts = BTreeMap::new();
    items.into_iter().for_each(|item| *counts.entry(item).or_default() += 1);
    counts
}

/// The same, the most frequent first; equal counts keep the order of the first of each.
pub fn tallied<T: PartialEq + Clone>(items: &[T]) -> Vec<(T, usize)> {
    let count = |item: &T| items.iter().filter(|other| *other == item).count();
    let counted = different(items).into_iter().map(|item| (item.clone(), count(item)));
    let mut counted: Vec<_> = counted.collect();
    counted.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    counted
}

/// The items of each key together, in the order of the first of each.
pub fn grouped<K: Eq + Hash, T>(items: impl IntoIterator<Item = (K, T)>) -> Vec<Vec<T>> {
    let (mut places, mut groups) = (HashMap::new(), Vec::<Vec<T>>::new());
    for (key, item) in items {
        let place = *places.entry(key).or_insert(groups.len());
        match groups.get_mut(place) {
            Some(group) => group.push(item),
            None => groups.push(vec![item]),
        }
    }
    groups
}

/// The lowest and the highest number; `None` without any.
pub fn ends(mut numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let first = numbers.next()?;
    Some(numbers.fold((first, first), |(low, high), number| (low.min(number), high.max(number))))
}

/// The different numbers, from the lowest up.
pub fn rising(numbers: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut rising: Vec<f64> = numbers.into_iter().collect();
    rising.sort_by(f64::total_cmp);
    rising.dedup();
    rising
}

/// The number in the middle; the mean of two where their count is even.
pub fn median(numbers: &[f64]) -> Option<f64> {
    let mut rising = numbers.to_vec();
    rising.sort_by(f64::total_cmp);
    let (low, high) = (rising.len().checked_sub(1)? / 2, rising.len() / 2);
    Some((rising[low] + rising[high]) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_an_even_number_of_values_is_between_two() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(&[]), None);
        assert_eq!(ends([2.0, -1.0, 3.0].into_iter()), Some((-1.0, 3.0)));
    }

    #[test]
    fn the_most_frequent_come_first_and_equals_in_their_order() {
        assert_eq!(different(["b", "a", "b"]), ["b", "a"]);
        assert_eq!(tallied(&["b", "c", "a", "c"]), [("c", 2), ("b", 1), ("a", 1)]);
        assert_eq!(grouped([("b", 1), ("a", 2), ("b", 3)]), [vec![1, 3], vec![2]]);
        assert_eq!(counts([2, 1, 2]).into_iter().collect::<Vec<_>>(), [(1, 1), (2, 2)]);
    }
}
