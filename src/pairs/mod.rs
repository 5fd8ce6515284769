//! Particles and their pairs. Everything that makes sums over neighbours fast is here, behind the
//! request "for these pairs, sum these terms".
//!
//! - The water has one array per field ([`Fluid`]). Loops over pairs read one cache line of a
//!   neighbour ([`Record`]). Eight particles that lie close together share one list of neighbours,
//!   and their pairs are computed together.
//! - An equation states its [`Term`]s for one particle and one neighbour. A full pass
//!   ([`Pairs::full_pass`]) finds the geometry of all pairs and sums the terms. It holds the pairs
//!   in reach for the passes that follow ([`Pairs::held_pass`]), which need neither distances nor
//!   the kernel.
//! - [`Pairs`] has the lists, which last until a pair may have come into reach unseen.
//!
//! Lanes, chunks, parts, precision, prefetches and held sums stay inside. In an equation [`Real`]
//! can be read as a number of one pair, [`Double`] as a number of one particle.

mod around;
mod column;
mod factors;
mod fields;
mod flow;
mod fluid;
mod geometry;
mod held;
mod held_sums;
mod lists;
mod near;
mod pair_list;
mod parts;
mod pass;
mod precision;
mod record;
mod rounding;
mod strips;
mod term;
mod verlet;
mod weights;

pub use around::{Around, Neighbours, Records, Sums};
pub use column::Column;
pub use factors::Factors;
pub use fields::{Extrapolate, Here, Ramp};
pub use flow::{Flow, FlowSums, Own};
pub use fluid::{Fluid, gather, reorder};
pub use geometry::Pair;
pub use held_sums::Held;
pub use lists::{GHOST_MARGIN, Pairs};
pub use near::{Blocks, Coupling, Field, Moments, Near};
pub use pair_list::{PairList, PointSet, build_pair_list};
pub use parts::Tally;
pub use pass::{Each, Equation, HeldEquation, Summed, sum_in_turn};
pub use precision::{Neighbour, Other, Precision};
pub use record::{Record, Scaling, SingleRecord};
pub use rounding::round;
pub use strips::Strips;
pub use term::{Eight, If, Term, loaded};
pub use weights::HeldWeights;

pub use crate::math::simd::{Lanes as Double, Vector as Real};
