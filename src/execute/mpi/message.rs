//! Messages between ranks.

use serde::{Deserialize, Serialize};

use super::super::{Order, Report};
use super::hello::Hello;
use crate::math::simd::SimdPath;
use crate::results::{Mark, RankInfo};
use crate::schedule::Work;

/// All messages between ranks.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Message {
    Hello(Hello),
    Start(Start),
    Order(Order),
    /// The work that has ended since the last message.
    Reports(Vec<Report>),
    /// The present work, with the share of it that is done.
    UnderWay(Vec<(Work, f64)>),
    Pull {
        trunk: usize,
    },
    Checkpoint {
        trunk: usize,
        bytes: Option<Vec<u8>>,
    },
    /// There is no work for now. Rank 0 does not listen all the time any more.
    Rest,
    Finish,
    Bye,
    Leave,
    /// A sign of life.
    Beat,
}

/// The data that a rank needs before it works.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Start {
    pub(super) simd: SimdPath,
    pub(super) rank: RankInfo,
    /// The output directory.
    pub(super) out: Option<Mark>,
}
