//! Messages between coordinator and workers.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::results::Delivery;
use crate::scene::CaseConfig;
use crate::schedule::{Held, Work};
use crate::simulation::{Limits, Stopped};
use crate::study::CaseId;

/// From the coordinator to a worker.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Order {
    /// Do a piece of work, from a checkpoint if there is one. `apart`: in a process of its own,
    /// because an earlier one may have died of it. `files`: the name of the files that it leaves; a
    /// companion leaves none.
    Run {
        work: Work,
        config: Posted,
        from: Option<Held>,
        apart: bool,
        limits: Limits,
        files: Option<CaseId>,
    },
    /// Forget a checkpoint.
    Drop { trunk: usize },
    /// Stop what is running and give it back.
    Cancel,
}

/// A configuration in a message. Within a process it stays as it is. Between processes it is JSON,
/// which keeps every bit.
#[derive(Debug, Clone, PartialEq)]
pub enum Posted {
    /// As it is: writing and reading text would take longer than the rest of a small case's
    /// messages.
    Whole(Box<CaseConfig>),
    /// JSON.
    Text(String),
}

impl Posted {
    /// The configuration, or why it cannot be read.
    pub(super) fn read(self) -> Result<CaseConfig, String> {
        match self {
            Posted::Whole(config) => Ok(*config),
            Posted::Text(text) => serde_json::from_str(&text).map_err(|error| error.to_string()),
        }
    }
}

impl From<&CaseConfig> for Posted {
    fn from(config: &CaseConfig) -> Posted {
        Posted::Whole(Box::new(config.clone()))
    }
}

impl Serialize for Posted {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Posted::Whole(config) => {
                let text = serde_json::to_string(config).map_err(serde::ser::Error::custom)?;
                serializer.serialize_str(&text)
            }
            Posted::Text(text) => serializer.serialize_str(text),
        }
    }
}

impl<'de> Deserialize<'de> for Posted {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Posted, D::Error> {
        String::deserialize(deserializer).map(Posted::Text)
    }
}

/// The end of a trunk.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, seconds.
    pub time_s: f64,
}

/// From a worker to the coordinator. Numbers are indices in the plan.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Report {
    /// A trunk ended, or failed. Its checkpoint stays where it is.
    TrunkDone { trunk: usize, result: Result<Reached, Stopped>, wall_time_s: f64 },
    /// A case ended. Its processor time is there if the system provides it.
    CaseDone {
        case: usize,
        result: Result<Delivery, Stopped>,
        wall_time_s: f64,
        cpu_time_s: Option<f64>,
    },
    /// This rank received a signal to stop.
    Interrupted,
}

impl Report {
    /// The work that has ended.
    pub fn work(&self) -> Option<Work> {
        match *self {
            Report::TrunkDone { trunk, .. } => Some(Work::Trunk(trunk)),
            Report::CaseDone { case, .. } => Some(Work::Case(case)),
            Report::Interrupted => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_configuration_arrives_bit_for_bit() {
        let scene = "wave_height_ratio = 0.30000000000000004\ntank_length_m = 2.7".parse().unwrap();
        let config = CaseConfig::from_tables(&scene, &toml::Table::new()).unwrap();
        let posted = Posted::from(&config);
        let bytes = postcard::to_stdvec(&posted).unwrap();
        let arrived: Posted = postcard::from_bytes(&bytes).unwrap();
        assert_eq!(postcard::to_stdvec(&arrived).unwrap(), bytes, "it can be sent on");
        assert_eq!(arrived.read(), Ok(config.clone()));
        assert_eq!(posted.read(), Ok(config));
        assert!(Posted::Text("{".to_owned()).read().is_err());
    }
}
