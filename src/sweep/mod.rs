//! The sweep: from a file with a `[grid]` to a directory of results, on threads or under MPI.
//!
//! Reading order:
//! - [`SweepFile`] is the parsed file, [`Study`] its cases in grid order, each a [`Case`] whose id
//!   is a hash of what decides its answer;
//! - [`Plan`] groups the cases into trunks and branches, [`Manager`] decides what runs where and
//!   when: a pure state machine, events in, commands out;
//! - [`executor`] carries commands to workers and their reports back; [`Runner`] does the work;
//! - [`Directory`] guards the output: its [`Journal`] is the truth, all tables are made from it;
//! - [`coordinate`] is the loop that ties these together.

mod atomic_file;
mod axis;
mod case;
mod clock;
mod companions;
mod coordinate;
mod directory;
mod energy;
mod error;
mod error_bars;
pub mod executor;
pub mod fake;
mod file;
mod grid;
mod interrupt;
mod journal;
mod lock;
mod manager;
mod manifest;
pub mod matrix;
mod number;
mod overrides;
mod plan;
mod progress;
mod record;
mod results;
mod runner;
mod schema;
mod study;
mod summary;
pub mod tuning;
mod vtk;

pub use axis::Axis;
pub use case::{Case, CaseId, PHYSICS_VERSION, trunk_key};
pub use clock::timestamp;
pub use coordinate::{Ending, Savings, Session, coordinate};
pub use directory::{Directory, OpenMode, Opened};
pub use error::SweepError;
pub use error_bars::{ErrorBars, richardson};
pub use file::SweepFile;
pub use interrupt::Interrupt;
pub use journal::{Header, Journal, read_journal};
pub use lock::Lock;
pub use manager::{Command, Event, Manager, Source};
pub use manifest::{Manifest, SessionInfo};
pub use number::counted;
pub use overrides::Override;
pub use plan::{Plan, PlannedCase, PlannedTrunk};
pub use progress::{Progress, ProgressStyle, duration};
pub use record::CaseRecord;
pub use runner::{Runner, SphRunner, guarded};
pub use schema::schema;
pub use study::Study;
pub use summary::fixed_columns;
pub use vtk::FilmingRunner;
