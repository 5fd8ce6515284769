//! Accuracy and robustness of the methods, and how the program uses these data.
//!
//! - [`Matrix`] holds the cases and methods of `seawall accuracy` and `seawall stress`;
//! - [`score`] tells their errors, [`judge`] their verdicts;
//! - [`AccuracyTable`] holds measured errors and chooses numerics by them, as [`MaxError`] asks;
//! - [`Refinement`] adds points to a study where its curves bend.

mod choice;
mod matrix;
mod max_error;
mod quantity;
mod refine;
mod score;
mod stress;
mod table;

pub use matrix::{Matrix, Trial};
pub use max_error::{Choices, MaxError, Missed, Verified};
pub use quantity::{Kind, Quantity};
pub use refine::{Refinement, Round};
pub use score::{MethodScore, Scored, methods, score};
pub use stress::{Judged, Verdict, judge};
pub use table::{AccuracyTable, Choice};
