//! The two papers that this program follows: their printed numbers, and how their figures are made.
//!
//! All of it is data. `data/paper_values.csv` holds every printed number, each with its figure, unit and how
//! it was read. `data/papers.toml` holds the scenes that the numbers belong to, and why some are not met.
//! `data/paper_figures.toml` says for every figure and table what it shows and which of the shipped
//! [`files`] it takes, or why it cannot be made.
//!
//! The files are inside the program. What a study has to say of them is the report's business.

pub mod files;
mod printed;
mod recipe;
mod scenes;
mod span;

pub use printed::{PAPER_CLOCK_CENTRE_S, Printed, Read, printed};
pub use recipe::{Draw, Recipe, Run, recipes};
pub use scenes::{Paper, cause, paper, scenes};
pub use span::Span;
