//! Numbers that options take, refused in words that say what is allowed.

use std::fmt::Display;
use std::str::FromStr;

/// What reads an option's value.
pub(super) trait Read<T>:
    Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
{
}

impl<T, F: Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static> Read<T> for F {}

/// A whole number within bounds.
pub(super) fn whole<T>(least: T, most: T) -> impl Read<T>
where
    T: FromStr + PartialOrd + Display + Copy + Send + Sync + 'static,
{
    move |text: &str| {
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| format!("must be a whole number from {least} to {most}"))
    }
}

/// A number of threads.
pub(super) fn threads() -> impl Read<u16> {
    whole(1, u16::MAX)
}

/// A time within bounds.
pub(super) fn seconds(least: f64, most: f64) -> impl Read<f64> {
    move |text: &str| {
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| format!("must be a number of seconds from {least} to {most}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_within_their_bounds() {
        let read = whole(1_u16, 300);
        assert_eq!([read("1"), read("300")], [Ok(1), Ok(300)]);
        for bad in ["0", "301", "-1", "1.5", "", "a", "1e2", "99999999999999999999"] {
            assert_eq!(read(bad), Err("must be a whole number from 1 to 300".to_owned()), "{bad}");
        }
        let read = seconds(0.1, 1e6);
        assert_eq!([read("0.1"), read("1e6")], [Ok(0.1), Ok(1e6)]);
        for bad in ["0", "1e7", "-1", "inf", "nan", "a"] {
            let told = "must be a number of seconds from 0.1 to 1000000";
            assert_eq!(read(bad), Err(told.to_owned()), "{bad}");
        }
    }
}
