//! Incompressible SPH by a divergence-free projection (Liang et al. 2017, Eqs. 5-14).
//!
//! A step goes through these stages:
//! - It predicts positions r* (Eq. 8). There it lists neighbours and finds all operators and the
//!   surface (`surroundings.rs`).
//! - It assembles and solves the pressure equation (Eq. 11, `assembly.rs`, `solve.rs`).
//! - Once the walls' motion is known, it corrects velocities (Eq. 9) and positions (Eq. 10,
//!   `motion.rs`).
//!
//! These are methods of [`Isph`], which call functions over fields. Sums over pairs are terms
//! (`gradient.rs`, `divergence.rs`, `viscosity.rs`, `surface.rs`) for [`Near`](crate::pairs::Near).
//! Walls are mirror images of the water (`images.rs`).

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
