//! One row of `summary.csv`, with what the report needs of it.

mod ends;
mod words;

use std::collections::HashMap;
use std::sync::Arc;

use self::ends::Ends;
pub(super) use self::words::label;
use super::number;
use crate::quantities::summary::{
    CASE_ID, FORCE_AT_REST, SEAWALL_MASS, SPRING_STIFFNESS, STATUS, STOPS, WAVE_HEIGHT_RATIO,
};
use crate::quantities::{Column, named, of_a_single_wave};

/// The columns that usually tell a case from the others.
pub(super) const PLACE: [&Column; 3] = [&WAVE_HEIGHT_RATIO, &SPRING_STIFFNESS, &SEAWALL_MASS];

/// The value of `paddle` for regular waves.
pub(super) const REGULAR: &str = "wave-train";

/// The value of `paddle` for a recorded stroke.
pub(super) const RECORDED: &str = "recorded-stroke";

/// The key that tells kinds of paddles apart, if it was swept.
const PADDLE: &str = "paddle";

/// The key that tells kinds of walls apart, if it was swept.
const WALL: &str = "wall";

/// The places of a table's columns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Header {
    places: HashMap<String, usize>,
    declared: Vec<Option<&'static Column>>,
}

impl Header {
    /// The places of these columns.
    pub fn new<'a>(names: impl Iterator<Item = &'a str>) -> Header {
        let names: Vec<_> = names.collect();
        let place = |(place, name): (usize, &&str)| ((*name).to_owned(), place);
        Header {
            places: names.iter().enumerate().map(place).collect(),
            declared: names.iter().map(|name| named(name)).collect(),
        }
    }
}

/// The cells of one case, by column. A missing column counts as empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Row {
    header: Arc<Header>,
    /// All cells, one after the other.
    text: Box<str>,
    ends: Ends,
    /// The angle of a fixed wall; upright where nothing else is said.
    pub wall_angle_deg: Option<f64>,
    /// Whether the paddle makes regular waves.
    pub regular: bool,
    /// Whether a record is played without a given wave height. Words leave the height out.
    pub unasked: bool,
    /// The value of `wall` in the study's file, if it was not swept.
    pub wall: Option<Arc<str>>,
    /// Tells several runs with the same wave and wall apart, such as `boundary = sfdi`. Empty if
    /// the sweep has only one.
    pub variant: Arc<str>,
}

impl Row {
    /// A row of a table with this header.
    ///
    /// # Errors
    /// The place of a cell that should be a number but is none, and what is wrong with it.
    pub fn new<'a>(
        header: &Arc<Header>,
        cells: impl Iterator<Item = &'a str>,
    ) -> Result<Row, (usize, String)> {
        let (mut text, mut ends) = (String::new(), Vec::with_capacity(header.declared.len()));
        for (place, cell) in cells.enumerate() {
            let column = header.declared.get(place).copied().flatten();
            let number = column.is_some_and(Column::is_number) && !cell.is_empty();
            if number && cell.parse::<f64>().is_err() {
                return Err((place, format!("{cell:?} is no number")));
            }
            text.push_str(cell);
            ends.push(text.len());
        }
        let (header, text, ends) = (header.clone(), text.into(), Ends::of(&ends));
        let row = Row { header, text, ends, ..Row::default() };
        let wall_angle_deg = row.named("wall_angle_deg").parse().ok();
        let [regular, unasked] = [REGULAR, RECORDED].map(|paddle| row.named(PADDLE) == paddle);
        Ok(Row { wall_angle_deg, regular, unasked, ..row })
    }

    /// Whether a column means nothing here: the first crest and the first impact of regular waves.
    fn is_idle(&self, name: &str) -> bool {
        self.regular && of_a_single_wave(name)
    }

    fn named(&self, name: &str) -> &str {
        if self.is_idle(name) {
            return "";
        }
        self.header.places.get(name).map_or("", |&place| self.at(place))
    }

    fn at(&self, place: usize) -> &str {
        let Some(end) = self.ends.get(place) else { return "" };
        let start = place.checked_sub(1).and_then(|before| self.ends.get(before)).unwrap_or(0);
        &self.text[start..end]
    }

    /// All cells as they stand in the file, each with the name of its column.
    pub fn cells(&self) -> impl Iterator<Item = (&str, &str)> {
        self.header.places.iter().map(|(name, &place)| (name.as_str(), self.at(place)))
    }

    /// A cell as it stands.
    pub fn text(&self, column: &Column) -> &str {
        self.named(column.name)
    }

    /// The id of its case.
    pub fn id(&self) -> &str {
        self.text(&CASE_ID)
    }

    /// A number, where a volume of no water is 0; `None` where the cell is empty.
    pub fn number(&self, column: &Column) -> Option<f64> {
        self.text(column).parse().ok().map(|value| column.told_value(value))
    }

    /// When a maximum was reached, seconds.
    pub fn time(&self, column: &Column) -> Option<f64> {
        self.named(&format!("{}_time_s", column.name)).parse().ok()
    }

    /// Whether a flag is set.
    pub fn is(&self, flag: &Column) -> bool {
        self.text(flag) == "true"
    }

    /// The column that is reported: the first impact's or the whole run's. The latter counts if
    /// there was no first impact, and for regular waves: earlier ones change later ones.
    pub fn impact(&self, first: &'static Column) -> &'static Column {
        let none = self.regular || self.number(first).is_none();
        if none { first.of_whole_run() } else { first }
    }

    /// The error bar of a number.
    pub fn error(&self, column: &Column) -> Option<f64> {
        self.number(named(column.bar?)?)
    }

    /// Whether the number is only a lower bound.
    pub fn is_bound(&self, column: &Column) -> bool {
        column.is_bound_by(|flag| self.is(flag), |of| self.time(of))
    }

    /// A cell, with every digit of a number and no exponent.
    pub fn cell(&self, column: &Column) -> String {
        let number = self.number(column).filter(|_| column.is_number());
        number.map_or_else(|| self.text(column).to_owned(), |number| number.to_string())
    }

    /// A cell with as many digits as its column shows.
    pub fn rounded(&self, column: &Column) -> String {
        let number = self.number(column);
        let told = number.and_then(|value| number::with_digits(value, column.digits));
        told.unwrap_or_else(|| self.cell(column))
    }

    /// Whether the case ran to its end.
    pub fn is_ok(&self) -> bool {
        self.text(&STATUS) == "ok"
    }

    /// Whether the wall does not move: it has neither spring nor mass.
    pub fn is_fixed(&self) -> bool {
        [&SPRING_STIFFNESS, &SEAWALL_MASS].iter().all(|column| self.number(column).is_none())
    }

    /// Whether the wall has a mass but no spring, and so no stop.
    pub fn is_springless(&self) -> bool {
        self.number(&SEAWALL_MASS).is_some() && self.number(&SPRING_STIFFNESS).is_none()
    }

    /// The kind of a wall without a spring: a caisson, unless a file says otherwise.
    pub fn kind(&self) -> &str {
        let swept = Some(self.named(WALL)).filter(|wall| !wall.is_empty());
        swept.or(self.wall.as_deref()).unwrap_or("caisson")
    }

    /// Whether the wall comes back onto its stop. This load counts for no maximum.
    pub fn hits_stop(&self) -> bool {
        self.number(&STOPS).is_some_and(|stops| stops > 0.0)
    }

    /// Whether it is a wall in a wave tank at which no water stands.
    pub fn stands_dry(&self) -> bool {
        self.number(&WAVE_HEIGHT_RATIO).is_some() && self.number(&FORCE_AT_REST) == Some(0.0)
    }

    /// Whether the wall stands upright.
    pub fn is_vertical(&self) -> bool {
        self.wall_angle_deg.is_none_or(|angle| angle == 90.0)
    }

    /// Wave, stiffness and mass as bits, for comparing and sorting.
    pub(super) fn place(&self) -> [u64; 3] {
        PLACE.map(|column| self.number(column).unwrap_or(f64::NAN).to_bits())
    }

    /// Changes a value.
    #[cfg(test)]
    pub fn set(&mut self, column: &'static Column, value: impl ToString) -> &mut Row {
        *self = std::mem::take(self).with(column, value);
        self
    }

    /// The row with another value.
    #[cfg(test)]
    pub fn with(self, column: &'static Column, value: impl ToString) -> Row {
        let mut names: Vec<_> = self.header.places.iter().collect();
        names.sort_by_key(|(_, place)| **place);
        let others = names.into_iter().map(|(name, _)| name).filter(|name| *name != column.name);
        let others = others.map(|name| (name.clone(), self.named(name).to_owned()));
        let own = (column.name.to_owned(), value.to_string());
        let cells: Vec<_> = others.chain([own]).collect();
        let header = Arc::new(Header::new(cells.iter().map(|(name, _)| name.as_str())));
        let Row { wall_angle_deg, regular, unasked, wall, variant, .. } = self;
        let row = Row::new(&header, cells.iter().map(|(_, cell)| cell.as_str())).unwrap();
        Row { wall_angle_deg, regular, unasked, wall, variant, ..row }
    }
}
