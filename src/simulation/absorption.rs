//! A paddle that lets the waves go which come back to it.
//!
//! Schäffer & Klopman 2000, Review of multidirectional active wave absorption methods, *J. Waterway, Port,
//! Coastal, Ocean Eng.* 126, 88-97: the paddle measures the surface at its own face. What is higher there
//! than its own wave is a wave that has come back, and it gives way as fast as the water of that wave moves.
//! With a wall at the paddle that wave would stand twice as high; a paddle that gives way raises nothing
//! more.

use serde::{Deserialize, Serialize};

use super::surface::{Lens, WallLevel};
use crate::body::{BodyMotion, Paddle};
use crate::scene::{Frame, Tank};

/// The paddle takes on the speed that it should have over so many √(h/g): sound is faster and is left out.
const SPAN: f64 = 0.15;
/// It creeps back to its own stroke over so many √(h/g).
const RETURN: f64 = 100.0;

/// What an absorbing paddle has added to its own motion so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Absorption {
    level: WallLevel,
    /// No wave can have come back before, seconds.
    alone_until: f64,
    /// The excess that lasts, metres.
    lasting: f64,
    added: [f64; 3],
}

impl Absorption {
    /// A paddle that has met no wave yet; `span` as for [`WallLevel::new`].
    pub fn new(span: f64, tank: &Tank) -> Absorption {
        let alone_until = alone_until(tank).unwrap_or(0.0);
        Absorption { level: WallLevel::new(span), alone_until, lasting: 0.0, added: [0.0; 3] }
    }

    /// What is added now.
    pub fn added(&self) -> BodyMotion {
        let [offset, velocity, acceleration] = self.added;
        BodyMotion { offset, velocity, acceleration }
    }

    /// Goes on by `dt` seconds from a time at which the surface stands at these levels at the face and, half a
    /// support radius before it, inside; metres.
    pub fn advance(
        &mut self,
        (time, dt): (f64, f64),
        (at_face, inside): (f64, f64),
        (paddle, motion): (&Paddle, BodyMotion),
        (lens, frame): (&Lens, &Frame),
    ) {
        let Frame { depth, gravity, .. } = *frame;
        // The level's slope at a wall that accelerates away from the water on its other side.
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

/// Until when the surface at a paddle that makes no train is its own, seconds. A wave has to go to where the bed
/// rises, or to the wall, and back. Until then a difference is an error of the reading or of the theory of long waves. To
/// give way to it would take some hundredths from the wave.
fn alone_until(tank: &Tank) -> Option<f64> {
    let paddle = tank.paddle.as_ref().filter(|paddle| paddle.period().is_none())?;
    let Frame { length, depth, gravity, .. } = tank.frame;
    let level = tank.water.walls().profile.as_ref().map_or(length, |bed| bed.level_up_to());
    let celerity = (gravity * depth * (1.0 + tank.wave_height_ratio)).sqrt();
    let back = tank.start_time + (2.0 * level.min(length) - paddle.goes_forth()) / celerity;
    Some(paddle.still_from().min(back))
}
