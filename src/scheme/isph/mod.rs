//! Incompressible SPH by a divergence-free projection (Liang et al. 2017, Eqs. 5-14).
//!
//! A step predicts places r* (Eq. 8), lists there who is near whom, finds all operators and the surface
//! (`surroundings.rs`), assembles and solves the pressure equation (Eq. 11, `assembly.rs`, `solve.rs`)
//! and, once the walls' motion is settled, corrects velocities (Eq. 9) and places (Eq. 10, `motion.rs`).
//! These are methods of [`Isph`]; what they call are functions over fields. Sums over pairs are terms
//! (`gradient.rs`, `divergence.rs`, `viscosity.rs`, `surface.rs`) of the engine for
//! [`Near`](crate::pairs::Near) pairs.
//! Walls are dummies that mirror the water itself (`images.rs`).

mod assembly;
mod compact;
mod contract;
mod corner;
mod divergence;
mod exact;
mod gradient;
mod images;
mod laplacian;
mod lattice;
mod loss;
mod motion;
mod operators;
mod options;
mod parting;
mod project;
mod readings;
mod solve;
mod state;
mod surface;
mod surroundings;
mod system;
#[cfg(test)]
mod tests;
mod viscosity;
mod volume;

pub use options::{IsphOptions, Laplacian};
pub use state::{Isph, IsphState};
