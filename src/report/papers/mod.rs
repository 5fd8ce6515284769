//! A study beside the papers: every printed number for which the study has a case.
//!
//! [`confront`] finds them. They make the table `papers`, the sentences and the figure of the
//! page's section "The papers", and markers in other figures. The numbers are in [`crate::papers`].

mod agreement;
mod cases;
mod collective;
mod computed;
mod nearest;
mod sentences;
mod table;
mod timed;

use super::config::Config;
use super::error::ReportError;
use super::grid::grid;
use super::load::Loaded;
use super::markup::escape;
use super::plots::{Figure, Place};
use super::row::Row;
use super::tables::Table;
use crate::papers::{Printed, Read, printed};
use crate::quantities::summary::FORCE_COUPLING;

pub use cases::Cases;
use cases::{of_scene, printed_for};
pub(super) use computed::{REFERENCE, column, on_their_clock, step_time};
pub use sentences::{answer, method, sentences};
pub use table::{beside, others, tidy};
pub use timed::times_left_out;

/// A printed number and the value of a case that is compared with it.
#[derive(Debug, Clone)]
pub struct Found<'a> {
    /// The printed number.
    pub printed: &'static Printed,
    /// The case.
    pub row: &'a Row,
    /// All values of the case.
    pub config: &'a Config,
    /// The value of the case.
    pub computed: f64,
    /// The error bar of the computed value.
    pub error: Option<f64>,
    /// Whether the computed value is only a lower bound.
    pub bound: bool,
}

impl Found<'_> {
    /// Computed less printed, in the printed unit.
    pub fn difference(&self) -> f64 {
        self.computed - self.printed.value
    }

    /// The difference over the printed number, percent; `None` if zero is printed.
    pub fn percent(&self) -> Option<f64> {
        let printed = self.printed.value;
        (printed != 0.0).then(|| 100.0 * self.difference() / printed.abs())
    }

    /// Whether the difference is within the number's tolerance or the error bar.
    pub fn is_met(&self) -> bool {
        let allowed = self.printed.tolerance().max(self.error.unwrap_or(0.0));
        let enough = self.printed.read == Read::AtLeast && self.difference() > 0.0;
        enough || self.difference().abs() <= allowed
    }

    /// The factor s, where the wall moves.
    pub fn coupling(&self) -> Option<f64> {
        self.config.number(&FORCE_COUPLING).filter(|_| self.printed.scene == "movable")
    }
}

/// Every printed number that the study has a case for, in the papers' order. Times per step are
/// among them only where cases ran alone and from rest.
pub fn confront<'a>(cases: &'a Cases<'a>) -> Result<Vec<Found<'a>>, ReportError> {
    let (all, times) = (of_scene(cases), timed::tells_times(cases.data));
    let mut found = Vec::new();
    for number in printed().iter().filter(|one| times || one.timed_boundary().is_none()) {
        let own = printed_for(number, &all);
        if let Some(kind) = collective::Kind::of(&number.quantity) {
            found.extend(kind.found(number, &own));
            continue;
        }
        for &(row, config) in &own {
            let Some(computed) = computed::of(cases.data, number, row, &own)? else { continue };
            let column = computed::column(number);
            let error = column.and_then(|column| row.error(column));
            let bound = column.is_some_and(|column| row.is_bound(column));
            found.push(Found { printed: number, row, config, computed, error, bound });
        }
    }
    Ok(found)
}

/// What a study says about the papers. Without one of their cases there is at most an answer.
#[derive(Debug, Clone, Default)]
pub struct Papers {
    /// One line per number and case.
    pub tidy: Option<Table>,
    /// The same for the page, with the factors s side by side.
    pub beside: Option<Table>,
    /// How far off the numbers are, or where the nearest are, for the top of the page.
    pub answer: Option<String>,
    /// What agrees, what does not, and why.
    pub sentences: Vec<String>,
    /// Printed against computed.
    pub figures: Vec<Figure>,
}

/// Compares the study with the papers.
///
/// # Errors
/// A file that cannot be read; a figure that cannot be drawn.
pub fn papers(data: &Loaded) -> Result<Papers, ReportError> {
    let cases = Cases::of(data);
    let found = confront(&cases)?;
    let left_out = times_left_out(&cases);
    if found.is_empty() {
        let (answer, sentences) = (nearest::nearest(data), left_out.into_iter().collect());
        return Ok(Papers { answer, sentences, ..Papers::default() });
    }
    Ok(Papers {
        tidy: Some(tidy(&found)),
        beside: Some(beside(&found)),
        answer: Some(answer(&found)),
        sentences: sentences(&found).into_iter().chain(left_out).collect(),
        figures: agreement::figure(&found).into_iter().collect(),
    })
}

impl Papers {
    /// The section of the page; empty where no case is one of the papers'.
    pub fn section(&self) -> String {
        let mut text: String =
            self.sentences.iter().map(|said| format!("<p>{}</p>\n", escape(said))).collect();
        for figure in &self.figures {
            let place = if figure.is_single() { Place::Alone } else { Place::Usual };
            text.push_str(&figure.inline(place));
        }
        text + &self.beside.as_ref().map(grid).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::STROKE_CENTRE;
    use crate::report::fixture;

    /// Two made-up cases. A tank of 2.5 m and a wall of 50 kg/m are those of Liang's Fig. 10.
    pub(super) fn study(length: f64, mass: f64, s: f64) -> tempfile::TempDir {
        let directory = fixture::movable(&[0.3], &[100.0, 1000.0], &[mass]);
        let file = format!(
            "name = \"a\"\n[scene]\nwall = \"movable\"\ntank_length_m = {length:?}\n\
             wave_height_ratio = 0.3\nseawall_mass_kg_per_m = {mass:?}\nforce_coupling = {s:?}\n\
             [grid]\nspring_stiffness_n_per_m = [100, 1000]\n"
        );
        let manifest = serde_json::json!({
            "name": "a", "keys": ["spring_stiffness_n_per_m"], "sweep_file": file, "overrides": [],
        });
        std::fs::write(directory.path().join("manifest.json"), manifest.to_string()).unwrap();
        directory
    }

    #[test]
    fn a_study_in_the_papers_tank_meets_their_numbers() {
        let directory = study(2.5, 50.0, 1.0);
        let mut data = Loaded::read(directory.path()).unwrap();
        data.set_all(&STROKE_CENTRE, 1.0);
        let cases = Cases::of(&data);
        let found = confront(&cases).unwrap();
        let max = |found: &&Found| found.printed.quantity == "displacement_max";
        let values: Vec<_> = found.iter().filter(max).map(|one| one.printed.value).collect();
        assert_eq!(values, [1.64, 0.55]);
        let at_4_s = found.iter().find(|one| one.printed.quantity == "displacement").unwrap();
        assert_eq!((at_4_s.printed.value, at_4_s.coupling()), (1.36, Some(1.0)));
        assert!(!at_4_s.is_met(), "the made-up wall comes out elsewhere: {}", at_4_s.computed);
    }

    #[test]
    fn another_tank_is_none_of_theirs() {
        let papers = |length: f64| {
            let directory = study(length, 50.0, 1.0);
            papers(&Loaded::read(directory.path()).unwrap()).unwrap()
        };
        assert!(papers(2.5).tidy.is_some() && papers(3.0).tidy.is_none());
    }

    #[test]
    fn the_page_has_a_section_and_the_folder_its_files() {
        let directory = study(2.5, 50.0, 0.4);
        let page =
            std::fs::read_to_string(crate::report::write(directory.path()).unwrap().page).unwrap();
        assert!(
            page.contains("<h2>The papers</h2>") && page.contains("Movable walls with s = 0.4")
        );
        assert!(page.contains("printed in the papers"), "markers in the response curves");
        let table = std::fs::read_to_string(directory.path().join("tables/papers.csv")).unwrap();
        assert!(
            table.starts_with("paper,figure,quantity,") && table.contains(",displacement_max,")
        );
        assert!(directory.path().join("figures/papers_agreement.svg").exists());
    }

    #[test]
    fn a_number_is_met_within_its_tolerance_or_the_bar() {
        let directory = study(2.5, 50.0, 1.0);
        let data = Loaded::read(directory.path()).unwrap();
        let cases = Cases::of(&data);
        let mut one = confront(&cases).unwrap().remove(0);
        for (off, error, met) in [(0.04, None, true), (0.06, None, false), (0.06, Some(0.1), true)]
        {
            one.computed = one.printed.value * (1.0 + off);
            one.error = error.map(|share: f64| share * one.printed.value);
            assert_eq!(one.is_met(), met, "{off} {error:?}");
        }
        assert!(answer(&[one]).starts_with("1 of 1 comparison with printed numbers is met, "));
    }
}
