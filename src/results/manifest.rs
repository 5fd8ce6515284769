//! `manifest.json`: the origin of the results. No answer depends on it.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::error::SweepError;
use super::load::Load;
use super::program::Program;
use super::sealed;
use crate::disk::names::MANIFEST;
use crate::math::name::name_of;
use crate::math::simd::SimdPath;
use crate::study::{PHYSICS_VERSION, Study};

/// Provenance of an output directory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the program.
    pub version: String,
    /// Git commit that it was built from, or "unknown".
    pub git_commit: String,
    /// See [`PHYSICS_VERSION`].
    pub physics_version: u32,
    /// Name of the study.
    pub name: String,
    /// Identity of the study.
    pub sweep: String,
    /// The aim of `--max-error`, percent. With it the numerics of the cases can be chosen again.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_error_percent: Option<f64>,
    /// Number of its cases.
    pub cases: usize,
    /// Number of their resolution companions.
    #[serde(default)]
    pub companions: usize,
    /// The swept keys, in the order of the file.
    pub keys: Vec<String>,
    /// The sweep file as written.
    pub sweep_file: String,
    /// Settings of the command line.
    pub overrides: Vec<String>,
    /// The instruction set that all cases were computed with.
    pub simd: String,
    /// Every process that worked here, in order.
    pub sessions: Vec<SessionInfo>,
}

/// One process at work on a directory.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SessionInfo {
    /// The build that worked; absent in files of earlier versions.
    #[serde(default)]
    pub program: Option<Program>,
    /// `threads` or `mpi`.
    pub executor: String,
    /// The ranks.
    pub ranks: Vec<RankInfo>,
    /// Start, UTC.
    pub started: String,
    /// End, UTC; absent while running and after a kill.
    pub ended: Option<String>,
    /// Wall time, seconds.
    pub wall_time_s: Option<f64>,
    /// The work that branching saved.
    pub savings: Option<Savings>,
    /// The load of each rank; absent after an earlier version or a killed process.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
    /// How it ended: `finished`, `interrupted`, or absent.
    pub ending: Option<String>,
}

/// One process of a session.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RankInfo {
    /// The machine.
    pub host: String,
    /// Its threads.
    pub threads: usize,
    /// How many of them share one case.
    #[serde(default = "one")]
    pub threads_per_case: usize,
}

fn one() -> usize {
    1
}

impl RankInfo {
    /// A rank whose threads run one case each.
    pub fn new(host: String, threads: usize) -> RankInfo {
        RankInfo { host, threads, threads_per_case: 1 }
    }

    /// Cases that it runs at once.
    pub fn places(&self) -> usize {
        (self.threads / self.threads_per_case).max(1)
    }
}

/// The work that branching saved in one session, without failed cases.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Savings {
    /// Trunks computed.
    pub trunks: usize,
    /// Cases that started from a trunk's checkpoint.
    pub branches: usize,
    /// Time steps computed, trunks included.
    pub steps_computed: u64,
    /// Time steps, if every case had run from rest.
    pub steps_from_rest: u64,
}

impl Manifest {
    /// The manifest of a directory, with its earlier sessions.
    pub fn new(directory: &Path, study: &Study, overrides: &[String], simd: SimdPath) -> Manifest {
        let sessions = Manifest::read(directory).map_or_else(Vec::new, |earlier| earlier.sessions);
        let program = Program::this();
        Manifest {
            version: program.version,
            git_commit: program.git_commit,
            physics_version: PHYSICS_VERSION,
            name: study.name.clone(),
            sweep: study.identity.clone(),
            max_error_percent: study.max_error_percent,
            cases: study.cases.len(),
            companions: study.companions.len(),
            keys: study.keys.clone(),
            sweep_file: study.file_text.clone(),
            overrides: overrides.to_vec(),
            simd: name_of(simd),
            sessions,
        }
    }

    /// Writes it if no work is left, and only if the request has changed. This program has then
    /// computed nothing, so the earlier one stays in it.
    pub fn asked_again(mut self, directory: &Path) -> Result<(), SweepError> {
        let earlier = Manifest::read(directory);
        if let Some(earlier) = &earlier {
            self.version.clone_from(&earlier.version);
            self.git_commit.clone_from(&earlier.git_commit);
        }
        if earlier.as_ref() == Some(&self) { Ok(()) } else { self.write(directory) }
    }

    /// Another build that worked here before this one.
    pub fn other_program(&self) -> Option<&Program> {
        let this = Program::this();
        self.sessions
            .iter()
            .rev()
            .filter_map(|session| session.program.as_ref())
            .find(|p| **p != this)
    }

    /// The fault of a directory's manifest file, if any.
    pub fn damage(directory: &Path) -> Option<&'static str> {
        let Ok(text) = std::fs::read(directory.join(MANIFEST)) else { return Some("is missing") };
        let whole = Manifest::read(directory).is_some() && sealed::is_whole(&text);
        (!whole).then_some("is damaged")
    }

    /// Reads a directory's manifest; `None` if there is none that can be read.
    pub fn read(directory: &Path) -> Option<Manifest> {
        let text = std::fs::read_to_string(directory.join(MANIFEST)).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// The instruction set, if this program knows it.
    pub fn simd_path(&self) -> Option<SimdPath> {
        serde_json::from_value(self.simd.clone().into()).ok()
    }

    /// Writes it.
    pub fn write(&self, directory: &Path) -> Result<(), SweepError> {
        sealed::write(&directory.join(MANIFEST), self)
    }
}
