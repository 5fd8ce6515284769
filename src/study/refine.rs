//! `[grid] refine`: which curves are to be known how well.

use toml::{Table, Value};

use super::axis::GridAxis;
use crate::keys::{Key, Section, read_alone, section};
use crate::quantities::{Column, named, summary};
use crate::scene::ConfigError;

section! {
    /// `refine = { ... }` in `[grid]`.
    pub struct Refine in "grid.refine" {
        /// The result whose curves are to be known between the points: a column of summary.csv in units of
        /// force, moment, impulse, runup, displacement, height or time, or of what goes over a crest.
        quantity: String, plain();
        /// How far linear interpolation between two neighbours may be off, in the quantity's own unit.
        to: f64, plain().above_zero();
        /// The most points that are added, those of all rounds together.
        most: u64 = 100, plain().within(1.0, 100_000.0);
    }
}

/// The keys of `refine`.
pub fn refine_keys() -> Vec<&'static Key> {
    Refine::keys()
}

impl Refine {
    /// Takes `refine` out of the grid.
    pub(super) fn take(grid: &mut Table) -> Result<Option<Refine>, ConfigError> {
        let table = match grid.remove("refine") {
            None => return Ok(None),
            Some(Value::Table(table)) => table,
            Some(other) => {
                let shape = "must be { quantity = \"displacement_max\", to = 0.02 }";
                return Err(ConfigError::new("grid.refine", other, shape));
            }
        };
        let known: Vec<_> = summary::ALL.iter().filter(|one| is_result(one)).collect();
        let asked = table.get("quantity").and_then(Value::as_str);
        let column = known.iter().find(|one| Some(one.name) == asked);
        if let (Some(column), Some(to @ Value::String(_))) = (column, table.get("to")) {
            return Err(ConfigError::new("grid.refine.to", to, in_unit_of(column)));
        }
        let refine: Refine = read_alone(&table)?;
        let names: Vec<_> = known.iter().map(|one| one.name).collect();
        if names.contains(&refine.quantity.as_str()) {
            return Ok(Some(refine));
        }
        Err(ConfigError::one_of("grid.refine.quantity", &refine.quantity.into(), &names))
    }

    /// The column.
    pub fn column(&self) -> &'static Column {
        named(&self.quantity).expect("the file was checked")
    }

    /// Refuses a grid with axes that cannot be refined.
    pub(super) fn check(axes: &[GridAxis]) -> Result<(), ConfigError> {
        let numeric = || axes.iter().filter_map(|axis| Some((axis, axis.numbers()?)));
        if let Some((axis, _)) = numeric().find(|(_, values)| !is_monotone(values)) {
            let allowed = "must rise or fall from value to value where refine adds some between";
            return Err(ConfigError::new(&format!("grid.{}", axis.key), "", allowed));
        }
        if numeric().all(|(_, values)| values.len() < 2) {
            let allowed = "needs a swept key with two numbers or more";
            return Err(ConfigError::new("grid.refine", "", allowed));
        }
        Ok(())
    }
}

/// What `to` must be for a quantity, in words: no share of it.
fn in_unit_of(column: &Column) -> String {
    let name = column.name;
    match column.unit.symbol() {
        "" => format!("must be a number alone, without a unit as {name} itself"),
        unit => format!("must be a number alone, in the unit of {name}, {unit}"),
    }
}

/// Whether a column is a result of the water: a number that is the same on every machine.
fn is_result(column: &Column) -> bool {
    let others = [
        &summary::ONSET_TIME,
        &summary::RISE_TIME,
        &summary::MEASURED_WAVE_HEIGHT_RATIO,
        &summary::OVERTOPPING_VOLUME,
        &summary::OVERTOPPING_DISCHARGE,
        &summary::CREST_THICKNESS,
        &summary::CREST_SPEED,
    ];
    column.is_number() && !column.is_bar() && (column.unit.is_ratio() || others.contains(&column))
}

fn is_monotone(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[0] < pair[1])
        || values.windows(2).all(|pair| pair[0] > pair[1])
}
