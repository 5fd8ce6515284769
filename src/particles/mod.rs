//! Particle arrays: the fluid, the packed records that pair loops read, lattices.

mod fluid;
mod record;

pub use fluid::{Fluid, reorder};
pub use record::{Record, Scaling, SingleRecord, split};
