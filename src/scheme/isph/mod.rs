//! Incompressible SPH by a divergence-free projection (Liang et al. 2017, Eqs. 5-14).
//!
//! A step predicts places r* (Eq. 8), lists there who is near whom (`lists.rs`), gathers all operators
//! (`gather.rs`), finds the surface (`surface.rs`), assembles and solves the pressure equation (Eq. 11,
//! `assembly.rs`, `exact.rs`) and, once the walls' motion is settled, corrects velocities (Eq. 9) and
//! places (Eq. 10, `motion.rs`).
//! Walls are dummies that mirror the water itself (`images.rs`).

mod assembly;
mod compact;
mod contract;
mod exact;
mod gather;
mod images;
mod laplacian;
mod lattice;
mod lists;
mod motion;
mod options;
mod parting;
mod project;
mod readings;
mod solve;
mod state;
mod sums;
mod surface;
mod system;
#[cfg(test)]
mod tests;
mod viscosity;

pub use options::{IsphOptions, Laplacian};
pub use state::{Isph, IsphState};
