//! The figures of the papers, drawn from the studies that they need.
//!
//! A [`Recipe`] says which kind of drawing a figure is. Each kind has a file here. What the papers
//! print for the cases stands as markers in the drawing, and in a table beside it.

mod around_runup;
mod front;
mod gauges;
mod histories;
mod laws;
mod response;
mod step_time;
mod surfaces;

use std::path::PathBuf;

use super::config::Config;
use super::doubts;
use super::error::ReportError;
use super::load::Loaded;
use super::papers::{self, Cases, Found, confront};
use super::plots::{self, Chart, Drawing, Figure, Layout};
use super::row::Row;
use super::tables::Table;
use crate::math::lists::different;
use crate::papers::{Draw, Recipe, paper};
use crate::quantities::summary::{DOUBTFUL, STROKE_CENTRE};

/// A figure of a paper, as this program makes it.
#[derive(Debug, Clone)]
pub struct Reproduced {
    /// The drawing.
    pub figure: Figure,
    /// Printed and computed numbers, one line for each.
    pub tidy: Table,
    /// The same for the reader.
    pub beside: Table,
    /// What agrees, what does not, and why; or how the cases were computed if none is printed.
    pub sentences: Vec<String>,
}

/// A drawing and its caption.
struct Drawn {
    drawing: Drawing,
    caption: String,
}

/// Whether one of these cases has a paddle, so that times are told on the papers' clock.
fn is_on_clock(rows: &[&Row]) -> bool {
    rows.iter().any(|row| row.number(&STROKE_CENTRE).is_some())
}

/// The title of the axis of time.
fn clock(on_clock: bool) -> &'static str {
    if on_clock { "t, s, on the papers' clock" } else { "t, s" }
}

/// Panels of this outer size, so many in a row; `None` without panels.
fn drawn(charts: Vec<Chart>, layout: Layout, caption: impl Into<String>) -> Option<Drawn> {
    Some(Drawn { drawing: Drawing::filled(charts, layout)?, caption: caption.into() })
}

/// What drawings are made from.
struct Material<'a> {
    studies: &'a [Cases<'a>],
    found: &'a [Found<'a>],
}

impl<'a> Material<'a> {
    /// All finished cases, each with its study.
    fn cases(&self) -> Vec<(&'a Loaded, &'a Row)> {
        let cases = |study: &'a Cases<'a>| study.data.finished().map(|row| (study.data, row));
        self.studies.iter().flat_map(cases).collect()
    }

    /// Cases of which all values are known.
    fn known(&self) -> Vec<(&'a Loaded, &'a Row, &'a Config)> {
        let cases =
            |study: &'a Cases<'a>| study.finished().map(|(row, config)| (study.data, row, config));
        self.studies.iter().flat_map(cases).collect()
    }

    /// The printed numbers of a case.
    fn of(&self, row: &'a Row) -> impl Iterator<Item = &'a Found<'a>> {
        self.found.iter().filter(move |found| std::ptr::eq(found.row, row))
    }
}

/// Draws a figure from the output directories of its studies, which stand in the recipe's order.
///
/// # Errors
/// Files that cannot be read; cases that do not fill the figure, for example if all failed.
pub fn reproduce(recipe: &Recipe, directories: &[PathBuf]) -> Result<Reproduced, ReportError> {
    let studies: Vec<_> =
        directories.iter().map(|path| Loaded::read(path)).collect::<Result<_, _>>()?;
    let cases: Vec<_> = studies.iter().map(Cases::of).collect();
    let mut found = Vec::new();
    for cases in &cases {
        found.extend(confront(cases)?);
    }
    let draw = recipe.draw.as_ref();
    found.retain(|one| draw.is_some_and(|draw| belongs(recipe, draw, one)));
    let material = Material { studies: &cases, found: &found };
    let nothing = || ReportError::Draw {
        figure: recipe.title(),
        reason: "no finished case fills it".to_owned(),
    };
    let drawing = match draw.ok_or_else(nothing)? {
        Draw::Response { column } => response::drawing(&material, column)?,
        Draw::Histories { columns, line } => histories::drawing(&material, columns, *line)?,
        Draw::Walls => walls(&material),
        Draw::AroundRunup { panels } => around_runup::drawing(&material, panels)?,
        Draw::Surfaces { times_s, first_order } => {
            surfaces::drawing(&material, times_s, *first_order)?
        }
        Draw::Gauges { names, column, measured } => {
            gauges::drawing(&material, names, *column, *measured)?
        }
        Draw::Front => front::drawing(&material)?,
        Draw::StepTime => step_time::drawing(&material)?,
    };
    let drawing = drawing.ok_or_else(nothing)?;
    let words = paper(&recipe.paper).map_or(recipe.paper.as_str(), |paper| &paper.words);
    let here = if recipe.here.is_empty() { String::new() } else { format!(" ({})", recipe.here) };
    let starred = drawing.drawing.svg(1).contains(plots::PRINTED);
    let marks = if starred { " Stars: numbers that the papers print." } else { "" };
    let caption = format!(
        "{} of {words}: {}{here}. {}{marks}",
        recipe.title(),
        recipe.shows,
        drawing.caption
    );
    let mut sentences = if found.is_empty() {
        let method = papers::method(material.cases().into_iter().map(|(_, row)| row));
        vec![format!("No number of it is printed for these cases. Computed by {method}.")]
    } else {
        papers::sentences(&found)
    };
    sentences.extend(different(cases.iter().filter_map(papers::times_left_out)));
    sentences.extend(cases.iter().filter_map(|study| doubted(study.data, cases.len() > 1)));
    Ok(Reproduced {
        figure: Figure {
            name: recipe.stem(),
            title: format!("{words}, {}", recipe.title()),
            caption,
            drawing: drawing.drawing,
        },
        tidy: papers::tidy(&found),
        beside: papers::beside(&found),
        sentences,
    })
}

/// Which results of a study are doubtful; `None` if none is. `named`: with the study's name.
fn doubted(data: &Loaded, named: bool) -> Option<String> {
    data.finished().find(|row| row.is(&DOUBTFUL))?;
    let told = doubts::doubtful(data)?;
    let name = data.name().filter(|_| named);
    Some(name.map_or_else(|| told.clone(), |name| format!("Study {name}: {told}")))
}

/// Fig. 3 of Liang et al. 2017: the report's own figure of fixed walls.
fn walls(material: &Material) -> Option<Drawn> {
    let figure = |study: &Cases| plots::at_fixed_walls(study.data).into_iter().next();
    let Figure { drawing, caption, .. } = material.studies.iter().find_map(figure)?;
    Some(Drawn { drawing, caption })
}

/// Whether a printed number belongs beside a figure: its own, or one of the cases drawn.
fn belongs(recipe: &Recipe, draw: &Draw, found: &Found) -> bool {
    let (printed, name) = (found.printed, found.printed.quantity.as_str());
    let own = printed.paper == recipe.paper && printed.figure == recipe.number;
    let drawn = match draw {
        Draw::Response { column } => name == column,
        Draw::Histories { .. } => {
            let timed = printed.timed_boundary().is_some();
            !timed && printed.log10_k_star.is_none() && printed.unit != "%"
        }
        Draw::Walls => printed.scene == "fixed" && printed.is_size(),
        _ => false,
    };
    own || drawn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantities::summary::DOUBTFUL_REASON;
    use crate::report::fixture;

    /// The story: four of five dam breaks behind a figure were doubtful, and nothing beside the figure said so.
    #[test]
    fn doubtful_results_behind_a_figure_are_told() {
        let (_directory, mut data) = fixture::read(fixture::dam_breaks(3));
        data.set_all(&DOUBTFUL, false);
        assert_eq!(doubted(&data, false), None);
        let reason = "force gap: the two differ by 3.3 %";
        data.rows[1].set(&DOUBTFUL, true).set(&DOUBTFUL_REASON, reason);
        let told = doubted(&data, false).unwrap();
        assert!(told.starts_with("1 of 3 results is doubtful: force gap (1)."), "{told}");
        assert!(doubted(&data, true).unwrap().contains("1 of 3 results is doubtful"));
    }
}
