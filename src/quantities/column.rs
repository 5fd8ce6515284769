//! A column of `summary.csv`, and how it is read.

use super::{Case, Column, Quantity, Unit, Value, named};
use crate::simulation::Maximum;

/// How a column is read; empty where there is nothing to read.
#[derive(Debug, Clone, Copy)]
pub enum Read {
    /// Words.
    Text(fn(&Case<'_>) -> Option<String>),
    /// A count.
    Count(fn(&Case<'_>) -> Option<u64>),
    /// A flag.
    Flag(fn(&Case<'_>) -> Option<bool>),
    /// A number.
    Number(fn(&Case<'_>) -> Option<f64>),
    /// A largest value, and when it was reached, which stands in a column of its own.
    Maximum(fn(&Case<'_>) -> Option<Maximum>),
}

/// Less water than that is none, m² and m²/s: a thousandth of a square millimetre.
const NAUGHT: f64 = 1e-9;

impl Column {
    /// Its value in a case.
    pub fn value(&self, case: &Case<'_>) -> Option<Value> {
        match self.read {
            Read::Text(read) => read(case).map(Value::Text),
            Read::Count(read) => read(case).map(Value::Count),
            Read::Flag(read) => read(case).map(Value::Flag),
            Read::Number(read) => read(case).map(Value::Number),
            Read::Maximum(read) => read(case).map(|maximum| Value::Number(maximum.value)),
        }
    }

    /// Its number in a case.
    pub fn number(&self, case: &Case<'_>) -> Option<f64> {
        match self.value(case)? {
            Value::Number(number) => Some(number),
            Value::Count(count) => Some(count as f64),
            Value::Flag(_) | Value::Text(_) => None,
        }
    }

    /// The error bar of its number in a case.
    pub fn error(&self, case: &Case<'_>) -> Option<f64> {
        self.bar.and_then(named)?.number(case)
    }

    /// Whether its number in a case is only a lower bound.
    pub fn is_bound(&self, case: &Case<'_>) -> bool {
        let is_set = |flag: &Column| flag.value(case) == Some(Value::Flag(true));
        self.is_bound_by(is_set, |column| column.time(case))
    }

    /// The same by flags and by times of maxima, seconds: the wall still moves at the end, and the
    /// number is of the instant of the largest displacement.
    pub fn is_bound_by(
        &self,
        is_set: impl Fn(&Column) -> bool,
        time: impl Fn(&Column) -> Option<f64>,
    ) -> bool {
        let moves = self.bound.and_then(named).is_some_and(is_set);
        moves && time(self) == named("displacement_max").and_then(time)
    }

    /// When a maximum was reached, seconds. An impulse of 0 has no time: there was none.
    pub fn time(&self, case: &Case<'_>) -> Option<f64> {
        let Read::Maximum(read) = self.read else { return None };
        let reached =
            read(case).filter(|maximum| self.unit != Unit::Impulse || maximum.value != 0.0);
        reached.map(|maximum| maximum.time_s)
    }

    /// A number as it is told: of volumes and discharges of no water sums leave some 10⁻¹² m².
    pub fn told_value(&self, value: f64) -> f64 {
        let of_water = [Unit::SquareMetres, Unit::SquareMetresPerSecond].contains(&self.unit);
        if of_water && value.abs() < NAUGHT { 0.0 } else { value }
    }

    /// Whether it has a second column, with the time of a maximum.
    pub fn has_time(&self) -> bool {
        matches!(self.read, Read::Maximum(_))
    }

    /// The name of that column.
    pub fn time_name(&self) -> Option<String> {
        self.has_time().then(|| format!("{}_time_s", self.name))
    }

    /// Whether it has a number in a case that means something there.
    pub fn is_told(&self, case: &Case<'_>) -> bool {
        let regular = case.seawall().is_some_and(|scene| scene.wave_train.is_some());
        self.value(case).is_some() && !(regular && self.of_a_single_wave)
    }

    /// Whether it holds words.
    pub fn is_text(&self) -> bool {
        matches!(self.read, Read::Text(_))
    }

    /// Whether it holds `true` and `false`.
    pub fn is_flag(&self) -> bool {
        matches!(self.read, Read::Flag(_))
    }

    /// Whether it holds numbers.
    pub fn is_number(&self) -> bool {
        !matches!(self.read, Read::Text(_) | Read::Flag(_))
    }
}

/// Whether a column of this name, which may be that of a maximum's time, means something for a
/// single wave alone.
pub fn of_a_single_wave(name: &str) -> bool {
    let of_time = || named(name.strip_suffix("_time_s")?);
    named(name).or_else(of_time).is_some_and(|column| column.of_a_single_wave)
}

pub(super) const fn text(
    name: &'static str,
    symbol: &'static str,
    read: fn(&Case<'_>) -> Option<String>,
) -> Column {
    Quantity::new(name, symbol, Unit::Pure, Read::Text(read))
}

pub(super) const fn count(name: &'static str, read: fn(&Case<'_>) -> Option<u64>) -> Column {
    Quantity::new(name, "", Unit::Pure, Read::Count(read))
}

pub(super) const fn flag(
    name: &'static str,
    symbol: &'static str,
    read: fn(&Case<'_>) -> Option<bool>,
) -> Column {
    Quantity::new(name, symbol, Unit::Pure, Read::Flag(read))
}

pub(super) const fn number(
    name: &'static str,
    symbol: &'static str,
    unit: Unit,
    read: fn(&Case<'_>) -> Option<f64>,
) -> Column {
    Quantity::new(name, symbol, unit, Read::Number(read))
}

pub(super) const fn maximum(
    name: &'static str,
    symbol: &'static str,
    unit: Unit,
    read: fn(&Case<'_>) -> Option<Maximum>,
) -> Column {
    Quantity::new(name, symbol, unit, Read::Maximum(read)).significant(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The story: where no water went over, the volume was told as -2.558e-15 m².
    #[test]
    fn a_volume_of_no_water_is_told_as_none() {
        let [volume, force] =
            ["overtopping_volume_m2", "force_max"].map(|name| named(name).unwrap());
        assert_eq!(
            [1.3e-14, -2.6e-15, 2e-6].map(|value| volume.told_value(value)),
            [0.0, 0.0, 2e-6]
        );
        assert_eq!(force.told_value(1e-12), 1e-12);
    }
}
