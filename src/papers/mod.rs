//! The two papers that this program follows: their printed numbers, and how their figures are made.
//!
//! - `data/paper_values.csv` has every printed number, with its figure, its unit and how it was
//!   read.
//! - `data/papers.toml` has the scenes of the numbers, and why some are not met.
//! - `data/paper_figures.toml` has, for every figure and table, its content and the shipped
//!   [`files`] that it needs, or why it cannot be made.
//!
//! The files are inside the program. The report compares them with studies.

pub mod files;
mod printed;
mod recipe;
mod scenes;
mod span;

pub use printed::{PAPER_CLOCK_CENTRE_S, Printed, Read, printed};
pub use recipe::{Draw, Recipe, Run, recipes};
pub use scenes::{Paper, cause, paper, scenes};
pub use span::Span;
