//! A root between two places, found by halving.

/// So many halvings leave nothing to halve between two doubles of about the same size.
const HALVINGS: u32 = 60;

/// The ends of what is left of a stretch around the place from which on `beyond` holds. It does not
/// hold at the first end, and holds at the second.
pub fn bisected([mut low, mut high]: [f64; 2], beyond: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if beyond(middle) { high = middle } else { low = middle }
    }
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_close_in_on_the_root_from_both_sides() {
        let [low, high] = bisected([1.0, 2.0], |x| x * x >= 2.0);
        assert!(low * low < 2.0 && high * high >= 2.0 && high - low <= f64::EPSILON);
        assert_eq!(bisected([0.0, 1.0], |_| false)[1], 1.0, "none is found: the ends stay");
    }
}
