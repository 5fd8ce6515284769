//! What a paddle that absorbs waves asks of the rest of the scene.

use super::numerics::{Numerics, Scheme};
use super::seawall::{SeawallScene, error};
use crate::keys::ConfigError;

impl SeawallScene {
    /// Checks what absorption asks of scheme and end.
    pub(super) fn validate_absorption(&self, numerics: &Numerics) -> Result<(), ConfigError> {
        let told = |allowed: &str| error("absorption", "true", allowed);
        if self.absorption && numerics.scheme == Scheme::Isph {
            return told("is for scheme = \"wcsph\"");
        }
        if self.absorption && numerics.stop_when_settled {
            return told("is not for stop_when_settled = true: the paddle never stands");
        }
        Ok(())
    }
}
