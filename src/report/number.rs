//! Numbers for the reader.

pub use crate::math::decimal::significant;
use crate::quantities::Digits;

/// Significant digits of a parameter, where they are enough to tell its values apart.
const FEW: usize = 4;
/// Digits that tell all numbers apart.
const ALL: usize = 17;

/// A parameter as a person types it, to four significant digits: `500`, `0.01`, `50000`, `2.5e8`.
pub fn as_typed(value: f64) -> String {
    as_typed_to(value, FEW)
}

/// A parameter as a person types it, to so many significant digits.
pub fn as_typed_to(value: f64, digits: usize) -> String {
    let value = significant(value, digits);
    let written = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    if written { value.to_string() } else { format!("{value:e}") }
}

/// A number's text with the sign that figures have: a minus rather than a hyphen.
pub fn minus(text: &str) -> String {
    text.strip_prefix('-').map_or_else(|| text.to_owned(), |size| format!("\u{2212}{size}"))
}

/// The fewest digits, four or more, that keep different values apart.
pub fn digits_apart(values: impl Iterator<Item = f64>) -> usize {
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let apart = |&digits: &usize| {
        values.windows(2).all(|two| significant(two[0], digits) != significant(two[1], digits))
    };
    (FEW..ALL).find(apart).unwrap_or(ALL)
}

/// A derived number as a person writes it: `500`, `0.01`, `10⁷`, `2.5×10⁵`.
pub fn in_powers(value: f64) -> String {
    let value = significant(value, 4);
    let size = value.abs();
    if value == 0.0 || (1e-3..1e4).contains(&size) {
        return value.to_string();
    }
    let text = format!("{value:e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let power = format!("10{}", exponent.chars().map(superscript).collect::<String>());
    if mantissa == "1" { power } else { format!("{mantissa}×{power}") }
}

/// A table's cell. A number that is not whole and has more than five digits is written as by
/// [`in_powers`]; all else stays.
pub fn shortened(cell: &str) -> String {
    let Ok(value) = cell.parse::<f64>() else { return cell.to_owned() };
    let mantissa = cell.split(['e', 'E']).next().unwrap_or_default();
    let digits = mantissa.trim_start_matches(['-', '0', '.']).chars().filter(char::is_ascii_digit);
    let whole = cell.chars().all(|c| c.is_ascii_digit());
    if whole || digits.count() <= 5 { cell.to_owned() } else { in_powers(value) }
}

/// A number with the digits that its quantity shows; `None` where all digits are shown.
pub fn with_digits(value: f64, digits: Digits) -> Option<String> {
    match digits {
        Digits::All => None,
        Digits::Decimals(decimals) => Some(format!("{value:.decimals$}")),
        Digits::Significant(digits) => Some(significant(value, digits).to_string()),
    }
}

/// A result with its error bar. Both are rounded to the bar's first digit, or to its second where
/// the bar starts with a 1: `2.41 ± 0.03`, `1.224 ± 0.012`.
pub fn with_error(value: f64, error: f64) -> String {
    let error = error.abs();
    if error == 0.0 || !error.is_finite() {
        return as_typed(value);
    }
    let first = significant(error, 1);
    let digits = if significant(error, 2) < 2.0 * power_of_ten_below(first) { 2 } else { 1 };
    let error = significant(error, digits);
    let unit = power_of_ten_below(first) / if digits == 2 { 10.0 } else { 1.0 };
    let decimals = (0..9).find(|&n| unit * 10_f64.powi(n) > 0.99).unwrap_or(9) as usize;
    format!("{value:.decimals$} ± {error:.decimals$}")
}

/// A lower bound with its error bar, which can only lower it: `≥ 2.41 − 0.03`, `≥ 2.41`.
pub fn bound_with_error(value: f64, error: f64) -> String {
    format!("≥ {}", with_error(value, error).replace(" ± ", " − "))
}

/// The largest power of ten that is not above a positive number.
fn power_of_ten_below(value: f64) -> f64 {
    let text = format!("{value:e}");
    let exponent = text.split_once('e').map_or("0", |(_, exponent)| exponent);
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

/// Whether a text is a number: plain, with a bar, a bound, or as [`in_powers`] writes it.
pub fn is_number(text: &str) -> bool {
    let text = text.strip_prefix("≥ ").unwrap_or(text);
    let bar = text.split_once(" ± ").or_else(|| text.split_once(" − "));
    let text = bar.map_or(text, |(value, _)| value);
    let mantissa =
        text.split_once("10").filter(|(_, power)| power.starts_with(|c: char| !c.is_ascii()));
    match mantissa {
        Some((mantissa, _)) => {
            let mantissa = mantissa.trim_end_matches('×');
            mantissa.is_empty() || mantissa.parse::<f64>().is_ok()
        }
        None => text.parse::<f64>().is_ok(),
    }
}

fn superscript(digit: char) -> char {
    match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_read_as_written_by_hand() {
        let numbers = [0.0, 0.01, 500.0, 5e4, 1e7, 2.5e5, 1e-4];
        let typed = ["0", "0.01", "500", "50000", "1e7", "250000", "0.0001"];
        assert_eq!(numbers.map(as_typed), typed);
        assert_eq!(typed.map(|text| text.parse::<f64>().unwrap()), numbers);
        let written = [0.0, 0.01, 500.0, 9999.0, 1e7, 2.5e5, 1e-4].map(in_powers);
        assert_eq!(written, ["0", "0.01", "500", "9999", "10⁷", "2.5×10⁵", "10⁻⁴"]);
    }

    #[test]
    fn long_parameters_are_rounded_to_four_digits() {
        let long = [21544.3469003188, 0.31622776601683794, 464.158883, 9999.9];
        assert_eq!(long.map(as_typed), ["21540", "0.3162", "464.2", "10000"]);
        assert_eq!(long.map(in_powers), ["2.154×10⁴", "0.3162", "464.2", "10⁴"]);
    }

    #[test]
    fn values_that_differ_are_told_apart() {
        let digits = |values: &[f64]| digits_apart(values.iter().copied());
        assert_eq!(digits(&[0.30001, 0.3, 0.30001]), 5);
        assert_eq!((digits(&[0.25, 0.3]), digits(&[])), (4, 4));
        let next = 0.3_f64.next_up();
        let written = [0.3, next].map(|value| as_typed_to(value, digits(&[0.3, next])));
        assert_eq!(written, ["0.3", &next.to_string()]);
        assert_eq!(as_typed_to(0.30001, 5), "0.30001");
    }

    #[test]
    fn cells_are_brief_and_counts_whole() {
        let cells = ["-8.939208979763524e-6", "2.4137", "3383", "4957550832", "0.0001", "ok", ""];
        let written = cells.map(shortened);
        assert_eq!(written, ["-8.939×10⁻⁶", "2.4137", "3383", "4957550832", "0.0001", "ok", ""]);
        assert_eq!(shortened("21544.3469003188"), "2.154×10⁴");
        assert!(written[..5].iter().all(|cell| is_number(cell)));
    }

    #[test]
    fn a_bar_decides_on_the_digits() {
        let pairs = [(2.4137, 0.0312), (1.22412, 0.0123), (3.4, 0.0997), (12.6, 2.2), (0.5, 0.0)];
        let written = pairs.map(|(value, error)| with_error(value, error));
        assert_eq!(written, ["2.41 ± 0.03", "1.224 ± 0.012", "3.40 ± 0.10", "13 ± 2", "0.5"]);
        // This bar is rounded up to a 1.
        assert_eq!(with_error(2.8548, 0.0098), "2.855 ± 0.010");
        assert!(is_number("2.41 ± 0.03"));
        let bounds = [0.0312, 0.0].map(|error| bound_with_error(2.4137, error));
        assert_eq!(bounds, ["≥ 2.41 − 0.03", "≥ 2.414"]);
        assert!(bounds.iter().all(|bound| is_number(bound)));
    }

    #[test]
    fn what_is_written_is_recognised() {
        assert!(
            [0.0, 0.01, 10.0, 110.0, 1e7, 2.5e5, 1e-4].map(in_powers).iter().all(|t| is_number(t))
        );
        assert!(!is_number("case-10") && !is_number("ok") && !is_number(""));
    }
}
