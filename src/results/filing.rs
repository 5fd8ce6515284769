//! The runner of a case writes its files, if it can see the output directory, and passes on the
//! rest in a small message.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::checksum::checksum;
use super::files;
use super::seal::Seals;
use crate::disk::names::MANIFEST;
use crate::simulation::{CaseResult, EnergyBudget, NamedReading, Outcome, PhaseShare};
use crate::study::CaseId;

/// The rest of a result after its files are written: all data for its journal line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Filed {
    pub(super) outcome: Outcome,
    pub(super) energy: EnergyBudget,
    pub(super) readings: Vec<NamedReading>,
    pub(super) phases: Vec<PhaseShare>,
    pub(super) seals: Seals,
    /// Whether the files are certainly on the disk.
    pub(super) on_disk: bool,
}

impl Filed {
    /// The part of a result that goes to the journal, without files.
    ///
    /// # Errors
    /// It does not come back from JSON unchanged. NaN and infinity are written there as `null`.
    pub(super) fn of(result: &CaseResult) -> Result<Filed, String> {
        let filed = Filed {
            outcome: result.outcome.clone(),
            energy: result.energy,
            readings: result.readings.clone(),
            phases: result.phases.clone(),
            seals: Seals::new(),
            on_disk: false,
        };
        let text = serde_json::to_vec(&filed).expect("plain data has a JSON form");
        match serde_json::from_slice::<Filed>(&text) {
            Ok(read) if read == filed => Ok(filed),
            _ => Err("not-a-number: a reported quantity is not a finite number".to_owned()),
        }
    }
}

/// A successful case, on its way to the coordinator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Delivery {
    /// All of it: the coordinator writes its files.
    Whole(Box<CaseResult>),
    /// Its files are written.
    Filed(Box<Filed>),
}

impl Delivery {
    /// The scalars.
    pub fn outcome(&self) -> &Outcome {
        match self {
            Delivery::Whole(result) => &result.outcome,
            Delivery::Filed(filed) => &filed.outcome,
        }
    }
}

/// Identifies a directory between ranks, by its manifest: no two sessions write the same one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    directory: PathBuf,
    manifest: String,
    /// The running system. Files written by one of its processes can be put on the disk by another.
    system: String,
}

impl Mark {
    /// The mark of a directory whose manifest has just been written; `None` if there is none.
    pub fn of(directory: &Path) -> Option<Mark> {
        let directory = std::path::absolute(directory).ok()?;
        let manifest = fs::read(directory.join(MANIFEST)).ok()?;
        Some(Mark { directory, manifest: checksum(&manifest), system: running_system() })
    }

    /// The directory.
    pub fn directory(&self) -> &Path {
        &self.directory
    }
}

/// Different for every start of every machine; empty if the system does not provide it.
fn running_system() -> String {
    fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap_or_default().trim().to_owned()
}

/// Writes the files of cases into an output directory that another process has opened.
#[derive(Debug, Clone)]
pub struct Filing {
    directory: PathBuf,
    /// Whether no other process can put the files on the disk.
    syncs: bool,
}

impl Filing {
    /// For the process that has opened the directory.
    pub fn here(directory: &Path) -> Filing {
        Filing { directory: directory.to_owned(), syncs: false }
    }

    /// The same if no other process can put its files on the disk.
    pub fn syncing(self) -> Filing {
        Filing { syncs: true, ..self }
    }

    /// For another process; `None` if it does not see the directory with this mark.
    pub fn elsewhere(mark: &Mark) -> Option<Filing> {
        let here = Mark::of(&mark.directory)?;
        let far = here.system.is_empty() || here.system != mark.system;
        let filing = (here.manifest == mark.manifest).then(|| Filing::here(&here.directory))?;
        Some(if far { filing.syncing() } else { filing })
    }

    /// Writes the files of a case under this name, if it has any. If that fails, the result is
    /// delivered whole; the coordinator tries again and reports the error.
    pub fn deliver(&self, files: Option<CaseId>, result: CaseResult) -> Delivery {
        let filed = Filed::of(&result).ok().and_then(|filed| {
            let write = |id| files::write(&self.directory, id, &result, self.syncs).ok();
            let seals = files.map_or(Some(Seals::new()), write)?;
            Some(Filed { seals, on_disk: self.syncs, ..filed })
        });
        match filed {
            Some(filed) => Delivery::Filed(Box::new(filed)),
            None => Delivery::Whole(Box::new(result)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_up::made_up;
    use super::*;
    use crate::scene::CaseConfig;

    fn result() -> (CaseId, CaseResult) {
        let config = CaseConfig::of("", "");
        (CaseId::of(&config), made_up(&config))
    }

    #[test]
    fn a_filed_case_is_a_small_message() {
        let root = tempfile::tempdir().unwrap();
        let (id, mut result) = result();
        let shares = ["neighbours", "ghosts", "momentum", "continuity", "integration", "readings"];
        let share = |phase: &str| PhaseShare { phase: phase.to_owned(), seconds: 0.1 };
        result.phases = shares.map(share).to_vec();
        let delivery = Filing::here(root.path()).deliver(Some(id), result);
        let Delivery::Filed(filed) = &delivery else { panic!() };
        assert_eq!(filed.seals.len(), 2);
        let bytes = postcard::to_stdvec(&delivery).unwrap();
        assert!(bytes.len() <= 1000, "{} bytes", bytes.len());
        assert_eq!(postcard::from_bytes::<Delivery>(&bytes).unwrap(), delivery);
    }

    #[test]
    fn what_cannot_be_filed_is_delivered_whole() {
        let root = tempfile::tempdir().unwrap();
        let (id, mut result) = result();
        let in_the_way = root.path().join("file");
        fs::write(&in_the_way, "").unwrap();
        let whole = Delivery::Whole(Box::new(result.clone()));
        assert_eq!(Filing::here(&in_the_way).deliver(Some(id), result.clone()), whole);
        result.energy.kinetic = f64::NAN;
        let delivery = Filing::here(root.path()).deliver(Some(id), result);
        assert!(matches!(delivery, Delivery::Whole(_)));
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1, "nothing but the file is there");
    }

    #[test]
    fn only_the_same_directory_is_shared() {
        let root = tempfile::tempdir().unwrap();
        assert_eq!(Mark::of(root.path()), None, "without a manifest");
        let manifest = root.path().join(MANIFEST);
        fs::write(&manifest, "one").unwrap();
        let mark = Mark::of(root.path()).unwrap();
        assert!(Filing::elsewhere(&mark).is_some_and(|filing| !filing.syncs));
        let far = Mark { system: "another machine".to_owned(), ..mark.clone() };
        assert!(Filing::elsewhere(&far).is_some_and(|filing| filing.syncs));
        fs::write(&manifest, "two").unwrap();
        assert!(Filing::elsewhere(&mark).is_none());
        let gone = Mark { directory: root.path().join("gone"), ..mark };
        assert!(Filing::elsewhere(&gone).is_none());
    }
}
