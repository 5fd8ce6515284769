//! The answer of `seawall find`, for people and for programs.

mod json;

use super::output::{first, short, with_marks};
use super::overview;
use super::table::Table;
use crate::math::lists::{different, ends};
use crate::math::words::counted;
use crate::quantities::summary::{CASE_ID, DOUBTFUL};
use crate::quantities::{heading, named};
use crate::report::find::{Basis, Boundary, Found, Number, Verdict};
use crate::report::load::Loaded;
use crate::report::newtons::rescales;
use crate::report::study::Key;
use crate::report::{as_typed_to, digits_apart};

/// How many rows of a table are shown without `-v`.
const ROWS: usize = 30;

/// The text below the boundaries.
const LEGEND: &str = "met: on which side of it; not before, not after: how far off it may be\n";
/// The same where no error bar went into their ranges.
const LEGEND_WITHOUT_BARS: &str = "\
met: on which side of it; not before, not after: the range of the interpolation
alone, as the cases have no error bars of these numbers
";

/// Below boundaries between cases whose numbers are over different units.
const RESCALED: &str = "\
numbers with a star are over each case's own depth: between two depths such a
number may grow while the load in newtons falls
";

/// What was found in a study.
pub(super) struct Answer<'a> {
    pub(super) data: &'a Loaded,
    pub(super) found: &'a Found,
    /// Digits that tell the values of each swept key apart.
    digits: Vec<usize>,
}

impl<'a> Answer<'a> {
    pub(super) fn new(data: &'a Loaded, found: &'a Found) -> Answer<'a> {
        let values = |key: &'a Key| key.cells.iter().filter_map(|cell| cell.parse().ok());
        let digits = data.keys.iter().map(|key| digits_apart(values(key))).collect();
        Answer { data, found, digits }
    }

    /// The answer for people.
    pub(super) fn text(&self, all: bool) -> String {
        let met: Vec<_> = self.found.rows(Verdict::Met).collect();
        let cases = counted(self.data.rows.len(), "case");
        let meet = if met.len() == 1 { "meets" } else { "meet" };
        let mut text = format!("{} of {cases} {meet} {}", met.len(), self.found.condition);
        text.push_str(&self.marks(&met));
        if !met.is_empty() {
            text.push_str(&format!("\n{}", self.cases(&met, all)));
        }
        text.push_str(&self.unknown(all));
        let boundaries: Vec<_> =
            self.found.boundaries.iter().filter(|one| one.basis != Basis::Exact).collect();
        if !boundaries.is_empty() {
            text.push_str("\nwhere it begins and ends\n");
            text.push_str(&self.boundaries(&boundaries, all));
        }
        if self.found.condition.picks_points(self.data) {
            text.push_str("= holds to four digits; < and > tell where a value is crossed\n");
        }
        text
    }

    /// How many of the cases that meet the condition are doubtful, or near the limit.
    fn marks(&self, met: &[usize]) -> String {
        let near = met.iter().filter(|row| self.found.condition.is_near(**row)).count();
        let doubtful = met.iter().filter(|row| self.is_doubtful(**row)).count();
        let stopped = met.iter().filter(|row| self.stops(**row)).count();
        let mut text = String::from("\n");
        if near > 0 {
            text.push_str(&format!("~ {near} of them by less than the error bar\n"));
        }
        if doubtful > 0 {
            text.push_str(&format!("! {doubtful} of them doubtful: look at the history first\n"));
        }
        if stopped > 0 {
            text.push_str(&format!("{}\n", overview::STOPPED));
        }
        text
    }

    fn is_doubtful(&self, row: usize) -> bool {
        self.data.rows[row].is(&DOUBTFUL)
    }

    fn stops(&self, row: usize) -> bool {
        self.data.rows[row].hits_stop()
    }

    fn cases(&self, rows: &[usize], all: bool) -> String {
        let subjects = self.found.condition.0.iter().map(|comparison| &comparison.subject);
        let is_key = |name: &str| self.data.keys.iter().any(|key| key.name == name);
        let subjects = different(subjects.filter(|subject| !is_key(&subject.name)));
        let heads = self.data.keys.iter().map(|key| heading(&key.name));
        let heads = heads.chain(subjects.iter().map(|subject| heading(&subject.name)));
        let mut table = Table::new(heads.chain([CASE_ID.heading(), String::new()]));
        let (shown, more) = first(rows, ROWS, all);
        for &row in shown {
            let mut cells: Vec<_> =
                (0..self.data.keys.len()).map(|key| self.cell(key, row)).collect();
            cells.extend(subjects.iter().map(|subject| reading(subject.readings[row])));
            cells.push(self.data.rows[row].id().to_owned());
            let near = if self.found.condition.is_near(row) { "~" } else { "" };
            let doubtful = if self.is_doubtful(row) { "!" } else { "" };
            let stopped = if self.stops(row) { "*" } else { "" };
            cells.push(format!("{near}{doubtful}{stopped}"));
            table.row(cells);
        }
        table.render() + &more
    }

    fn cell(&self, key: usize, row: usize) -> String {
        match &self.data.keys[key].cells[row] {
            "" => "-".to_owned(),
            cell => cell
                .parse()
                .map_or_else(|_| cell.to_owned(), |value| as_typed_to(value, self.digits[key])),
        }
    }

    /// The cases whose verdict is unknown.
    fn unknown(&self, all: bool) -> String {
        let rows: Vec<_> = self.found.rows(Verdict::Unknown).collect();
        if rows.is_empty() {
            return String::new();
        }
        let mut text = format!("\n{} cannot be told\n", counted(rows.len(), "case"));
        let (shown, more) = first(&rows, ROWS, all);
        for &row in shown {
            let (id, why) = (self.data.rows[row].id(), self.found.why(row));
            text.push_str(&format!("  {id} ({}): {why}\n", self.place(row, None)));
        }
        text + &more
    }

    /// The values of the swept keys, except for one.
    fn place(&self, row: usize, but: Option<usize>) -> String {
        let keys = self.data.keys.iter().enumerate().filter(|(key, _)| Some(*key) != but);
        let keys = keys.filter(|(_, key)| !key.cells[row].is_empty());
        let part = |(key, one): (usize, &Key)| {
            let symbol = heading(&one.name);
            let (name, unit) = symbol.split_once(", ").unwrap_or((&symbol, ""));
            format!("{name} = {} {unit}", self.cell(key, row)).trim_end().to_owned()
        };
        keys.map(part).collect::<Vec<_>>().join(", ")
    }

    /// The boundaries that the condition does not state itself.
    fn boundaries(&self, found: &[&Boundary], all: bool) -> String {
        let mut table = Table::new(["along", "met", "not before", "not after", ""]);
        let (shown, more) = first(found, ROWS, all);
        for one in shown {
            let side = if one.met_above { "above" } else { "below" };
            let at = one.at.map_or_else(|| "-".to_owned(), short);
            let [from, to] = one.between.map(|end| self.end_in_words(one.key, end));
            let axis = heading(&self.data.keys[one.key].name);
            let place = self.place(one.row, Some(one.key));
            let mark = if one.doubtful { "!" } else { "" };
            let note = [place.as_str(), mark, basis(one.basis)];
            let note: Vec<_> = note.into_iter().filter(|word| !word.is_empty()).collect();
            table.row([axis, format!("{side} {at}"), from, to, note.join("  ")]);
        }
        let is_bare = |one: &&Boundary| matches!(one.basis, Basis::Bend | Basis::TwoCases);
        let bare = found.iter().any(is_bare) && !self.has_bars();
        let rescaled = found.iter().any(|one| rescales(&self.data.keys[one.key].name));
        let legend = if bare { LEGEND_WITHOUT_BARS } else { LEGEND };
        let note = if rescaled && self.asks_for_ratios() { RESCALED } else { "" };
        table.render() + &more + legend + note
    }

    /// Whether the condition asks for numbers over the water's depth or weight.
    fn asks_for_ratios(&self) -> bool {
        let mut subjects = self.found.condition.0.iter().map(|comparison| &comparison.subject.name);
        subjects.any(|name| named(name).is_some_and(|column| column.unit.is_ratio()))
    }

    /// Whether a number that the condition asks for has an error bar in any case.
    fn has_bars(&self) -> bool {
        let mut subjects = self.found.condition.0.iter().map(|comparison| &comparison.subject);
        subjects.any(|one| (0..self.data.rows.len()).any(|row| one.bar(row).is_some()))
    }

    /// An end of a boundary's range. Beyond the study's own values it would be a guess.
    fn end_in_words(&self, key: usize, end: f64) -> String {
        let values = self.data.keys[key].cells.iter().filter_map(|cell| cell.parse::<f64>().ok());
        let (least, most) = ends(values).unwrap_or_default();
        let slack = 1e-9 * most.abs().max(least.abs());
        let is_within = (least - slack..=most + slack).contains(&end);
        if is_within { short(end) } else { "off the grid".to_owned() }
    }
}

/// A case's number for people.
fn reading(reading: Number) -> String {
    match reading {
        // Counts, such as steps and particles.
        Number::Value { value, bar: None, bound: false } if value.fract() == 0.0 => {
            value.to_string()
        }
        Number::Value { value, bar, bound } => with_marks(value, bar, bound),
        Number::Missing | Number::Failed => "-".to_owned(),
    }
}

/// The words for a range that is not a usual estimate.
fn basis(basis: Basis) -> &'static str {
    match basis {
        Basis::Bend | Basis::Exact => "",
        Basis::TwoCases => "(two cases)",
        Basis::LowerBound => "(≥ beyond)",
        Basis::Start => "(from 0)",
        Basis::Gap => "(gap)",
    }
}
