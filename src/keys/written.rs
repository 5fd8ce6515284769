//! Numbers as people write them: with a unit, which the name of the key already has.

use crate::math::decimal::significant;

/// Units that people write, and their values in the units of keys.
const OTHERS: [(&str, &str, f64); 8] = [
    ("mm", "m", 1e-3),
    ("cm", "m", 1e-2),
    ("km", "m", 1e3),
    ("ms", "s", 1e-3),
    ("min", "s", 60.0),
    ("kN/m", "N/m", 1e3),
    ("t/m", "kg/m", 1e3),
    ("g/cm³", "kg/m³", 1e3),
];

/// What to write instead of a number with more text, for a key with this unit. `None` if the text
/// does not begin with a number.
pub(super) fn advice(text: &str, unit: &str) -> Option<String> {
    let (number, rest) = split(text)?;
    let has_unit = format!("the unit, {unit}, is in the key");
    if let Some(to) = rest.strip_prefix("to ").and_then(|rest| rest.trim().parse::<f64>().ok()) {
        return Some(format!(
            "a range stands in [grid] and says how many values it has: {{ from = {number}, to = {to}, points = 5 }}"
        ));
    }
    if unit.is_empty() && rest == "%" {
        let share = significant(number / 100.0, 15);
        return Some(format!("write {share}: this number is a ratio, no percentage"));
    }
    if unit.is_empty() {
        return Some(format!("write {number} alone: this number has no unit"));
    }
    if rest.is_empty() || rest == unit {
        return Some(format!("write {number}, without quotes: {has_unit}"));
    }
    let other = OTHERS.iter().find(|(other, own, _)| *other == rest && *own == unit);
    Some(match other {
        Some((_, _, factor)) => {
            let number = significant(number * factor, 15);
            format!("write {number}, without quotes: {has_unit}")
        }
        None => format!("write a number of {unit} alone: {has_unit}"),
    })
}

/// The number that a text begins with, and what follows it.
fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let starts = |text: &str| text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
    let number = |end: usize| Some((text[..end].trim().parse::<f64>().ok()?, text[end..].trim()));
    starts(text).then(|| ends.into_iter().find_map(number)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_with_its_unit_is_told_without() {
        let told = |text: &str, unit: &str| advice(text, unit).unwrap_or_default();
        assert_eq!(
            told("500 N/m", "N/m"),
            "write 500, without quotes: the unit, N/m, is in the key"
        );
        assert_eq!(told("1cm", "m"), "write 0.01, without quotes: the unit, m, is in the key");
        assert_eq!(
            told("1.6e1 mm", "m"),
            "write 0.016, without quotes: the unit, m, is in the key"
        );
        assert!(told("12 ft", "m").starts_with("write a number of m alone"));
        assert_eq!(told("0.3 h", ""), "write 0.3 alone: this number has no unit");
        assert_eq!(told("50%", ""), "write 0.5: this number is a ratio, no percentage");
        assert!(told("0.3 to 0.5", "").ends_with("{ from = 0.3, to = 0.5, points = 5 }"));
        assert!(told("7", "s").starts_with("write 7, without quotes"));
        for word in ["high", "", "nan m", "inf"] {
            assert_eq!(told(word, "m"), "", "{word}");
        }
    }
}
