//! What a run asks of the walls and paddles of a tank.

/// Horizontal motion of a body over one step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodyMotion {
    /// Displacement from rest at the start of the step, metres.
    pub offset: f64,
    /// Velocity, m/s: displacement over the step divided by its length, so that ghosts move as
    /// fast as their wall.
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

    /// This motion at a time of so many seconds, blended in over the first `ramp` seconds so that the
    /// water is not kicked.
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

    /// When it passes the middle of its stroke, seconds; none where it has no single stroke.
    fn stroke_centre(&self) -> Option<f64>;

    /// Of the regular waves that it makes, seconds; none where it makes others.
    fn period(&self) -> Option<f64> {
        None
    }

    /// How far it goes back past where it starts, metres. By default not at all.
    fn goes_back(&self) -> f64 {
        0.0
    }

    /// How far it goes forth past where it starts, metres. By default to where it stands in the end.
    fn goes_forth(&self) -> f64 {
        self.motion(self.still_from()).offset
    }

    /// From when on it stands, seconds; infinite where it never does.
    fn still_from(&self) -> f64;

    /// The surface at its face over still water of this depth, metres, under this gravity, m/s², if no wave
    /// comes back to it. By default that of a long wave: u = 2 (√(g(h+η)) - √(gh)).
    fn raises(&self, time: f64, depth: f64, gravity: f64) -> f64 {
        let root = (gravity * depth).sqrt() + 0.5 * self.motion(time).velocity;
        root * root / gravity - depth
    }

    /// After this time, seconds, a surface that stays higher than it raises counts as its own; none where a
    /// wave that comes back may be as long.
    fn forgets_after(&self) -> Option<f64> {
        None
    }

    /// How fast it must move back, m/s, under a surface this much higher, metres, than it raises itself. By
    /// default as a long wave's water does.
    fn gives_way(&self, excess: f64, depth: f64, gravity: f64) -> f64 {
        let deep = (depth + excess).max(0.0);
        2.0 * ((gravity * deep).sqrt() - (gravity * depth).sqrt())
    }
}

/// Where a wall is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct WallState {
    /// Displacement X from rest, metres, positive away from the water.
    pub displacement: f64,
    /// Velocity V, m/s; among kicks the mean over the step before.
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
}

/// How a wall is held, per metre of width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restraint {
    /// A smaller force leaves it where it stands, N.
    pub threshold: f64,
    /// What force beyond that gives it an acceleration of 1 m/s², kg.
    pub mass: f64,
    /// What force beyond that moves it by a metre, N/m; zero where it goes on and on.
    pub stiffness: f64,
}

/// A wall that answers to the water's force. Forces are per metre of width, along x, hydrostatics
/// included. Every answer is by default that of a wall that never moves.
pub trait WallLaw {
    /// Where it is; none for a wall that never moves.
    fn state(&self) -> Option<WallState> {
        None
    }

    /// Whether this force, N, moves it from rest.
    fn lets_go(&self, force: f64) -> bool;

    /// Whether it stands where only [`WallLaw::lets_go`] decides about what comes next.
    fn rests(&self) -> bool {
        true
    }

    /// Whether it has ever left its place.
    fn has_moved(&self) -> bool {
        false
    }

    /// Moves on by `dt` seconds under the force `force` - `added_mass` · a at the step's start.
    fn kick(&mut self, _force: f64, _added_mass: f64, _dt: f64) -> WallStep {
        WallStep::default()
    }

    /// Likewise under a force that is the mean over the step.
    fn advance(&mut self, _force: f64, _added_mass: f64, _dt: f64) -> WallStep {
        WallStep::default()
    }

    /// The part of a force, N, that drives the wall over a step of this travel, metres. What holds
    /// the wall takes the rest.
    fn driving(&self, _force: f64, _travel: f64) -> f64 {
        0.0
    }

    /// Of its motion, J per metre of width.
    fn kinetic_energy(&self) -> f64 {
        0.0
    }

    /// Of what it is mounted on, J per metre of width.
    fn spring_energy(&self) -> f64 {
        0.0
    }

    /// How it is held; none for a wall that never moves.
    fn restraint(&self) -> Option<Restraint> {
        None
    }
}
