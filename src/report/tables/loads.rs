//! What engineers design for: loads on the wall, and water that goes over its crest.

use super::{Field, Lines, fields, over_goda, table, variant};
use crate::quantities::Column;
use crate::quantities::summary::{
    CASE_ID, CREST_SPEED, CREST_THICKNESS, FIRST_FORCE_MAX, FIRST_IMPULSE, FIRST_MOMENT_MAX,
    FORCE_ERROR, FORCE_MAX, FORCE_MAX_ERROR, MOMENT_ERROR, MOMENT_MAX, MOMENT_MAX_ERROR,
    OVERTOPPING_DISCHARGE, OVERTOPPING_VOLUME, OVERTOPPING_VOLUME_ERROR, RISE_TIME,
    SPRING_FORCE_MAX,
};
use crate::report::load::Loaded;
use crate::report::row::{PLACE, Row};

const LOADS: [&Column; 11] = [
    &FIRST_FORCE_MAX,
    &FORCE_MAX,
    &FIRST_MOMENT_MAX,
    &MOMENT_MAX,
    &FIRST_IMPULSE,
    &RISE_TIME,
    &SPRING_FORCE_MAX,
    &FORCE_ERROR,
    &FORCE_MAX_ERROR,
    &MOMENT_ERROR,
    &MOMENT_MAX_ERROR,
];

const OVER: [&Column; 5] = [
    &OVERTOPPING_VOLUME,
    &OVERTOPPING_VOLUME_ERROR,
    &OVERTOPPING_DISCHARGE,
    &CREST_THICKNESS,
    &CREST_SPEED,
];

/// Force with Goda's formula, moment, impulse, rise time and spring force of every finished case;
/// `None` where no case has a moment.
pub fn loads(data: &Loaded) -> Option<Lines<'_>> {
    let columns = columns(data, &LOADS, Some(over_goda(data)));
    table("loads", "Loads on the wall", columns, having(data, &MOMENT_MAX)).filled()
}

/// The water that goes over the crest; `None` where no wall has a crest.
pub fn overtopping(data: &Loaded) -> Option<Lines<'_>> {
    let columns = columns(data, &OVER, None);
    table("overtopping", "Over the crest", columns, having(data, &OVERTOPPING_VOLUME)).filled()
}

fn columns<'a>(data: &Loaded, told: &[&'static Column], more: Option<Field<'a>>) -> Vec<Field<'a>> {
    let columns = fields(&[&[&CASE_ID][..], &PLACE, told].concat());
    columns.into_iter().chain(more).chain(variant(data.finished())).collect()
}

/// The finished cases that have a number in a column.
fn having<'a>(data: &'a Loaded, column: &'static Column) -> impl Iterator<Item = (usize, &'a Row)> {
    data.placed().filter(|(_, row)| row.number(column).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::{STATUS, WAVE_HEIGHT_RATIO};
    use crate::report::tables::Table;

    fn row() -> Row {
        let row = Row::default().with(&STATUS, "ok").with(&WAVE_HEIGHT_RATIO, 0.3);
        row.with(&FIRST_FORCE_MAX, 1.8085).with(&MOMENT_MAX, 2.5)
    }

    #[test]
    fn a_wall_on_a_spring_has_goda_beside_its_force_too() {
        let sprung = row().with(&SPRING_FORCE_MAX, 0.5);
        let failed = row().with(&STATUS, "failed");
        let data = Loaded { rows: vec![sprung, failed], ..Loaded::default() };
        let table: Table = loads(&data).unwrap().whole().unwrap();
        assert_eq!(table.rows.len(), 1);
        let over: f64 = table.rows[0].last().unwrap().parse().unwrap();
        assert!((over - 1.0).abs() < 1e-9, "{over}");
        assert!(overtopping(&data).is_none());
        assert!(loads(&Loaded::default()).is_none());
    }

    /// The story: the page told moments without their bars, which stood in the summary alone.
    #[test]
    fn loads_have_their_bars_on_the_page() {
        let rows = vec![row().with(&MOMENT_MAX_ERROR, 0.02).with(&FORCE_ERROR, 0.005)];
        let data = Loaded { rows, ..Loaded::default() };
        let page = loads(&data).unwrap().whole().unwrap().for_page();
        let cell = |name: &str| {
            let at = page.header.iter().position(|column| column == name).unwrap();
            page.rows[0][at].as_str()
        };
        assert_eq!((cell("moment_max"), cell("first_force_max")), ("2.50 ± 0.02", "1.808 ± 0.005"));
    }

    #[test]
    fn a_crest_has_a_table_of_what_went_over() {
        let rows = vec![row(), row().with(&OVERTOPPING_VOLUME, 0.002)];
        let data = Loaded { rows, ..Loaded::default() };
        let table = overtopping(&data).unwrap().whole().unwrap();
        assert_eq!((table.rows.len(), table.header[4].as_str()), (1, "overtopping_volume_m2"));
        assert_eq!(table.rows[0][4], "0.002");
    }
}
