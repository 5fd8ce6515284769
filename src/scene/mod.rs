//! Scene files: the only way for values to enter, with defaults, presets and validation.
//!
//! A case is a [`CaseConfig`]: a scene (what is simulated) and numerics (how). Both come from TOML
//! tables through [`CaseConfig::from_tables`]. It fills in presets. It refuses what is unknown, of
//! the wrong type, or out of range, with a [`ConfigError`] that says so.

mod bed_demands;
mod bed_lattice;
mod config;
mod contract;
mod crest;
mod crest_demands;
mod dam_break;
mod declared;
mod filling;
mod frame;
mod happening;
mod hydrostatic;
mod interpolator;
mod kind;
mod lattice;
mod leaning;
mod limit_facts;
mod limits;
mod loose_wall;
mod numerics;
mod numerics_of_scene;
mod odd_values;
mod oscillating_drop;
mod packing;
mod preset;
mod probe;
mod rotating_patch;
mod seawall;
mod seawall_demands;
mod seawall_tank;
mod size;
mod squares;
mod standing_wave;
mod still_water;
mod suited;
mod tank;
mod taylor_green;
mod wall_choice;
mod water;

pub use config::CaseConfig;
pub use contract::Walls;
pub use crest::Behind;
#[cfg(test)]
pub(crate) use declared::belongs;
pub use declared::{
    Place, numerics_keys, place_of, probe_keys, scene_keys, takes_whole, unknown_keys,
};
pub use frame::Frame;
pub use happening::FALLS_FREE;
pub use kind::{Kind, Scene};
pub use limits::limits;
pub use loose_wall::FARTHEST_WALL;
pub use numerics::{ErrorBars, IncompressibleNumerics, Numerics, Scheme, Slip};
pub use odd_values::odd_by_key;
pub use preset::Preset;
pub use probe::{CREST_COLUMNS, HISTORY_COLUMNS, OVER_STILL_WATER, Probe, ProbeKind, Side};
pub use seawall::{PaddleChoice, SeawallScene};
pub use suited::{SUITED, Suited, other_defaults};
pub use tank::Tank;
pub use wall_choice::{WallChoice, WallLook};

pub use crate::keys::ConfigError;
