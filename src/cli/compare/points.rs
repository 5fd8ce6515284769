//! The points of pairs in words, without the parts that all pairs share.

use crate::report::compare::{Comparison, Pair};

/// A pair's point without the parts that all pairs share.
pub(super) fn place(shared: &[&str], pair: &Pair) -> String {
    let told: Vec<_> = parts(pair).filter(|part| !shared.contains(part)).collect();
    if told.is_empty() { pair.words.clone() } else { told.join(", ") }
}

/// The parts that all pairs share, if pairs differ in other parts.
pub(super) fn in_all(comparison: &Comparison, shared: &[&str]) -> String {
    let differs = comparison.pairs.first().is_some_and(|pair| parts(pair).count() > shared.len());
    if differs { shared.join(", ") } else { String::new() }
}

/// The parts that all pairs share.
pub(super) fn shared(comparison: &Comparison) -> Vec<&str> {
    let Some((first, others)) = comparison.pairs.split_first() else { return Vec::new() };
    let in_all = |part: &&str| others.iter().all(|other| parts(other).any(|own| own == *part));
    parts(first).filter(in_all).collect()
}

/// The parts of a point's words. A bed is one part, with all its commas.
fn parts(pair: &Pair) -> impl Iterator<Item = &str> {
    let mut depth = 0;
    pair.words
        .split(move |letter| {
            depth += i32::from(letter == '[') - i32::from(letter == ']');
            letter == ',' && depth == 0
        })
        .map(str::trim_start)
}
