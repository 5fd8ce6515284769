//! Runs that end before a wave is at the wall.

use crate::keys::ConfigError;
use crate::scene::contract::SceneOfKind;
use crate::scene::seawall::SeawallScene;

/// What sets off from the paddle towards the wall.
struct Departure {
    /// What it is called.
    what: &'static str,
    /// When it leaves the paddle, seconds.
    from: f64,
    /// Its speed, m/s.
    speed: f64,
}

/// The run ends before the wave is at the wall. Over a bed long waves are slower, and come later.
pub(super) fn early(scene: &SeawallScene) -> Option<ConfigError> {
    let (frame, paddle) = (scene.frame(), scene.paddle()?);
    let Departure { what, from, speed } = departure(scene)?;
    let way = (frame.length - paddle.motion(from).offset) / speed;
    let seen = match scene.end_time_s {
        // It has precedence over the other key.
        Some(_) => format!("end_time_s = {:.1}", from + 2.0 * way),
        // Only a single wave may do without it.
        None => format!("end_after_stroke_centre_s = {:.1}", 2.0 * way),
    };
    let told = || {
        format!(
            "the run ends at {:.3} s, before {what} can be at the wall, at {:.3} s; with {seen} the run shows what it \
             does there",
            frame.end_time,
            from + way,
        )
    };
    (frame.end_time < from + way)
        .then(|| ConfigError::new("scene.tank_length_m", frame.length, told()))
}

/// A solitary wave's crest leaves in the middle of the stroke. A train is as fast as its energy, the
/// group velocity, and leaves in the middle of its first period, in which it is blended in. What a
/// record makes leaves when the paddle first goes some way.
fn departure(scene: &SeawallScene) -> Option<Departure> {
    if let Some(from) = scene.paddle()?.stroke_centre() {
        return Some(Departure { what: "the crest", from, speed: scene.celerity() });
    }
    if let Some((keys, waves)) = scene.wave_train.as_ref().zip(scene.regular_waves()) {
        let speed = waves.group_velocity(scene.still_water_depth_m);
        return Some(Departure { what: "the train", from: 0.5 * keys.wave_period_s, speed });
    }
    let from = scene.recorded.as_ref()?.recorded_stroke.sets_off_s()?;
    Some(Departure { what: "the wave", from, speed: scene.celerity() })
}
