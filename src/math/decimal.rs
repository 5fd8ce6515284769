//! Decimal digits: rounding to them, and reading what tables print.

/// A value rounded to a number of significant digits: the number that its text reads back as.
pub fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// A positive value rounded up to a number of significant digits, for the text of a lower bound.
pub fn rounded_up(value: f64, digits: usize) -> f64 {
    to_digits(value, digits, f64::ceil)
}

/// A positive value rounded down, for the text of an upper bound.
pub fn rounded_down(value: f64, digits: usize) -> f64 {
    to_digits(value, digits, f64::floor)
}

fn to_digits(value: f64, digits: usize, whole: impl Fn(f64) -> f64) -> f64 {
    let power = libm::log10(value).floor() - digits.saturating_sub(1) as f64;
    let unit = libm::pow(10.0, power);
    significant(whole(value / unit) * unit, digits)
}

/// A number as programs write it, or as tables print it: `5e4`, `5×10⁴`, `10⁷`.
pub fn read(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| {
        let one = || text.strip_prefix("10").map(|power| ("1", power));
        let (mantissa, power) = text.split_once("×10").or_else(one)?;
        let digits: Option<String> = power.chars().map(plain_digit).collect();
        format!("{mantissa}e{}", digits.filter(|digits| !digits.is_empty())?).parse().ok()
    })
}

/// A superscript digit or sign as a plain one.
fn plain_digit(raised: char) -> Option<char> {
    "⁰¹²³⁴⁵⁶⁷⁸⁹⁻".chars().zip("0123456789-".chars()).find(|(own, _)| *own == raised).map(|(_, c)| c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_tables_print_them() {
        let known =
            [("5×10⁴", 5e4), ("10⁷", 1e7), ("2.154×10⁻⁴", 2.154e-4), ("10", 10.0), ("5e4", 5e4)];
        for (text, number) in known {
            assert_eq!(read(text), Some(number), "{text}");
        }
        for bad in ["", "×10⁴", "5×10", "10⁴x", "5x10⁴", "110⁴", "10⁻", "a×10²"] {
            assert_eq!(read(bad), None, "{bad}");
        }
    }

    #[test]
    fn bounds_are_rounded_to_their_side() {
        assert_eq!(rounded_up(0.376_272, 3), 0.377);
        assert_eq!(rounded_down(0.376_972, 3), 0.376);
        assert_eq!([rounded_up(326.272, 6), rounded_down(326.272, 6)], [326.272; 2]);
        assert_eq!(rounded_up(9.991, 3), 10.0);
    }

    #[test]
    fn rounded_numbers_are_those_that_one_writes() {
        assert_eq!(significant(21544.3469, 4), 21540.0);
        assert_eq!(significant(0.1 + 0.2, 15), 0.3);
        assert!(significant(f64::NAN, 3).is_nan());
    }
}
