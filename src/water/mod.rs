//! Functions over the water's fields that every scheme uses. They do not depend on a scheme.

mod inside;
mod level;
mod shortfall;
mod state_equation;
mod support;

pub use inside::{HoldInside, any_nearer};
pub use level::{first_level, level_up_to};
pub use shortfall::{Shortfall, VOLUME_DEPTHS};
pub use state_equation::{StateEquation, StateEquationChoice};
pub use support::{SHIFT_DEEP, SHIFT_INTERIOR, SHIFT_LIMIT, Slack, shifted_share};
