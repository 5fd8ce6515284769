//! The scale of an axis: equal steps are equal differences, or equal ratios.

use serde::Serialize;

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}

/// Positive values whose ratio is larger than this are on a logarithmic axis.
const FAR: f64 = 100.0;

impl Scale {
    /// The default scale of some values: logarithmic if all are above 0 and the largest is a
    /// hundred times the smallest or more.
    pub fn of(values: impl Iterator<Item = f64>) -> Scale {
        let is_far = |(low, high): (f64, f64)| low > 0.0 && high >= FAR * low;
        if super::lists::ends(values).is_some_and(is_far) { Scale::Log } else { Scale::Linear }
    }

    /// The place of a value.
    pub fn place(self, value: f64) -> f64 {
        match self {
            Scale::Linear => value,
            Scale::Log => libm::log10(value),
        }
    }

    /// The value at a place, rounded as people write it.
    pub fn value(self, place: f64) -> f64 {
        let value = match self {
            Scale::Linear => place,
            Scale::Log => libm::pow(10.0, place),
        };
        super::decimal::significant(value, 15)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_logarithmic_and_naught_never_is() {
        assert_eq!(Scale::of([0.01, 1.0, 10.0].into_iter()), Scale::Log);
        assert_eq!(Scale::of([50.0, 500.0].into_iter()), Scale::Linear);
        assert_eq!(Scale::of([0.0, 1e6].into_iter()), Scale::Linear);
    }

    #[test]
    fn places_go_back_to_their_values() {
        for scale in [Scale::Linear, Scale::Log] {
            for value in [0.01, 21544.3469003188, 1e7] {
                assert_eq!(scale.value(scale.place(value)), value, "{scale:?}");
            }
        }
    }
}
