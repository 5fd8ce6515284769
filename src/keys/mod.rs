//! Keys of scene and sweep files, each declared once.
//!
//! A declaration says a key's name, type, default, meaning, unit and range, and where it applies.
//! Reading and range checks, the errors that name the nearest key, the lines of `seawall check`, the
//! tables of `docs/files.md` and the JSON Schema (`seawall check --schema`) all come from it.
//!
//! # What an entry says
//! `CONTRIBUTING.md` has the recipe, with an example.
//!
//! - The doc comment is the meaning, in the docs too. The unit ends the name and stands in
//!   `unit("N/m")`; names, flags and ratios have `plain()`.
//! - A key without `= default` must be given. One that may be left out is an `Option` with `= None`.
//! - An enum's names are those that serde gives its variants.
//! - [`Rule`] lists what may follow: the range, `only` and `read_where` for keys that mean nothing at
//!   other values of another key, `needed` for one that must be given where it applies, `newer` for
//!   one that is added once there are results.
//!
//! # Adding a group of keys
//! What has keys of its own, such as a body, declares them in a `section!` in its own file, each
//! `only` where it applies, and the section that may hold it names it once, behind its own keys:
//!
//! ```text
//! with {
//!     /// The caisson that the wall is.
//!     caisson: CaissonKeys where wall == WallChoice::Caisson;
//! }
//! ```
//!
//! It is an `Option` there, and `Some` where the condition holds. A key that several groups would
//! share stays with the section, `only` where one of them stands, and `needed` if it must be given.

mod alike;
mod error;
mod given;
mod given_file;
mod key;
mod overrides;
mod rule;
mod schema;
mod section;
mod shape;
mod shared;
mod shown;
mod written;

pub use alike::alike;
pub use error::{ConfigError, cut, hint, shortened};
pub use given::{check_conditions, read_alone};
pub use given_file::bytes_of;
pub use key::{Key, number};
pub use overrides::{Override, read_value, with_settings};
pub use rule::{Range, Rule, When, plain, unit};
pub use schema::schema;
pub(crate) use section::section;
pub use section::{Section, given, stored, value, value_of};
pub use shape::Shape;
pub use shared::{Recent, Shared};
pub use shown::{named, shown};
