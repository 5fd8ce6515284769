//! Results at a prototype's size by Froude's law, same gravity and density. Lengths, pressures: λ.
//! Times: √λ. Per metre: forces and volumes λ², moments λ³, discharges λ^1.5.

use std::str::FromStr;

use super::error::ReportError;
use super::load::Loaded;
use super::row::Row;
use super::tables::Table;
use crate::quantities::Column;
use crate::quantities::summary::{
    CASE_ID, CREST_SPEED, CREST_THICKNESS, DISPLACEMENT_ERROR, DISPLACEMENT_MAX,
    DISPLACEMENT_TRUNCATED, DOUBTFUL, FIRST_FORCE_MAX, FIRST_IMPULSE, FIRST_MOMENT_MAX,
    FIRST_RUNUP_MAX, FORCE_ERROR, FORCE_MAX, FORCE_MAX_ERROR, MOMENT_ERROR, MOMENT_MAX,
    MOMENT_MAX_ERROR, OVERTOPPING_DISCHARGE, OVERTOPPING_VOLUME, OVERTOPPING_VOLUME_ERROR,
    RISE_TIME, RUNUP_ERROR, RUNUP_MAX, RUNUP_MAX_ERROR, SPRING_FORCE_MAX,
};
use crate::scene::{Frame, Scene};

/// The length of the prototype over that of the tank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Froude(f64);

impl FromStr for Froude {
    type Err = String;

    fn from_str(text: &str) -> Result<Froude, String> {
        let scale = text.strip_prefix("1:").unwrap_or(text).parse::<f64>().ok();
        let scale = scale.filter(|scale| (1e-6..=1e6).contains(scale));
        let allowed = "must be a number from 1e-6 to 1e6: 20 makes of every metre of the tank 20 m";
        scale.map(Froude).ok_or_else(|| allowed.to_owned())
    }
}

/// A scaled quantity: its column, its unit in the tank, and its power of the scale.
struct Scaled {
    column: &'static Column,
    /// Its name with the unit of the prototype.
    name: &'static str,
    unit: fn(&Water) -> f64,
    power: f64,
}

/// The tank's scales, in SI units.
struct Water {
    gravity: f64,
    /// Depth of the still water, and the depth that scales forces.
    depth: f64,
    force_depth: f64,
    /// Newtons per metre for F* = 1.
    force: f64,
}

impl Water {
    /// From a case's scene; `None` where it has no still water.
    fn of(scene: &Scene) -> Option<Water> {
        scene.entry("still_water_depth_m")?;
        let Frame { gravity, depth, .. } = scene.frame();
        let (force, force_depth) = (scene.force_unit_n_per_m(), scene.force_depth_m());
        Some(Water { gravity, depth, force_depth, force })
    }
}

const KILO: f64 = 1e-3;

/// A force in kilonewtons per metre.
const fn force(column: &'static Column, name: &'static str) -> Scaled {
    Scaled { column, name, unit: |water| KILO * water.force, power: 2.0 }
}

/// A length in metres.
const fn length(column: &'static Column, name: &'static str) -> Scaled {
    Scaled { column, name, unit: |water| water.depth, power: 1.0 }
}

/// A moment in kilonewton metres per metre.
const fn moment(column: &'static Column, name: &'static str) -> Scaled {
    Scaled { column, name, unit: |water| KILO * water.force * water.force_depth / 3.0, power: 3.0 }
}

/// A quantity that keeps its unit.
const fn same(column: &'static Column, name: &'static str, power: f64) -> Scaled {
    Scaled { column, name, unit: |_| 1.0, power }
}

const SCALED: [Scaled; 14] = [
    force(&FIRST_FORCE_MAX, "first_force_max_kn_per_m"),
    force(&FORCE_MAX, "force_max_kn_per_m"),
    moment(&FIRST_MOMENT_MAX, "first_moment_max_kn_m_per_m"),
    moment(&MOMENT_MAX, "moment_max_kn_m_per_m"),
    Scaled {
        column: &FIRST_IMPULSE,
        name: "first_impulse_kn_s_per_m",
        unit: |water| KILO * water.force * (water.depth / water.gravity).sqrt(),
        power: 2.5,
    },
    Scaled { column: &RISE_TIME, name: "rise_time_s", unit: |_| 1.0, power: 0.5 },
    length(&FIRST_RUNUP_MAX, "first_runup_max_m"),
    length(&RUNUP_MAX, "runup_max_m"),
    length(&DISPLACEMENT_MAX, "displacement_max_m"),
    force(&SPRING_FORCE_MAX, "spring_force_max_kn_per_m"),
    same(&OVERTOPPING_VOLUME, "overtopping_volume_m2", 2.0),
    same(&OVERTOPPING_DISCHARGE, "overtopping_discharge_max_m2_per_s", 1.5),
    same(&CREST_THICKNESS, "crest_thickness_max_m", 1.0),
    same(&CREST_SPEED, "crest_speed_max_m_per_s", 0.5),
];

/// The error bars of the quantities that have one.
const ERRORS: [Scaled; 8] = [
    force(&FORCE_ERROR, "force_error_kn_per_m"),
    length(&RUNUP_ERROR, "runup_error_m"),
    length(&DISPLACEMENT_ERROR, "displacement_error_m"),
    force(&FORCE_MAX_ERROR, "force_max_error_kn_per_m"),
    length(&RUNUP_MAX_ERROR, "runup_max_error_m"),
    same(&OVERTOPPING_VOLUME_ERROR, "overtopping_volume_error_m2", 2.0),
    moment(&MOMENT_ERROR, "moment_error_kn_m_per_m"),
    moment(&MOMENT_MAX_ERROR, "moment_max_error_kn_m_per_m"),
];

impl Froude {
    /// The names of the tables.
    pub const TABLES: [&str; 2] = ["prototype", "prototype_envelope"];

    /// The scale as text: `1:20`.
    pub fn words(self) -> String {
        format!("1:{}", self.0)
    }

    fn grown(self, value: f64, power: f64) -> f64 {
        value * libm::pow(self.0, power)
    }

    /// The maxima and the envelopes of all finished cases at the size of the prototype; none where
    /// the directory does not hold the scenes of its cases.
    pub fn tables(self, data: &Loaded) -> Result<Vec<Table>, ReportError> {
        let (mut maxima, mut envelope) = (Vec::new(), Vec::new());
        let water = |place| Water::of(&data.case(place)?.scene);
        let waters = data.in_blocks(data.placed().map(|(place, _)| place), water);
        for (row, water) in data.finished().zip(waters) {
            let Some(water) = water else { continue };
            let head = || [row.id().to_owned(), row.words(), self.words()].into_iter();
            let pressed = data.envelope(row.id())?;
            let most = pressed.iter().map(|at| at.pressure_max_pa).max_by(f64::total_cmp);
            let depth = self.grown(water.depth, 1.0);
            let numbers = [Some(depth), most.map(|most| KILO * self.grown(most, 1.0))].into_iter();
            let numbers = numbers.chain(SCALED.iter().map(|one| self.number(one, row, &water)));
            let [bound, doubt] =
                [&DISPLACEMENT_TRUNCATED, &DOUBTFUL].map(|flag| row.text(flag).to_owned());
            let errors = ERRORS.iter().map(|one| cell(self.number(one, row, &water)));
            let flags = [bound].into_iter().chain(errors).chain([doubt]);
            maxima.push(head().chain(numbers.map(cell)).chain(flags).collect());
            envelope.extend(pressed.iter().map(|at| {
                let pressures = [Some(at.pressure_max_pa), at.first_pressure_max_pa];
                let kilo = pressures.map(|one| one.map(|one| KILO * self.grown(one, 1.0)));
                let height = Some(self.grown(at.height_m, 1.0));
                head().chain([height].into_iter().chain(kilo).map(cell)).collect()
            }));
        }
        let title = format!("At the size of the prototype, Froude scale {}", self.words());
        let first = [CASE_ID.name, "case", "froude_scale"];
        let sizes = ["still_water_depth_m", "pressure_max_kpa"];
        let columns = sizes.into_iter().chain(SCALED.iter().map(|one| one.name));
        let errors = ERRORS.iter().map(|one| one.name).chain([DOUBTFUL.name]);
        let flags = [DISPLACEMENT_TRUNCATED.name].into_iter().chain(errors);
        let columns: Vec<_> = first.into_iter().chain(columns).chain(flags).collect();
        let heights = ["height_m", "pressure_max_kpa", "first_pressure_max_kpa"];
        let heights = [&first[..], &heights].concat();
        let tables = [
            Table::new(Froude::TABLES[0], &title, &columns, maxima),
            Table::new(Froude::TABLES[1], &title, &heights, envelope),
        ];
        Ok(tables.into_iter().filter(|table| !table.rows.is_empty()).collect())
    }

    /// The table of the maxima as the page shows it.
    pub fn for_page(maxima: &Table) -> Table {
        let bar = |column: &Column| {
            let bar = ERRORS.iter().find(|error| column.bar == Some(error.column.name));
            bar.map(|error| error.name)
        };
        maxima.joined(SCALED.iter().map(|one| (one.name, bar(one.column), one.column.bound)))
    }

    fn number(self, scaled: &Scaled, row: &Row, water: &Water) -> Option<f64> {
        let value = row.number(scaled.column)?;
        Some(self.grown(value * (scaled.unit)(water), scaled.power))
    }
}

/// Six digits: none of these numbers is more precise.
fn cell(value: Option<f64>) -> String {
    let told = |value| crate::math::decimal::significant(value, 6).to_string();
    value.map(told).unwrap_or_default()
}

#[cfg(test)]
mod tests;
