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
    /// A dry floor, up to an end wall.
    Floor,
    /// Still water on a floor, up to an end wall.
    Basin,
}

impl Behind {
    /// Whether there is still water behind the wall.
    pub fn has_water(self) -> bool {
        self == Behind::Basin
    }

    /// Whether water that goes over the wall stays.
    pub fn keeps(self) -> bool {
        matches!(self, Behind::Floor | Behind::Basin)
    }
}

section! {
    /// The keys of a wall's crest.
    pub struct CrestKeys in "scene" {
        /// Height of the wall's crest over still water, its freeboard.
        crest_freeboard_m: f64,
            unit("m").above_zero().only("behind", &["outflow", "floor", "basin"]);
        /// From the wall's face to its back, along its level crest.
        crest_width_m: f64,
            unit("m").above_zero().only("behind", &["outflow", "floor", "basin"]);
    }
}

section! {
    /// The keys of a floor behind a wall.
    pub struct FloorKeys in "scene" {
        /// Height of the floor behind the wall over the paddle's foot; below 0 it lies lower.
        floor_height_m: f64 = 0.0, unit("m").only("behind", &["floor", "basin"]);
        /// From the wall's back to the end wall behind it.
        floor_length_m: f64, unit("m").above_zero().only("behind", &["floor", "basin"]);
        /// Height of the still water behind the wall over the paddle's foot, at the start.
        basin_level_m: Option<f64> = None,
            unit("m").only("behind", &["basin"]).otherwise("still_water_depth_m");
    }
}
