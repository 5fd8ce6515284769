//! The reported quantities, each declared once: name, unit, symbol, meaning, digits, error bar and
//! where its value is read.
//!
//! [`summary`] declares the columns of `summary.csv`, [`history`] those of `histories/*.csv`,
//! [`energy`] those of `energy.csv`, [`envelope`] those of `envelopes/*.csv`, [`wave`] those of
//! `waves/*.csv`, [`accuracy`] those of `accuracy.csv`, [`max_error`] those of `max_error.csv`. The sweep writes its files from the
//! declarations, the terminal and the report take headings and digits from them, and `docs/files.md`
//! holds their tables. To add a quantity, add an entry to one of the lists.
//!
//! The report reads files: it uses what a declaration says, and never a [`Case`] or a reader.

pub mod accuracy;
mod case;
mod column;
#[cfg(test)]
mod docs;
pub mod energy;
pub mod envelope;
pub mod history;
pub mod max_error;
pub mod summary;
mod symbol;
mod unit;
pub mod wave;

pub use case::{Bars, Case, Value, coarse_spacings};
pub use column::{Read, of_a_single_wave};
pub use symbol::{is_meant, meant_by, name_of_symbol};
pub use unit::Unit;

/// A column of `summary.csv`; one that is a maximum has a second column with its time.
pub type Column = Quantity<Read>;

/// How many digits a table for the eye shows of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Digits {
    /// All there are.
    All,
    /// So many decimals.
    Decimals(usize),
    /// So many significant digits.
    Significant(usize),
}

/// One quantity; `R` reads it from what a case has left.
#[derive(Debug)]
pub struct Quantity<R> {
    /// The column.
    pub name: &'static str,
    /// What stands above it in tables, without the unit; empty where the name will do.
    pub symbol: &'static str,
    /// The unit of its numbers.
    pub unit: Unit,
    /// What it is, as the documentation says it.
    pub meaning: &'static str,
    /// Digits in tables for the eye.
    pub digits: Digits,
    /// The column of its error bar.
    pub bar: Option<&'static str>,
    /// The column of the flag which says that the value is a lower bound.
    pub bound: Option<&'static str>,
    /// The column of the whole run that is told in its place where there is no first impact.
    pub whole: Option<&'static str>,
    /// Whether it means something for a single wave alone: what tells of the first impact or of the
    /// first crest means nothing for regular waves.
    pub of_a_single_wave: bool,
    /// How it is read.
    pub read: R,
}

impl<R: Copy> Quantity<R> {
    const fn new(name: &'static str, symbol: &'static str, unit: Unit, read: R) -> Quantity<R> {
        Quantity {
            name,
            symbol,
            unit,
            meaning: "",
            digits: Digits::All,
            bar: None,
            bound: None,
            whole: None,
            of_a_single_wave: false,
            read,
        }
    }

    const fn meaning(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }

    const fn decimals(mut self, decimals: usize) -> Self {
        self.digits = Digits::Decimals(decimals);
        self
    }

    const fn significant(mut self, digits: usize) -> Self {
        self.digits = Digits::Significant(digits);
        self
    }

    const fn bar(mut self, column: &'static str) -> Self {
        self.bar = Some(column);
        self
    }

    const fn bound(mut self, flag: &'static str) -> Self {
        self.bound = Some(flag);
        self
    }

    const fn whole(mut self, column: &'static str) -> Self {
        self.whole = Some(column);
        self
    }

    const fn of_a_single_wave(mut self) -> Self {
        self.of_a_single_wave = true;
        self
    }

    /// It with a value as one writes them: `k = 10 N/m`.
    pub fn with_value(&self, sign: &str, value: &str) -> String {
        let text = format!("{} {sign} {value} {}", self.symbol, self.unit.symbol());
        text.trim_end().to_owned()
    }

    /// Its name in words, without the unit.
    pub fn words(&self) -> String {
        unit::split(self.name).0.replace('_', " ")
    }

    /// What stands above its column: the symbol, or else the name, and the unit.
    pub fn heading(&self) -> String {
        match (self.symbol, self.unit.suffix()) {
            ("", _) => heading(self.name),
            (symbol, "") => symbol.to_owned(),
            (symbol, unit) => format!("{symbol}, {unit}"),
        }
    }

    /// What stands before a value that has its unit behind it.
    pub fn heading_without_unit(&self) -> String {
        let (heading, unit) = (self.heading(), format!(", {}", self.unit.symbol()));
        heading.strip_suffix(&unit).unwrap_or(&heading).to_owned()
    }
}

impl<R> PartialEq for Quantity<R> {
    fn eq(&self, other: &Quantity<R>) -> bool {
        self.name == other.name
    }
}

/// What stands above a column: as its declaration says, or else its name with the unit that the
/// name ends in (`column_height_m` is `column height, m`).
pub fn heading(name: &str) -> String {
    if let Some(column) = named(name).filter(|column| !column.symbol.is_empty()) {
        return column.heading();
    }
    let (stem, unit) = unit::split(name);
    let comma = if unit.is_empty() { "" } else { ", " };
    format!("{}{comma}{unit}", stem.replace('_', " "))
}

/// The column of `summary.csv` with a name.
pub fn named(name: &str) -> Option<&'static Column> {
    summary::ALL.iter().copied().find(|column| column.name == name)
}

impl Column {
    /// The same of the whole run: itself, unless it is of the first impact.
    pub fn of_whole_run(&'static self) -> &'static Column {
        self.whole.and_then(named).unwrap_or(self)
    }

    /// Whether it is the error bar of another one.
    pub fn is_bar(&self) -> bool {
        summary::ALL.iter().any(|other| other.bar == Some(self.name))
    }
}

/// Declares quantities and lists them in their order. The documentation of an entry is its
/// meaning.
macro_rules! quantities {
    ($read:ty; $($(#[doc = $meaning:literal])+ $constant:ident = $declared:expr;)+) => {
        $(
            $(#[doc = $meaning])+
            pub static $constant: $crate::quantities::Quantity<$read> =
                $declared.meaning(concat!($($meaning),+));
        )+

        /// All of them, in the order of the columns.
        pub static ALL: &[&$crate::quantities::Quantity<$read>] = &[$(&$constant),+];
    };
}
use quantities;
