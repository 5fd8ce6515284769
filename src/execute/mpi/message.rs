//! What ranks say to each other.

use serde::{Deserialize, Serialize};

use super::super::{Order, Report};
use super::hello::Hello;
use crate::math::simd::SimdPath;
use crate::results::{Mark, RankInfo};
use crate::schedule::Work;

/// Everything that ranks say to each other.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Message {
    Hello(Hello),
    Start(Start),
    Order(Order),
    /// What has ended since the last time.
    Reports(Vec<Report>),
    /// What is being worked on, and the share of it that is done.
    UnderWay(Vec<(Work, f64)>),
    Pull {
        trunk: usize,
    },
    Checkpoint {
        trunk: usize,
        bytes: Option<Vec<u8>>,
    },
    /// Nothing is left to do for now; rank 0 no longer listens all the time.
    Rest,
    Finish,
    Bye,
    Leave,
    /// Still here.
    Beat,
}

/// What a rank has to know before it works.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Start {
    pub(super) simd: SimdPath,
    pub(super) rank: RankInfo,
    /// The output directory.
    pub(super) out: Option<Mark>,
}
