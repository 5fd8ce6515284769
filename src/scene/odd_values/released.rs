//! Columns that are said to be released where nothing can be.

use crate::keys::ConfigError;
use crate::scene::dam_break::InitialDensity;
use crate::scene::kind::Scene;

/// Huang's Eqs. 23-25 have no pressure at the end of the column, where a wall stands here.
pub(super) fn released(scene: &Scene) -> Option<ConfigError> {
    let Scene::DamBreak(scene) = scene else { return None };
    let told = "the column fills its tank and stays at rest, but this density has no pressure at the wall before it, and \
                water hits that wall at once; \"hydrostatic\" lets it rest";
    let odd = scene.fills_tank() && scene.initial_density == Some(InitialDensity::DamBreak);
    odd.then(|| ConfigError::new("scene.initial_density", "\"dam-break\"", told))
}
