//! What a study leaves behind: a directory whose journal is the truth and whose tables are made from
//! it.
//!
//! - [`Directory`] is an output directory, locked; [`Journal`] has a [`CaseRecord`] per finished case;
//! - the summary, `energy.csv`, and the files of every case are written from records and results;
//! - [`Manifest`] says where the results come from.

mod again;
mod atomic_file;
mod clock;
mod directory;
mod energy;
mod error;
mod error_bars;
mod files;
mod journal;
mod lock;
mod made_up;
mod manifest;
mod number;
mod record;
mod summary;

pub use again::{finished, first_difference};
pub use clock::timestamp;
pub use directory::{Directory, OpenMode, Opened};
pub use error::{SweepError, in_words};
pub use error_bars::{ErrorBars, narrowest_bar_percent, richardson};
pub use journal::{Header, Journal, read_journal};
pub use lock::Lock;
pub use made_up::made_up;
pub use manifest::{Manifest, RankInfo, Savings, SessionInfo};
pub use number::counted;
pub use record::CaseRecord;
