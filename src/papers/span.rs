//! The values of a key for which a printed number holds.

use std::str::FromStr;

/// A number, or all numbers from it upwards or downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The lowest, or -∞.
    pub low: f64,
    /// The highest, or ∞.
    pub high: f64,
}

impl Span {
    /// Whether it includes a value, to nine digits.
    pub fn holds(self, value: f64) -> bool {
        let slack = 1e-9 * value.abs();
        self.low - slack <= value && value <= self.high + slack
    }
}

impl FromStr for Span {
    type Err = std::num::ParseFloatError;

    /// `10`, `<=10` or `>=10000`.
    fn from_str(text: &str) -> Result<Span, Self::Err> {
        if let Some(high) = text.strip_prefix("<=") {
            return Ok(Span { low: f64::NEG_INFINITY, high: high.parse()? });
        }
        if let Some(low) = text.strip_prefix(">=") {
            return Ok(Span { low: low.parse()?, high: f64::INFINITY });
        }
        let value = text.parse()?;
        Ok(Span { low: value, high: value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_and_two_half_lines() {
        let holds = |text: &str| [1.0, 10.0, 1e4].map(|v| text.parse::<Span>().unwrap().holds(v));
        assert_eq!(holds("10"), [false, true, false]);
        assert_eq!(holds("<=10"), [true, true, false]);
        assert_eq!(holds(">=10"), [false, true, true]);
        assert!("ten".parse::<Span>().is_err());
    }
}
