//! Neighbour search: particles sorted into strips, clusters of eight, and a Verlet list for each.
//!
//! Eight particles that lie close together share one list, and a pair loop computes them in the
//! eight lanes of a vector while it walks over their common neighbours.

mod pair_list;
mod strips;
mod verlet;

pub use pair_list::{PairList, PointSet, build_pair_list};
pub use strips::Strips;
pub use verlet::{Drift, Reach};
