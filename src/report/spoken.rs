//! What tells cases apart, in the words of a sentence.

use super::number::minus;
use crate::quantities::heading;

/// A part of a variant's words: `still water depth = 0.2 m` for `still_water_depth_m = 0.2`.
pub fn spoken(part: &str) -> String {
    let Some((name, value)) = part.split_once(" = ") else { return part.to_owned() };
    let heading = heading(name);
    let (symbol, unit) = heading.split_once(", ").unwrap_or((&heading, ""));
    // Only numbers have units.
    let unit = if value.parse::<f64>().is_ok() { unit } else { "" };
    format!("{symbol} = {} {unit}", minus(value)).trim_end().to_owned()
}

/// All parts of a variant's words in this form.
pub(super) fn all_spoken(words: &str) -> String {
    words.split(", ").map(spoken).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_is_spoken_with_units() {
        let words =
            "boundary = sfdi, wave_period_s = 1, floor_height_m = -0.05, bed = [[0, 0], [1, 0.1]]";
        let told = "boundary = sfdi, wave period = 1 s, floor height = \u{2212}0.05 m, bed = [[0, 0], [1, 0.1]]";
        assert_eq!(all_spoken(words), told);
        assert_eq!(spoken("tank_length_m = number 2"), "tank length = number 2");
        assert_eq!(all_spoken(""), "");
    }
}
