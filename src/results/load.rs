//! The load of a session's ranks: `load.json` while it runs, afterwards in `manifest.json`. It is
//! provenance: no result depends on it.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::atomic_file;
use super::error::SweepError;

const FILE_NAME: &str = "load.json";

/// The load of a session.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Time since its start, seconds.
    pub elapsed_s: f64,
    /// The load of every rank.
    pub ranks: Vec<RankLoad>,
}

/// The work of a rank.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RankLoad {
    /// Cases that it runs at once.
    pub places: usize,
    /// Seconds of all its places together, trunks included.
    pub busy_s: f64,
    /// Cases that have ended.
    pub cases: u64,
    /// Trunks that have ended.
    pub trunks: u64,
}

impl Load {
    /// The busy share of a rank's places, 0 to 1.
    pub fn share(&self, rank: usize) -> f64 {
        share(&self.ranks[rank..=rank], self.elapsed_s)
    }

    /// The same for all ranks together.
    pub fn whole_share(&self) -> f64 {
        share(&self.ranks, self.elapsed_s)
    }

    /// Seconds of all ranks together.
    pub fn busy_s(&self) -> f64 {
        self.ranks.iter().map(|rank| rank.busy_s).sum()
    }

    /// In words: all ranks, and the least and the most busy if there are several.
    pub fn in_words(&self) -> Option<String> {
        let by = |a: &usize, b: &usize| self.share(*a).total_cmp(&self.share(*b));
        let ranks = || 0..self.ranks.len();
        let (least, most) = (ranks().min_by(by)?, ranks().max_by(by)?);
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        let all = percent(self.whole_share());
        Some(match self.ranks.len() {
            1 => format!("busy {all} of the time"),
            count => format!(
                "{count} ranks busy {all} of the time, from {} (rank {least}) to {} (rank {most})",
                percent(self.share(least)),
                percent(self.share(most))
            ),
        })
    }

    /// The load of the running session of a directory; `None` if there is none.
    pub fn read(directory: &Path) -> Option<Load> {
        serde_json::from_slice(&fs::read(directory.join(FILE_NAME)).ok()?).ok()
    }

    /// Writes the load for readers of the directory while a session runs.
    pub fn write(&self, directory: &Path) -> Result<(), SweepError> {
        let text = serde_json::to_vec(self).expect("a load has a JSON form");
        atomic_file::write_unsynced(&directory.join(FILE_NAME), &text)
    }
}

/// Removes the file of an ended session.
pub fn forget_load(directory: &Path) -> Result<(), SweepError> {
    atomic_file::remove(&directory.join(FILE_NAME))
}

fn share(ranks: &[RankLoad], elapsed_s: f64) -> f64 {
    let places: usize = ranks.iter().map(|rank| rank.places).sum();
    let busy: f64 = ranks.iter().map(|rank| rank.busy_s).sum();
    if elapsed_s > 0.0 { (busy / (elapsed_s * places.max(1) as f64)).min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_and_the_most_busy_are_named() {
        let rank = |busy_s| RankLoad { places: 2, busy_s, ..RankLoad::default() };
        let load = Load { elapsed_s: 10.0, ranks: vec![rank(18.0), rank(9.0), rank(15.0)] };
        let told = "3 ranks busy 70 % of the time, from 45 % (rank 1) to 90 % (rank 0)";
        assert_eq!(load.in_words().as_deref(), Some(told));
        let alone = Load { ranks: vec![rank(10.0)], ..load };
        assert_eq!(alone.in_words().as_deref(), Some("busy 50 % of the time"));
        assert_eq!(Load::default().in_words(), None);
    }

    #[test]
    fn it_is_there_while_the_session_runs() {
        let root = tempfile::tempdir().unwrap();
        assert_eq!(Load::read(root.path()), None);
        let load = Load { elapsed_s: 1.0, ranks: vec![RankLoad::default()] };
        load.write(root.path()).unwrap();
        assert_eq!(Load::read(root.path()), Some(load));
        forget_load(root.path()).unwrap();
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
    }
}
