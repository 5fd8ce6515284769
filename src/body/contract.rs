//! What a run asks of the walls and paddles of a tank.

/// Horizontal motion of a body over one step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodyMotion {
    /// Displacement from rest at the start of the step, metres.
    pub offset: f64,
    /// Velocity, m/s: displacement over the step divided by its length. So ghosts move as fast as
    /// their wall.
    pub velocity: f64,
    /// Acceleration, m/s².
    pub acceleration: f64,
}

impl BodyMotion {
    /// Adds another motion.
    pub fn add(&mut self, other: &BodyMotion) {
        self.offset += other.offset;
        self.velocity += other.velocity;
        self.acceleration += other.acceleration;
    }

    /// This motion at a time in seconds. It is blended in over the first `ramp` seconds, so that
    /// the water gets no sudden push.
    pub(super) fn eased_in(self, time: f64, ramp: f64) -> BodyMotion {
        if time >= ramp {
            return self;
        }
        // Quintic blend s(τ) = 6τ⁵ - 15τ⁴ + 10τ³: no jump in position, velocity or acceleration.
        let tau = (time / ramp).max(0.0);
        let s = tau * tau * tau * (10.0 + tau * (6.0 * tau - 15.0));
        let s1 = 30.0 * tau * tau * (1.0 - tau) * (1.0 - tau) / ramp;
        let s2 = 60.0 * tau * (1.0 - tau) * (1.0 - 2.0 * tau) / (ramp * ramp);
        let BodyMotion { offset, velocity, acceleration } = self;
        BodyMotion {
            offset: offset * s,
            velocity: velocity * s + offset * s1,
            acceleration: acceleration * s + 2.0 * velocity * s1 + offset * s2,
        }
    }
}

/// A paddle, whose motion is known beforehand.
pub trait PaddleLaw {
    /// Its motion at a time since the start, seconds.
    fn motion(&self, time: f64) -> BodyMotion;

    /// When it passes the middle of its stroke, seconds; none if it has no single stroke.
    fn stroke_centre(&self) -> Option<f64>;

    /// Period of the regular waves that it makes, seconds; none for other waves.
    fn period(&self) -> Option<f64> {
        None
    }

    /// How far it moves back beyond its start, metres. The bed goes on behind it as far.
    fn goes_back(&self) -> f64;

    /// How far it moves forward beyond its start, metres.
    fn goes_forth(&self) -> f64;

    /// Time from which it stands still, seconds; infinite if it never does.
    fn still_from(&self) -> f64;

    /// The surface at its face above still water, metres, if no wave comes back to it. `depth` is
    /// that of still water, metres; `gravity` is in m/s². By default the surface of a long wave: u
    /// = 2 (√(g(h+η)) - √(gh)).
    fn raises(&self, time: f64, depth: f64, gravity: f64) -> f64 {
        let root = (gravity * depth).sqrt() + 0.5 * self.motion(time).velocity;
        root * root / gravity - depth
    }

    /// A surface that stays higher than its own for this time, seconds, counts as its own. None
    /// where a wave that comes back may last as long.
    fn forgets_after(&self) -> Option<f64> {
        None
    }

    /// How fast it must move back, m/s, where the surface is this much higher than its own wave,
    /// metres. By default as fast as the water of a long wave.
    fn gives_way(&self, excess: f64, depth: f64, gravity: f64) -> f64 {
        let deep = (depth + excess).max(0.0);
        2.0 * ((gravity * deep).sqrt() - (gravity * depth).sqrt())
    }
}

/// Position and motion of a wall.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WallState {
    /// Displacement X from rest, metres, positive away from the water.
    pub displacement: f64,
    /// Velocity V, m/s; with kicks the mean over the step before.
    pub velocity: f64,
    /// How often it came back onto its stop.
    pub stops: u32,
}

/// What a wall does over one step; by default nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WallStep {
    /// Acceleration that the water feels, m/s²; 0 in a step that ends on the stop.
    pub acceleration: f64,
    /// Displacement over the step, metres.
    pub travel: f64,
    /// Kinetic energy lost on the stop, J per metre of width.
    pub stop_loss: f64,
    /// How fast the wall came onto the stop, m/s.
    pub stop_speed: f64,
    /// Whether its acceleration jumps at the start of the step, as another law holds from then on:
    /// it breaks loose, turns round or comes to a stand. Blows on a stop do not count.
    pub jumps: bool,
}

/// How a wall is held, per metre of width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restraint {
    /// A smaller force does not move it, N.
    pub threshold: f64,
    /// The force beyond the threshold that gives an acceleration of 1 m/s², kg.
    pub mass: f64,
    /// The force beyond the threshold that moves it by one metre, N/m; zero without a spring.
    pub stiffness: f64,
}

/// A wall that responds to the water's force. Forces are per metre of width, along x, hydrostatics
/// included. By default every answer is that of a wall that never moves.
pub trait WallLaw {
    /// Its state; none for a wall that never moves.
    fn state(&self) -> Option<WallState> {
        None
    }

    /// Whether this force, N, moves it from rest.
    fn lets_go(&self, force: f64) -> bool;

    /// Whether it is at rest, so that only [`WallLaw::lets_go`] decides whether it moves.
    fn rests(&self) -> bool {
        true
    }

    /// Whether it has ever moved.
    fn has_moved(&self) -> bool {
        false
    }

    /// Advances by `dt` seconds under the force `force` - `added_mass` · a at the step's start.
    fn kick(&mut self, _force: f64, _added_mass: f64, _dt: f64) -> WallStep {
        WallStep::default()
    }

    /// The same under a force that is the mean over the step.
    fn advance(&mut self, _force: f64, _added_mass: f64, _dt: f64) -> WallStep {
        WallStep::default()
    }

    /// The part of a force, N, that drives the wall over a step of this travel, metres. The rest is
    /// borne by the parts that hold the wall.
    fn driving(&self, _force: f64, _travel: f64) -> f64 {
        0.0
    }

    /// Kinetic energy, J per metre of width.
    fn kinetic_energy(&self) -> f64 {
        0.0
    }

    /// Energy of its spring, J per metre of width.
    fn spring_energy(&self) -> f64 {
        0.0
    }

    /// How it is held; none for a wall that never moves.
    fn restraint(&self) -> Option<Restraint> {
        None
    }
}
