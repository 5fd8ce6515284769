//! The files of a study: a directory with a journal, which is the truth, and tables that are made
//! from it.
//!
//! - [`Directory`] is an output directory, locked; [`Journal`] has a [`CaseRecord`] per finished case;
//! - the summary, `energy.csv`, and the files of every case are written from records and results;
//! - [`write_all_histories`] joins the histories of all cases in one table;
//! - [`Manifest`] has the origin of the results; [`Derived`] has checksums of the files that are
//!   made last.

mod again;
mod all_histories;
mod atomic_file;
mod attempts;
mod case_tables;
mod checkpoint;
mod checkpoints;
mod checksum;
mod clock;
mod closing;
mod derived;
mod directory;
mod earlier;
mod ended;
mod energy;
mod entries;
mod error;
mod error_bars;
#[cfg(test)]
mod failing;
mod files;
mod filing;
mod filling;
mod journal;
mod left;
mod load;
mod lock;
mod looked;
mod made_up;
mod making;
mod manifest;
mod number;
mod opening;
mod other_sweep;
mod probe_columns;
mod program;
mod record;
mod rows;
mod seal;
mod sealed;
mod stamp;
mod summary;
mod tables;
#[cfg(test)]
mod trial;
mod unsynced;
mod verify;
mod waiting;
mod wanted;

pub use again::{damaged_files, finished, finished_whole, first_difference};
pub use all_histories::{write_all_histories, write_sound_histories};
pub use attempts::Attempts;
pub use checkpoint::Checkpoint;
pub use checkpoints::has_checkpoints;
pub(crate) use checksum::checksum_of;
pub use clock::timestamp;
pub use closing::Closing;
pub use derived::{Derived, MADE_BY_SWEEPS};
pub use directory::Directory;
pub use ended::Ended;
pub use entries::{Content, Header};
pub use error::SweepError;
pub use error_bars::{ErrorBars, narrowest_bar_percent};
pub use filing::{Delivery, Filed, Filing, Mark};
pub use journal::{Journal, header_of, read_in_blocks as read_journal_in_blocks, read_journal};
pub use left::Left;
pub use load::{Load, RankLoad, forget_load};
pub use lock::Lock;
pub use made_up::made_up;
pub use making::Making;
pub use manifest::{Manifest, RankInfo, Savings, SessionInfo};
pub use opening::{OpenMode, Opened};
pub use program::Program;
pub use record::{CaseRecord, Fared};
pub use seal::Seal;
pub use tables::renew_tables;
pub use verify::{Verified, verify};
pub use wanted::Wanted;
