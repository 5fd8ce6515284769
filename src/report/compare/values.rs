//! What cases have under each key, each value once: full tables would take gigabytes.

use std::collections::HashMap;

use toml::{Table, Value};

use crate::keys::{alike, number};
use crate::report::config::Config;

/// The values of some cases, by section.
#[derive(Debug, Default)]
pub struct Values {
    /// `[scene]` and `[numerics]`.
    sections: [Columns; 2],
    cases: usize,
}

/// The values of a section, by key.
type Columns = Vec<(String, Column)>;

/// A value for the reader, and as text that is equal for equal numbers; `None` if a case has none.
#[derive(Debug)]
struct Told {
    value: Option<Value>,
    shown: String,
    text: String,
}

/// The values of one key.
#[derive(Debug, Default)]
pub struct Column {
    different: Vec<Told>,
    places: HashMap<String, u32>,
    /// The place of each case's value in `different`; empty where all cases have the first.
    at: Vec<u32>,
    cases: usize,
}

impl Values {
    /// Adds a case, and returns its place among all cases.
    pub fn push(&mut self, config: &Config) -> usize {
        for (columns, table) in self.sections.iter_mut().zip([&config.scene, &config.numerics]) {
            push(columns, table, self.cases);
        }
        self.cases += 1;
        self.cases - 1
    }

    /// The keys of a section, which is given by its place.
    pub fn keys(&self, section: usize) -> impl Iterator<Item = &str> {
        self.sections[section].iter().map(|(key, _)| key.as_str())
    }

    /// The values of a key in the section at a place; `None` where no case has the key.
    pub fn column(&self, section: usize, key: &str) -> Option<&Column> {
        let mut columns = self.sections[section].iter();
        columns.find(|(name, _)| name == key).map(|(_, column)| column)
    }
}

/// The value of a case for the reader, if it has one.
pub fn shown(column: Option<&Column>, case: usize) -> Option<&str> {
    let told = column?.of_case(case).filter(|told| told.value.is_some());
    told.map(|told| told.shown.as_str())
}

/// The value of a case as text that is equal for equal numbers.
pub fn text(column: Option<&Column>, case: usize) -> &str {
    let told = column.and_then(|column| column.of_case(case));
    told.filter(|told| told.value.is_some()).map_or("-", |told| &told.text)
}

/// Nine digits: equal numbers give equal text, however a file writes them.
pub fn number_text(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.8e}"))
}

/// Adds the table of the next case.
fn push(columns: &mut Columns, table: &Table, cases: usize) {
    for (place, (key, value)) in table.iter().enumerate() {
        // The keys are nearly always those of the case before.
        let there = columns.get(place).is_some_and(|(name, _)| name == key);
        let place =
            if there { Some(place) } else { columns.iter().position(|(name, _)| name == key) };
        let place = place.unwrap_or_else(|| {
            columns.push((key.clone(), Column::default()));
            columns.len() - 1
        });
        let column = &mut columns[place].1;
        column.fill(cases);
        column.push(Some(value));
    }
    columns.iter_mut().for_each(|(_, column)| column.fill(cases + 1));
}

impl Column {
    /// Records that the cases before this one have no value, where none was given.
    fn fill(&mut self, cases: usize) {
        while self.cases < cases {
            self.push(None);
        }
    }

    fn push(&mut self, value: Option<&Value>) {
        let last = self.at.last().map_or(0, |&place| place as usize);
        let is_last = self.different.get(last).is_some_and(|told| match (&told.value, value) {
            (Some(one), Some(other)) => alike(one, other),
            (one, other) => one.is_none() && other.is_none(),
        });
        let place = if is_last { last as u32 } else { self.place(value) };
        if place > 0 && self.at.is_empty() {
            self.at.resize(self.cases, 0);
        }
        if place > 0 || !self.at.is_empty() {
            self.at.push(place);
        }
        self.cases += 1;
    }

    /// The place of a value among the different ones.
    fn place(&mut self, value: Option<&Value>) -> u32 {
        let name = value.map_or_else(String::new, Value::to_string);
        let next = u32::try_from(self.different.len()).expect("cases are far fewer");
        *self.places.entry(name).or_insert_with_key(|name| {
            let shown = value.and_then(Value::as_str).map_or_else(|| name.clone(), str::to_owned);
            let text =
                value.and_then(number).map_or_else(|| name.clone(), |v| number_text(Some(v)));
            self.different.push(Told { value: value.cloned(), shown, text });
            next
        })
    }

    fn of_case(&self, case: usize) -> Option<&Told> {
        self.different.get(self.at.get(case).map_or(0, |&place| place as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_has_its_own_values_and_no_others() {
        let tables =
            ["a = 1\nb = 0.1", "a = 1.0", "b = \"x\"\nc = [[0, -0.0]]", "c = [[0, 0.0]]\na = 1"];
        let mut values = Values::default();
        for (case, text) in tables.into_iter().enumerate() {
            let scene: Table = text.parse().unwrap();
            assert_eq!(values.push(&Config { scene, numerics: Table::new() }), case);
        }
        assert_eq!(values.keys(0).collect::<Vec<_>>(), ["a", "b", "c"]);
        assert!(values.column(1, "a").is_none() && values.column(0, "d").is_none());
        let of = |key: &str| {
            let column = values.column(0, key);
            (0..tables.len())
                .map(|case| (shown(column, case), text(column, case)))
                .collect::<Vec<_>>()
        };
        let nothing = (None, "-");
        let one = "1.00000000e0";
        assert_eq!(of("a"), [(Some("1"), one), (Some("1.0"), one), nothing, (Some("1"), one)]);
        assert_eq!(of("b")[..2], [(Some("0.1"), "1.00000000e-1"), nothing]);
        assert_eq!(of("b")[2..], [(Some("x"), "\"x\""), nothing]);
        let bed = |text| (Some(text), text);
        assert_eq!(of("c"), [nothing, nothing, bed("[[0, -0.0]]"), bed("[[0, 0.0]]")]);
        assert_eq!(of("d"), [nothing; 4]);
    }
}
