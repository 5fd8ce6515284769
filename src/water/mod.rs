//! What every scheme does with its water, as functions over the water's fields: they know no
//! scheme.

mod inside;
mod level;
mod shifting;
mod slack;
mod state_equation;

pub use inside::{HoldInside, any_nearer};
pub use level::{first_level, level_up_to};
pub use shifting::{SHIFT_FROM, SHIFT_FULL, SHIFT_LIMIT, shifted_share};
pub use slack::Slack;
pub use state_equation::{StateEquation, StateEquationChoice};
