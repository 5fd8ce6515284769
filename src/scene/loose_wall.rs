//! A rough estimate of how far a solitary wave pushes a wall on a soft spring. A run ends if the
//! wall is too far.

use super::contract::SceneOfKind;
use super::seawall::SeawallScene;

/// A wall farther out than this X* is too far.
pub const FARTHEST_WALL: f64 = 11.0;

/// A wall without mass starts with this many √(gh) H/h. Fitted to runs with H/h from 0.2 to 0.7, m*
/// from 0.25 to 6.25 and k* from 0 to 0.005. Their largest X* is reproduced within a tenth.
const SPEED: f64 = 1.67;
/// A wall of mass m* is slower by the factor 1 + this many m*.
const HELD: f64 = 0.22;
/// The largest force on a fixed wall is 1 + this many H/h, for H/h up to 0.6. A wall that is held
/// by more does not move.
const PRESSES: f64 = 4.4;

/// X* when the run ends, or when the spring has turned the wall. `None` for other walls, waves and
/// beds.
pub(super) fn displacement(scene: &SeawallScene) -> Option<f64> {
    let other = !scene.wall.has_threshold() || scene.bed.is_some();
    let stays = scene.threshold_ratio > 1.0 + PRESSES * scene.wave_height_ratio;
    if other || stays || scene.force_coupling == 0.0 {
        return None;
    }
    let frame = scene.frame();
    let arrival = scene.crest_may_pass(frame.length)?;
    let time = (frame.end_time - arrival).max(0.0) * (frame.gravity / frame.depth).sqrt();
    // The force is multiplied by s, which is the same as dividing mass and spring by s.
    let weight = frame.density * frame.depth * frame.depth;
    let mass = scene.seawall_mass_kg_per_m? / (scene.force_coupling * weight);
    let stiffness = scene.spring_stiffness_n_per_m? * frame.depth / (weight * frame.gravity);
    let rate = (stiffness / (scene.force_coupling * mass)).sqrt();
    let turned = (rate * time).min(std::f64::consts::FRAC_PI_2);
    let way = if rate > 0.0 { libm::sin(turned) / rate } else { time };
    Some(scene.wave_height_ratio * SPEED / (1.0 + HELD * mass) * way)
}
