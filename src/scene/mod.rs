//! Scene files: the one door through which values enter, with defaults, presets and validation.
//!
//! A case is a [`CaseConfig`]: a scene (what is simulated) and numerics (how). Both come from TOML
//! tables through [`CaseConfig::from_tables`], which fills in presets and refuses what is unknown,
//! of the wrong type, or out of range with a [`ConfigError`] that says so.

mod check;
mod config;
mod dam_break;
mod error;
mod filling;
mod frame;
mod hydrostatic;
mod interpolation;
mod limits;
mod numerics;
mod probe;
mod seawall;
mod tank;

pub use config::{CaseConfig, Scene};
pub use dam_break::{DamBreakScene, InitialDensity};
pub use error::ConfigError;
pub use frame::Frame;
pub use hydrostatic::HydrostaticScene;
pub use limits::limits;
pub use numerics::{
    BoundaryChoice, ErrorBars, GhostGravity, Numerics, PRESETS, Precision, Scheme, Slip,
};
pub use probe::{Probe, ProbeKind, Side};
pub use seawall::{SeawallScene, WallChoice};
pub use tank::{BED, PADDLE, Tank, WALL};
