//! The subject of a condition: a column of numbers, case by case.

use crate::keys::hint;
use crate::quantities::summary::{ALL, names};
use crate::quantities::{Column, meant_by, name_of_symbol, named};
use crate::report::load::Loaded;
use crate::report::row::Row;

/// A column of the summary, or a swept key.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Its name in the summary.
    pub name: String,
    /// Its number in each row.
    pub readings: Vec<Number>,
    /// Whether its values are `true`, read as 1, and `false`, read as 0.
    pub is_flag: bool,
}

/// 1 for `true`, 0 for `false`.
pub(super) fn flag(text: &str) -> Option<f64> {
    Some(f64::from(u8::from(text.parse::<bool>().ok()?)))
}

/// A case's number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Number {
    /// A value, with its error bar where it has one; the true value may lie above a bound.
    Value {
        /// The number.
        value: f64,
        /// Its error bar.
        bar: Option<f64>,
        /// Whether it is only a lower bound.
        bound: bool,
    },
    /// The case has no such number.
    Missing,
    /// The case failed.
    Failed,
}

impl Subject {
    /// The column of that name or symbol.
    ///
    /// # Errors
    /// A name that no column has, or a column of words.
    pub fn of(name: &str, data: &Loaded) -> Result<Subject, String> {
        let swept = |name: &str| data.keys.iter().find(|key| key.name == name);
        let is_name = named(name).is_some() || swept(name).is_some();
        let name = if is_name { name } else { name_of_symbol(name).unwrap_or(name) };
        let key = swept(name);
        let (column, maximum) = (named(name), with_time(name));
        let reading = |(at, row): (usize, &Row)| {
            let (mut bar, mut bound) = (None, false);
            let value = match (key, column, maximum) {
                (Some(key), ..) => key.cells[at].parse().ok().or_else(|| flag(&key.cells[at])),
                _ if !row.is_ok() => None,
                (_, Some(column), _) => {
                    (bar, bound) = (row.error(column).map(f64::abs), row.is_bound(column));
                    row.number(column).or_else(|| flag(row.text(column)))
                }
                (.., maximum) => maximum.and_then(|maximum| row.time(maximum)),
            };
            match value {
                Some(value) => Number::Value { value, bar, bound },
                None if row.is_ok() => Number::Missing,
                None => Number::Failed,
            }
        };
        let is_flag = column.is_some_and(Column::is_flag)
            || key.is_some_and(|key| key.cells.different().any(|cell| flag(cell).is_some()));
        let words = column.is_some_and(|column| !column.is_number() && !is_flag)
            || key.is_some_and(|key| key.cells.iter().any(is_word));
        if words {
            return Err(format!("{name}: holds words; a condition needs a column of numbers"));
        }
        if key.is_none() && column.is_none() && maximum.is_none() {
            return Err(unknown(name, data));
        }
        let readings = data.rows.iter().enumerate().map(reading).collect();
        Ok(Subject { name: name.to_owned(), readings, is_flag })
    }

    /// A case's value, unless it is a bound.
    pub fn exact(&self, row: usize) -> Option<f64> {
        match self.readings[row] {
            Number::Value { value, bound: false, .. } => Some(value),
            _ => None,
        }
    }

    /// A case's error bar.
    pub fn bar(&self, row: usize) -> Option<f64> {
        match self.readings[row] {
            Number::Value { bar, .. } => bar,
            _ => None,
        }
    }
}

fn is_word(cell: &str) -> bool {
    !cell.is_empty() && cell.parse::<f64>().is_err() && flag(cell).is_none()
}

/// The maximum whose time is in the column of this name.
fn with_time(name: &str) -> Option<&'static Column> {
    ALL.iter().copied().find(|column| column.time_name().as_deref() == Some(name))
}

fn unknown(name: &str, data: &Loaded) -> String {
    let numbers = names().filter(|name| named(name).is_none_or(Column::is_number));
    let known: Vec<_> = data.keys.iter().map(|key| key.name.clone()).chain(numbers).collect();
    let hint = meant_by(name).unwrap_or_else(|| hint(name, &known));
    format!("{name}: no column of numbers has this name{hint} (`seawall explain` lists all)")
}
