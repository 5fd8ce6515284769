//! A paddle that absorbs the waves that come back to it.
//!
//! Schäffer & Klopman 2000, Review of multidirectional active wave absorption methods, *J.
//! Waterway, Port, Coastal, Ocean Eng.* 126, 88-97. The paddle measures the surface at its own
//! face. The excess over its own wave is a wave that has come back. The paddle moves back as fast
//! as the water of that wave, so that the wave is not reflected. At a fixed wall it would stand
//! twice as high.

use serde::{Deserialize, Serialize};

use super::surface::{Lens, WallLevel};
use crate::body::{BodyMotion, Paddle};
use crate::scene::{Frame, Tank};

/// The paddle takes on its wanted speed over this many √(h/g). Sound is faster and is left out.
const SPAN: f64 = 0.15;
/// It returns slowly to its own stroke, over this many √(h/g).
const RETURN: f64 = 100.0;

/// The motion that an absorbing paddle has added to its own so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Absorption {
    level: WallLevel,
    /// No wave can have come back before this time, seconds.
    alone_until: f64,
    /// The part of the excess that lasts, metres.
    lasting: f64,
    added: [f64; 3],
}

impl Absorption {
    /// A paddle that no wave has reached yet; `span` as for [`WallLevel::new`].
    pub fn new(span: f64, tank: &Tank) -> Absorption {
        let alone_until = alone_until(tank).unwrap_or(0.0);
        Absorption { level: WallLevel::new(span), alone_until, lasting: 0.0, added: [0.0; 3] }
    }

    /// The motion that is added now.
    pub fn added(&self) -> BodyMotion {
        let [offset, velocity, acceleration] = self.added;
        BodyMotion { offset, velocity, acceleration }
    }

    /// Advances by `dt` seconds. At the start the surface has these levels, metres: at the face,
    /// and inside, half a support radius before it.
    pub fn advance(
        &mut self,
        (time, dt): (f64, f64),
        (at_face, inside): (f64, f64),
        (paddle, motion): (&Paddle, BodyMotion),
        (lens, frame): (&Lens, &Frame),
    ) {
        let Frame { depth, gravity, .. } = *frame;
        // The slope of the level is that at a wall on the water's other side, so the acceleration
        // has the other sign.
        self.level.feel(time, (-motion.acceleration, at_face), gravity);
        let surface = self.level.over_rest(lens, at_face, Some(inside));
        let mut excess = surface - paddle.raises(time, depth, gravity);
        if let Some(span) = paddle.forgets_after() {
            self.lasting += dt / span * (excess - self.lasting);
            excess -= self.lasting;
        }
        if time < self.alone_until {
            excess = 0.0;
        }
        let unit = (depth / gravity).sqrt();
        let [offset, velocity, acceleration] = self.added;
        let wanted = -paddle.gives_way(excess, depth, gravity) - offset / (RETURN * unit);
        self.added = [
            offset + dt * (velocity + 0.5 * dt * acceleration),
            velocity + dt * acceleration,
            (wanted - velocity) / (SPAN * unit),
        ];
    }
}

/// Time until which the surface at a paddle that makes no train is its own, seconds. A wave must
/// first go to where the bed rises, or to the wall, and come back. Until then a difference is an
/// error of the reading or of long-wave theory. If the paddle moved back for it, the wave would
/// lose some hundredths.
fn alone_until(tank: &Tank) -> Option<f64> {
    let paddle = tank.paddle.as_ref().filter(|paddle| paddle.period().is_none())?;
    let Frame { length, depth, gravity, .. } = tank.frame;
    let level = tank.water.walls().profile.as_ref().map_or(length, |bed| bed.level_up_to());
    let celerity = (gravity * depth * (1.0 + tank.wave_height_ratio)).sqrt();
    let back = tank.start_time + (2.0 * level.min(length) - paddle.goes_forth()) / celerity;
    Some(paddle.still_from().min(back))
}
