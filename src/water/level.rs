//! The search for a level: where, going upwards, the water ends.

/// Steps of half a spacing in which every surface is found.
const MOST_STEPS: f64 = 1e5;

/// Level of the water, metres. Going up from `from`, it is the first height at which the share of
/// the kernel that is water falls to 1/2. It is `from` if that is dry.
pub fn first_level(share: impl FnMut(f64) -> f64, from: f64, spacing: f64) -> f64 {
    level_up_to(share, [from, from + 0.5 * spacing * MOST_STEPS], spacing)
}

/// [`first_level`] between two heights; the upper one if the water reaches it.
pub fn level_up_to(
    mut share: impl FnMut(f64) -> f64,
    [from, highest]: [f64; 2],
    spacing: f64,
) -> f64 {
    let step = 0.5 * spacing;
    let (mut y, mut below) = (from, share(from));
    if below < 0.5 {
        return from;
    }
    while y < highest {
        let above = share(y + step);
        if above < 0.5 {
            return y + step * (below - 0.5) / (below - above);
        }
        (y, below) = (y + step, above);
    }
    highest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_is_where_the_share_falls_to_one_half() {
        // Water up to 0.3, air, and water again from 0.6 on.
        let share = |y: f64| if y < 0.45 { 0.5 - 2.0 * (y - 0.3) } else { 1.0 };
        assert!((first_level(share, 0.0, 0.02) - 0.3).abs() < 1e-12);
        assert!((level_up_to(share, [0.0, 0.2], 0.02) - 0.2).abs() < 1e-12);
        assert_eq!(first_level(share, 0.35, 0.02), 0.35);
        assert_eq!(level_up_to(|_| 1.0, [0.0, 0.2], 0.02), 0.2);
    }

    #[test]
    fn water_whose_places_are_not_numbers_ends_the_search() {
        assert!(first_level(|_| f64::NAN, 0.0, 0.02).is_finite());
    }
}
