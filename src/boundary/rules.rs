//! Rules for ghosts, and the targets that follow from them.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::InterpolatorChoice;
use super::ghosts::Ghosts;
use super::sums::{Targets, Water};
use crate::body::BodyMotion;
use crate::kernel::KernelChoice;
use crate::pairs::{PairList, Scaling};

/// Where gravity, the wall's acceleration and the water's own enter a ghost's pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GhostGravity {
    /// Inside the sum, from each neighbour to the ghost: exact at rest.
    InSum,
    /// The same with the water's own acceleration along walls: exact where it falls, too. See `falling.rs`.
    Falling,
    /// At the mirror point, as Huang et al. 2019 print it.
    AtMirror,
}

/// Rules for the ghosts of a scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExchangeRules {
    /// Kernel of the scheme.
    pub kernel: KernelChoice,
    /// Interpolator.
    pub interpolator: InterpolatorChoice,
    /// Scaling of the records.
    pub scaling: Scaling,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// Gravity, m/s², pointing down.
    pub gravity: f64,
    /// Density at zero pressure, kg/m³.
    pub surface_density: f64,
    /// Sound speed, m/s.
    pub sound_speed: f64,
    /// How gravity enters a ghost's pressure.
    pub ghost_gravity: GhostGravity,
    /// Whether the tangential velocity is reversed too, for the viscous terms.
    pub no_slip: bool,
    /// Whether body 0 only counts between the bodies 1 and 2: the bed of a tank with moving ends.
    pub bed_between_walls: bool,
    /// Whether the bed gives its work on the water back to it: see `giving.rs`.
    pub conservative_bed: bool,
    /// The same for a wall with a crest, and what is behind it.
    pub conservative_crest: bool,
}

/// The targets of a part that are among some blocks.
pub(super) fn targets<'a>(
    rules: &ExchangeRules,
    (list, own): (&'a PairList, &Range<usize>),
    (ghosts, bodies, water): (&'a Ghosts, &'a [BodyMotion], Water<'a>),
    blocks: &Range<usize>,
) -> Targets<'a> {
    Targets {
        kernel: rules.kernel,
        scaling: rules.scaling,
        ghosts,
        bodies,
        water,
        list,
        first: own.start,
        blocks: own.start.max(blocks.start)..own.end.min(blocks.end),
        at_ghost: rules.interpolator.at_ghost(),
        falling: rules.ghost_gravity == GhostGravity::Falling,
    }
}
