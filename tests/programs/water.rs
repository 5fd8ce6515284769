//! Water, ghosts and bodies, asked through the library.
//!
//! One program for all of them: each links the whole library, and in one of them the short tests fill the time of
//! the long ones. `cargo test --test water bodies::` asks one file alone.

#[path = "../bodies.rs"]
mod bodies;
#[path = "../body_contract.rs"]
mod body_contract;
#[path = "../boundary.rs"]
mod boundary;
#[path = "../dam_break.rs"]
mod dam_break;
#[path = "../flows.rs"]
mod flows;
#[path = "../geometry.rs"]
mod geometry;
#[path = "../incompressible.rs"]
mod incompressible;
#[path = "../interpolators.rs"]
mod interpolators;
#[path = "../kept.rs"]
mod kept;
#[path = "../loads.rs"]
mod loads;
#[path = "../physics.rs"]
mod physics;
#[path = "../stability.rs"]
mod stability;
#[path = "../stops.rs"]
mod stops;
#[path = "../truth.rs"]
mod truth;
