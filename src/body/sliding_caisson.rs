//! A caisson that slides on its bed with Coulomb friction.

use serde::{Deserialize, Serialize};

use super::{FixedWall, Restraint, Wall, WallLaw, WallState, WallStep};
use crate::keys::{ConfigError, Range, section};

section! {
    /// The keys of a caisson.
    pub struct CaissonKeys in "scene" {
        /// μ_s between a caisson and its bed: it moves where the water presses with more or less than
        /// ½ρgh² ± μ_s N, whatever `threshold_ratio`.
        static_friction: f64, plain().above_zero().only("wall", &["caisson"]);
        /// μ_k once it slides, at most μ_s.
        kinetic_friction: f64, plain().not_negative().only("wall", &["caisson"]);
        /// Weight N of a caisson under water, per metre of width.
        submerged_weight_n_per_m: f64, unit("N/m").above_zero().only("wall", &["caisson"]);
    }
}

impl CaissonKeys {
    /// μ_s N, N per metre of width.
    pub fn holding_friction(&self) -> f64 {
        self.static_friction * self.submerged_weight_n_per_m
    }

    /// The caisson at rest: mass, kg; force of still water, N; per metre of width. Without a mass
    /// it is held in both directions.
    pub fn wall(&self, mass: Option<f64>, still_force: f64) -> Wall {
        let holding = self.holding_friction();
        let Some(mass) = mass else {
            return Wall::Fixed(FixedWall {
                holds: [still_force - holding, still_force + holding],
            });
        };
        let friction = [holding, self.kinetic_friction * self.submerged_weight_n_per_m];
        Wall::Caisson(SlidingCaisson::at_rest(mass, still_force, friction))
    }

    /// The same holding friction, without the data of sliding.
    pub fn held(&self) -> CaissonKeys {
        CaissonKeys {
            static_friction: 1.0,
            kinetic_friction: 0.0,
            submerged_weight_n_per_m: self.holding_friction(),
        }
    }

    /// Checks keys against each other.
    ///
    /// # Errors
    /// More friction once it slides than before.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let Self { static_friction, kinetic_friction, .. } = *self;
        Range::Within(0.0, static_friction).check("scene.kinetic_friction", kinetic_friction)
    }
}

/// m a = F - F_0 - μ_k N sign(V); no motion as long as it stands and |F - F_0| ≤ μ_s N.
///
/// F is the full force of the water per metre of width, hydrostatics included. F_0 is the force of
/// still water, ½ρgh², because the same water stands behind the caisson. N is its submerged weight.
/// It stops where its velocity passes zero and the excess force is too small to move it. The
/// water's reaction to its acceleration, F = `force` - A a, is solved together with a.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SlidingCaisson {
    /// m, kg per metre of width.
    pub mass: f64,
    /// F_0, N per metre of width.
    pub still_force: f64,
    /// μ_s N, N per metre of width.
    pub holding_friction: f64,
    /// μ_k N, N per metre of width.
    pub sliding_friction: f64,
    /// X, metres; in either direction.
    pub displacement: f64,
    /// V, m/s; with kicks the mean over the step before.
    pub velocity: f64,
}

impl SlidingCaisson {
    /// A caisson at rest: mass, kg; force of still water, μ_s N and μ_k N, N; all per metre of width.
    pub fn at_rest(mass: f64, still_force: f64, [holding, sliding]: [f64; 2]) -> SlidingCaisson {
        SlidingCaisson {
            mass,
            still_force,
            holding_friction: holding,
            sliding_friction: sliding,
            displacement: 0.0,
            velocity: 0.0,
        }
    }

    /// Exact sliding for `dt` seconds under a constant force. Returns travel, metres, and the new
    /// velocity, m/s.
    fn slide(&self, force: f64, added_mass: f64, dt: f64) -> [f64; 2] {
        let (excess, inertia) = (force - self.still_force, self.mass + added_mass);
        let acceleration =
            |towards: f64| (excess - self.sliding_friction * towards.signum()) / inertia;
        let (mut travel, mut left) = (0.0, dt);
        if self.velocity != 0.0 {
            let a = acceleration(self.velocity);
            let standstill = -self.velocity / a;
            if !(0.0..dt).contains(&standstill) {
                return [self.velocity * dt + 0.5 * a * dt * dt, self.velocity + a * dt];
            }
            travel = 0.5 * self.velocity * standstill;
            left = dt - standstill;
        }
        if !self.lets_go(force) {
            return [travel, 0.0];
        }
        let a = acceleration(excess);
        [travel + 0.5 * a * left * left, a * left]
    }

    fn take(&mut self, travel: f64, velocity: f64, dt: f64) -> WallStep {
        let acceleration = (velocity - self.velocity) / dt;
        // Friction jumps with the sense of the motion.
        let sense = |velocity: f64| [velocity > 0.0, velocity < 0.0];
        let jumps = sense(velocity) != sense(self.velocity);
        self.displacement += travel;
        self.velocity = velocity;
        WallStep { acceleration, travel, jumps, ..WallStep::default() }
    }
}

impl WallLaw for SlidingCaisson {
    fn state(&self) -> Option<WallState> {
        let SlidingCaisson { displacement, velocity, .. } = *self;
        Some(WallState { displacement, velocity, stops: 0 })
    }

    fn lets_go(&self, force: f64) -> bool {
        (force - self.still_force).abs() > self.holding_friction
    }

    fn rests(&self) -> bool {
        self.velocity == 0.0
    }

    fn has_moved(&self) -> bool {
        self.displacement != 0.0 || self.velocity != 0.0
    }

    fn kick(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        let [_, velocity] = self.slide(force, added_mass, dt);
        self.take(velocity * dt, velocity, dt)
    }

    fn advance(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        let [travel, velocity] = self.slide(force, added_mass, dt);
        self.take(travel, velocity, dt)
    }

    /// Friction and the water behind bear the rest.
    fn driving(&self, force: f64, travel: f64) -> f64 {
        force - self.still_force - self.sliding_friction * travel.signum()
    }

    /// ½ m V².
    fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity * self.velocity
    }

    fn restraint(&self) -> Option<Restraint> {
        let threshold = self.still_force + self.holding_friction;
        Some(Restraint { threshold, mass: self.mass, stiffness: 0.0 })
    }
}

#[cfg(test)]
mod tests;
