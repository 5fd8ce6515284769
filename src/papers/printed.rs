//! The numbers that the papers print, from `data/paper_values.csv`.

use std::sync::LazyLock;

use serde::{Deserialize, Deserializer, Serialize};

use super::span::Span;

/// Time at which the paddle passes the middle of its stroke on the papers' clock, seconds. It is
/// the same for every wave, by their printed times (see `docs/physics.md`). Their time = time -
/// `stroke_centre_s` + this.
pub const PAPER_CLOCK_CENTRE_S: f64 = 1.0;

/// How a number was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Read {
    /// As the text prints it.
    Text,
    /// As the text prints it, with "about", "approximately" or "nearly".
    About,
    /// As the text prints it, as a lower bound.
    AtLeast,
    /// From two printed numbers.
    Derived,
    /// From words that mean no change, such as "flat".
    Words,
}

/// One printed number.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Printed {
    /// `liang2017` or `huang2019`.
    pub paper: String,
    /// Number of the figure that it belongs to.
    pub figure: String,
    /// Its scene, see [`super::scenes`].
    pub scene: String,
    /// H/h; if there is none, any.
    #[serde(deserialize_with = "span")]
    pub wave_height_ratio: Option<Span>,
    /// k, N/m.
    #[serde(deserialize_with = "span")]
    pub spring_stiffness_n_per_m: Option<Span>,
    /// m, kg/m.
    #[serde(deserialize_with = "span")]
    pub seawall_mass_kg_per_m: Option<Span>,
    /// Its place along the stiffness: log₁₀ k*.
    pub log10_k_star: Option<f64>,
    /// Its quantity. This is a column of the summary (`first_force_max`, or
    /// `first_force_max_time_s` on the papers' clock), a column of the history at `time_s`, or one
    /// known to `report::papers`.
    pub quantity: String,
    /// When, on the papers' clock, seconds.
    pub time_s: Option<f64>,
    /// The number.
    pub value: f64,
    /// Its unit; empty for ratios.
    pub unit: String,
    /// How it was read.
    pub read: Read,
    /// Why it may not be met, see [`super::cause`]; may be empty.
    pub cause: String,
    /// A remark; may be empty.
    pub note: String,
}

fn span<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Span>, D::Error> {
    let text = String::deserialize(deserializer)?;
    let span = (!text.is_empty()).then(|| text.parse());
    span.transpose().map_err(serde::de::Error::custom)
}

static ALL: LazyLock<Vec<Printed>> = LazyLock::new(|| {
    let text = include_str!("../../data/paper_values.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.deserialize().collect::<Result<_, _>>().expect("data/paper_values.csv is tested")
});

/// All printed numbers, in the file's order.
pub fn printed() -> &'static [Printed] {
    &ALL
}

impl Printed {
    /// Whether it is printed for a case with this wave, stiffness and mass.
    pub fn holds_at(&self, place: [Option<f64>; 3]) -> bool {
        let spans =
            [self.wave_height_ratio, self.spring_stiffness_n_per_m, self.seawall_mass_kg_per_m];
        spans.iter().zip(place).all(|(span, value)| {
            span.is_none_or(|span| value.is_some_and(|value| span.holds(value)))
        })
    }

    /// Whether it is a size: not a time, a share or a place on an axis.
    pub fn is_size(&self) -> bool {
        matches!(self.unit.as_str(), "h" | "½ρgh²" | "m") && self.read != Read::Words
    }

    /// Of the ratio of a step's time to that with improved Shepard: the interpolator.
    pub fn timed_boundary(&self) -> Option<&str> {
        self.quantity.strip_prefix("step_time_of_")
    }

    /// The difference up to which a computed value counts as the same. It is 0.05 s for times, five
    /// points for percentages, and otherwise 5 %. For forces, runups and displacements it is at
    /// least 0.02.
    pub fn tolerance(&self) -> f64 {
        let share = 0.05 * self.value.abs();
        match self.unit.as_str() {
            "s" => 0.05,
            "%" => 5.0,
            "h" | "½ρgh²" => share.max(0.02),
            _ => share,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::papers::{cause, paper, recipes};

    #[test]
    fn every_number_has_a_paper_a_figure_and_a_known_cause() {
        assert!(printed().len() > 70);
        for value in printed() {
            assert!(paper(&value.paper).is_some(), "{value:?}");
            assert!(value.cause.is_empty() || cause(&value.cause).is_some(), "{value:?}");
            let figure = |r: &&crate::papers::Recipe| r.paper == value.paper;
            let figure = recipes().iter().filter(figure).find(|r| r.number == value.figure);
            assert!(figure.is_some(), "no such figure: {value:?}");
        }
    }

    #[test]
    fn a_number_holds_where_it_is_printed_for() {
        let soft = printed().iter().find(|value| value.note.contains("10 N/m and less")).unwrap();
        assert!(soft.holds_at([Some(0.3), Some(0.01), Some(50.0)]));
        assert!(!soft.holds_at([Some(0.3), Some(50.0), Some(50.0)]));
        assert!(!soft.holds_at([Some(0.3), None, None]), "a fixed wall has no stiffness");
    }

    #[test]
    fn the_numbers_of_the_text_are_there() {
        let at = |figure: &str, quantity: &str, wave: f64| {
            let mut found = printed().iter().filter(|value| {
                value.figure == figure
                    && value.quantity == quantity
                    && value.wave_height_ratio.is_some_and(|span| span.holds(wave))
            });
            found.next().map(|value| value.value)
        };
        assert_eq!(at("12", "first_force_max", 0.6), Some(3.21));
        assert_eq!(at("12", "first_runup_max_time_s", 0.2), Some(2.62));
        assert_eq!(at("15", "runup_rise", 0.6), Some(43.2));
    }
}
