//! The keys of what a wall ends in, and what lies behind it.

use serde::{Deserialize, Serialize};

use crate::keys::section;

/// What lies behind the seawall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Behind {
    /// Nothing: the wall is so high that no water goes over it.
    Nothing,
    /// Water that goes over the wall is taken away.
    Outflow,
}

section! {
    /// The keys of a wall's crest.
    pub struct CrestKeys in "scene" {
        /// Height of the wall's crest over still water, its freeboard.
        crest_freeboard_m: f64, unit("m").above_zero().only("behind", &["outflow"]);
        /// From the wall's face to its back, along its level crest.
        crest_width_m: f64, unit("m").above_zero().only("behind", &["outflow"]);
    }
}
