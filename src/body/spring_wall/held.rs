//! The wall's step under a force that is the mean over the step.

use super::{SpringWall, WallStep};
use crate::theory::oscillator::{Oscillator, OscillatorState};

/// The wall over a step: mass, spring and the force that holds. If the step resolves the spring,
/// its motion is exact. If the spring is far too stiff for the step, the wall moves to its balance
/// at the step's end.
struct Swing {
    exact: Oscillator,
    from: OscillatorState,
    /// From Euler's backward step.
    balanced: OscillatorState,
    /// Share of the backward step, η.
    share: f64,
    dt: f64,
}

impl Swing {
    fn new(exact: Oscillator, from: OscillatorState, share: f64, dt: f64) -> Swing {
        let Oscillator { mass, stiffness, force } = exact;
        let pull = force - stiffness * from.position;
        let velocity = (mass * from.velocity + dt * pull) / (mass + stiffness * dt * dt);
        let balanced = OscillatorState { position: from.position + velocity * dt, velocity };
        Swing { exact, from, balanced, share, dt }
    }

    /// After `time` seconds of the step.
    fn after(&self, time: f64) -> OscillatorState {
        let mix = |exact: f64, balanced: f64| exact + self.share * (balanced - exact);
        let exact = self.exact.advance(self.from, time);
        let there = self.from.position + self.balanced.velocity * time;
        OscillatorState {
            position: mix(exact.position, there),
            velocity: mix(exact.velocity, self.balanced.velocity),
        }
    }

    /// The acceleration that decides which law applies, m/s².
    fn acceleration(&self) -> f64 {
        let Oscillator { mass, stiffness, force } = self.exact;
        let first = (force - stiffness * self.from.position) / mass;
        first + self.share * ((self.balanced.velocity - self.from.velocity) / self.dt - first)
    }
}

impl SpringWall {
    /// Advances by `dt` seconds under the water's force F = `force` - `added_mass` · a, the mean
    /// over the step. The motion is (1 - η) times the exact one plus η times Euler's backward step.
    /// ```text
    /// η = κ/(1 + κ),  κ = max(ω²Δt² - 1, 0)/4,  ω² = k/(m + sA)
    /// ```
    /// A step that resolves the spring, ωΔt ≤ 1, has η = 0. A spring that is far too stiff for the
    /// step swings many times in it. Its velocity at the end says nothing of its motion, but the
    /// water goes on with that velocity. In the exact motion nothing damps this swing. The part of
    /// the water's force that follows the velocity then fed it.
    pub(super) fn advanced(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        let swing = self.swing(force, added_mass, dt);
        let from = swing.from;
        let at_rest_on_stop = from.position <= 0.0 && from.velocity <= 0.0;
        if at_rest_on_stop && swing.exact.force <= 0.0 {
            return WallStep::default();
        }
        let place = |time: f64| swing.after(time).position;
        if let Some(instant) = swing.exact.first_return(place, dt) {
            let velocity = swing.after(instant).velocity;
            return self.stop(0.5 * self.mass * velocity * velocity, -velocity);
        }
        let to = swing.after(dt);
        self.displacement = to.position;
        self.velocity = to.velocity;
        WallStep {
            acceleration: (to.velocity - from.velocity) / dt,
            travel: to.position - from.position,
            ..WallStep::default()
        }
    }

    /// The motion over a step. While the force is above the threshold, the wall is driven with the
    /// water's added mass; otherwise it moves alone. The law is monotone in a. So exactly one of
    /// the two is consistent with the force that results from it.
    fn swing(&self, force: f64, added_mass: f64, dt: f64) -> Swing {
        let SpringWall { mass, stiffness, threshold, force_coupling: s, .. } = *self;
        let turned = stiffness * dt * dt / (mass + s * added_mass);
        let unresolved = 0.25 * (turned - 1.0).max(0.0);
        let share = unresolved / (1.0 + unresolved);
        let from = OscillatorState { position: self.displacement, velocity: self.velocity };
        let of = |oscillator| Swing::new(oscillator, from, share, dt);
        let excess = s * (force - threshold);
        let driven = of(Oscillator { mass: mass + s * added_mass, stiffness, force: excess });
        if force - added_mass * driven.acceleration() > threshold {
            driven
        } else {
            of(Oscillator { mass, stiffness, force: 0.0 })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::WallLaw;

    #[test]
    fn a_constant_push_follows_the_exact_oscillator() {
        for (mass, stiffness, dt) in [(50.0, 1e5, 9e-4), (1.0, 1e6, 9e-4), (250.0, 500.0, 1e-3)] {
            let mut wall = SpringWall::at_rest(mass, stiffness, 200.0, 1.0);
            let exact = Oscillator { mass, stiffness, force: 100.0 };
            for step in 1..=50 {
                wall.advance(300.0, 0.0, dt);
                let from = OscillatorState { position: 0.0, velocity: 0.0 };
                let expected = exact.advance(from, dt * f64::from(step));
                assert!((wall.displacement - expected.position).abs() < 1e-9 * 100.0 / stiffness);
            }
            assert_eq!(wall.stops, 0);
        }
    }

    #[test]
    fn a_spring_too_stiff_for_the_step_takes_its_place() {
        for (mass, stiffness, dt) in [(50.0, 1e9, 9e-4), (1.0, 1e7, 9e-4), (0.1, 1e7, 6e-3)] {
            let mut wall = SpringWall::at_rest(mass, stiffness, 200.0, 1.0);
            let place = 100.0 / stiffness;
            let mut swing = 2.0;
            for _ in 0..40 {
                wall.advance(300.0, 0.0, dt);
                // Energy of the swing about the balance of spring and force, over that at the
                // start.
                let (off, speed) = (wall.displacement / place - 1.0, wall.velocity / place);
                let left = off * off + mass / stiffness * speed * speed;
                assert!(left < swing || left < 1e-20, "{mass} {stiffness}: {left}");
                swing = left;
            }
            assert!(swing < 1e-4, "{mass} {stiffness}: {swing}");
            assert_eq!(wall.stops, 0);
        }
    }

    #[test]
    fn a_force_that_follows_the_velocity_feeds_no_swing() {
        // The force's change over a step is a tenth of that by the water's mass.
        for turned in [3.2, 4.2, 5.3, 7.0, 11.0] {
            for sign in [-0.1, 0.1] {
                let (carried, dt) = (20.0, 6.4e-3);
                let stiffness = carried * turned * turned / (dt * dt);
                let mut wall = SpringWall::at_rest(1e-3, stiffness, 200.0, 1.0);
                wall.displacement = 101.0 / stiffness;
                for _ in 0..200 {
                    let follows = sign * carried / dt * wall.velocity;
                    wall.advance(300.0 + follows, carried, dt);
                }
                let off = wall.displacement * stiffness / 100.0 - 1.0;
                assert!(off.abs() < 1e-3, "{turned} {sign}: {off}");
            }
        }
    }
}
