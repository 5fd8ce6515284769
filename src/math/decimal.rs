//! Rounding to decimal digits.

/// A value rounded to a number of significant digits: the number that its text reads back as.
pub fn significant(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_numbers_are_those_that_one_writes() {
        assert_eq!(significant(21544.3469, 4), 21540.0);
        assert_eq!(significant(0.1 + 0.2, 15), 0.3);
        assert!(significant(f64::NAN, 3).is_nan());
    }
}
