//! One row of `summary.csv`, as far as the report needs it.

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
use crate::quantities::{Column, named, of_first_impact};

/// What tells a case from the others, as a rule.
pub(super) const PLACE: [&Column; 3] = [&WAVE_HEIGHT_RATIO, &SPRING_STIFFNESS, &SEAWALL_MASS];

/// What `paddle` is where waves are regular.
pub(super) const REGULAR: &str = "wave-train";

/// What `paddle` is where it plays a record.
pub(super) const RECORDED: &str = "recorded-stroke";

/// The key that tells kinds of paddles apart, where it was swept.
const PADDLE: &str = "paddle";

/// The key that tells kinds of walls apart, where it was swept.
const WALL: &str = "wall";

/// Where the columns of a table stand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Header {
    places: HashMap<String, usize>,
    declared: Vec<Option<&'static Column>>,
}

impl Header {
    /// Of these columns.
    pub fn new<'a>(names: impl Iterator<Item = &'a str>) -> Header {
        let names: Vec<_> = names.collect();
        let place = |(place, name): (usize, &&str)| ((*name).to_owned(), place);
        Header {
            places: names.iter().enumerate().map(place).collect(),
            declared: names.iter().map(|name| named(name)).collect(),
        }
    }
}

/// The cells of one case, by their columns. A column that is not there is empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Row {
    header: Arc<Header>,
    /// All cells, one behind the other, and where each ends.
    text: Box<str>,
    ends: Ends,
    /// Of a fixed wall; upright where nothing says otherwise.
    pub wall_angle_deg: Option<f64>,
    /// The paddle makes regular waves.
    pub regular: bool,
    /// The paddle plays a record, and nobody asked for a wave height. Words leave it out; it stays the row's place.
    pub unasked: bool,
    /// What `wall` says in the study's file, where it was not swept.
    pub wall: Option<Arc<str>>,
    /// Which of several runs with the same wave and wall this is, such as `boundary = sfdi`;
    /// empty where the sweep holds only one.
    pub variant: Arc<str>,
}

impl Row {
    /// A row of a table with this header.
    ///
    /// # Errors
    /// The place of a cell that should be a number and is none, and what is wrong with it.
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

    /// Whether a column of this name means nothing for this case: the first impact of regular waves.
    fn is_idle(&self, name: &str) -> bool {
        self.regular && of_first_impact(name)
    }

    fn named(&self, name: &str) -> &str {
        if self.is_idle(name) {
            return "";
        }
        let Some(&place) = self.header.places.get(name) else { return "" };
        let Some(end) = self.ends.get(place) else { return "" };
        let start = place.checked_sub(1).and_then(|before| self.ends.get(before)).unwrap_or(0);
        &self.text[start..end]
    }

    /// A cell as it stands.
    pub fn text(&self, column: &Column) -> &str {
        self.named(column.name)
    }

    /// The id of its case.
    pub fn id(&self) -> &str {
        self.text(&CASE_ID)
    }

    /// A number, a volume of no water as 0; `None` where the cell is empty.
    pub fn number(&self, column: &Column) -> Option<f64> {
        self.text(column).parse().ok().map(|value| column.told_value(value))
    }

    /// When a maximum was reached, seconds.
    pub fn time(&self, column: &Column) -> Option<f64> {
        self.named(&format!("{}_time_s", column.name)).parse().ok()
    }

    /// A flag.
    pub fn is(&self, flag: &Column) -> bool {
        self.text(flag) == "true"
    }

    /// Which of two columns is told, that of the first impact or that of the whole run. The whole run counts where there
    /// was no first impact. It counts for regular waves, too: each comes onto what the ones before have left.
    pub fn impact(&self, first: &'static Column, whole: &'static Column) -> &'static Column {
        if self.regular || self.number(first).is_none() { whole } else { first }
    }

    /// The error bar of a number.
    pub fn error(&self, column: &Column) -> Option<f64> {
        self.number(named(column.bar?)?)
    }

    /// The number is only a lower bound.
    pub fn is_bound(&self, column: &Column) -> bool {
        column.bound.and_then(named).is_some_and(|flag| self.is(flag))
    }

    /// A cell, with every digit of a number and no exponent.
    pub fn cell(&self, column: &Column) -> String {
        let number = self.number(column).filter(|_| column.is_number());
        number.map_or_else(|| self.text(column).to_owned(), |number| number.to_string())
    }

    /// A cell with as many digits as its column shows.
    pub fn brief(&self, column: &Column) -> String {
        let number = self.number(column);
        let told = number.and_then(|value| number::with_digits(value, column.digits));
        told.unwrap_or_else(|| self.cell(column))
    }

    /// The case ran to its end.
    pub fn is_ok(&self) -> bool {
        self.text(&STATUS) == "ok"
    }

    /// The wall does not move: it has neither spring nor mass.
    pub fn is_fixed(&self) -> bool {
        [&SPRING_STIFFNESS, &SEAWALL_MASS].iter().all(|column| self.number(column).is_none())
    }

    /// The wall has a mass and no spring, and so no stop.
    pub fn is_springless(&self) -> bool {
        self.number(&SEAWALL_MASS).is_some() && self.number(&SPRING_STIFFNESS).is_none()
    }

    /// What kind of wall one without a spring is: a caisson, where no file says.
    pub fn kind(&self) -> &str {
        let swept = Some(self.named(WALL)).filter(|wall| !wall.is_empty());
        swept.or(self.wall.as_deref()).unwrap_or("caisson")
    }

    /// The wall comes back onto its stop, a load that no maximum counts.
    pub fn hits_stop(&self) -> bool {
        self.number(&STOPS).is_some_and(|stops| stops > 0.0)
    }

    /// The wall of a wave tank, and no water stands at it.
    pub fn stands_dry(&self) -> bool {
        self.number(&WAVE_HEIGHT_RATIO).is_some() && self.number(&FORCE_AT_REST) == Some(0.0)
    }

    /// The wall stands upright.
    pub fn is_vertical(&self) -> bool {
        self.wall_angle_deg.is_none_or(|angle| angle == 90.0)
    }

    /// Wave, stiffness and mass as bits, so that they can be compared and sorted on.
    pub(super) fn place(&self) -> [u64; 3] {
        PLACE.map(|column| self.number(column).unwrap_or(f64::NAN).to_bits())
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
