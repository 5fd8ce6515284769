//! The wall's step with kicks: the water's force is known at the step's start.

use super::{SpringWall, WallLaw, WallStep};

impl SpringWall {
    /// Advances by `dt` seconds under the water's force F = `force` - `added_mass` · a at the
    /// step's start. X is that of the same instant. V is the mean velocity over the step before,
    /// half a step earlier, as for water with kick and drift:
    /// ```text
    /// m a = s max(F - F_th, 0) - k X̄,  X̄ = X + η V Δt + β a Δt²,  β = (1 + η)²/4
    /// V⁺ = V + a Δt,  X⁺ = X + V⁺ Δt,  η = κ/(1 + κ),  κ = k Δt²/(4 (m + sA))
    /// ```
    /// This is Newmark's family (1959) with γ = ½ + η, written for three instants:
    /// X̄ = βX⁺ + (½ - 2β + γ)X + (½ + β - γ)X⁻. If the step resolves the spring, η vanishes. X̄ is
    /// then the mean (X⁺ + 2X + X⁻)/4, which neither adds nor removes energy. A spring that is far
    /// too stiff for the step moves to the balance of the force: η = 1, X̄ = X⁺.
    ///
    /// Force and velocity must alternate as those of the water do. Over a step the water before the
    /// wall acts as another spring, of stiffness K. If its force were held while the wall moves
    /// exactly, each step would multiply the swing's energy by 1 + ½KΔt²/m. Light walls would ring.
    pub(super) fn kicked(&mut self, force: f64, added_mass: f64, dt: f64) -> WallStep {
        if self.displacement <= 0.0 && self.velocity <= 0.0 && force <= self.threshold {
            return WallStep::default();
        }
        let acceleration = self.acceleration(force, added_mass, dt);
        let velocity = self.velocity + acceleration * dt;
        if self.displacement + velocity * dt < 0.0 {
            let work = self.force_coupling * (force - self.threshold).max(0.0) * -self.displacement;
            let energy = self.kinetic_energy() + self.spring_energy() + work;
            return self.stop(energy.max(0.0), -velocity);
        }
        self.displacement += velocity * dt;
        self.velocity = velocity;
        WallStep { acceleration, travel: velocity * dt, ..WallStep::default() }
    }

    /// The acceleration at the step's start. The law is monotone in it. So exactly one of two is
    /// consistent with the force that results from it: that of a driven wall, or of a free one.
    fn acceleration(&self, force: f64, added_mass: f64, dt: f64) -> f64 {
        let s = self.force_coupling;
        let unresolved = 0.25 * self.stiffness * dt * dt / (self.mass + s * added_mass);
        let lead = unresolved / (1.0 + unresolved);
        let share = 0.25 * (1.0 + lead) * (1.0 + lead);
        let inertia = self.mass + share * self.stiffness * dt * dt;
        let pull = self.stiffness * (self.displacement + lead * dt * self.velocity);
        let driven = (s * (force - self.threshold) - pull) / (inertia + s * added_mass);
        if force - added_mass * driven > self.threshold { driven } else { -pull / inertia }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theory::oscillator::{Oscillator, OscillatorState};

    fn wall(mass: f64, stiffness: f64) -> SpringWall {
        SpringWall::at_rest(mass, stiffness, 200.0, 1.0)
    }

    /// Largest distance from the exact oscillator over two periods of 2π seconds. It starts at X =
    /// 1, and the force keeps it off its stop.
    fn error(steps: u32) -> f64 {
        let exact = Oscillator { mass: 2.0, stiffness: 2.0, force: 4.0 };
        let from = OscillatorState { position: 1.0, velocity: 0.0 };
        let dt = 4.0 * std::f64::consts::PI / f64::from(steps);
        // Half a step behind.
        let velocity = exact.advance(from, -0.5 * dt).velocity;
        let mut wall = SpringWall { displacement: 1.0, velocity, ..wall(2.0, 2.0) };
        let one = |step: u32| {
            wall.kick(204.0, 0.0, dt);
            (wall.displacement - exact.advance(from, dt * f64::from(step)).position).abs()
        };
        (1..=steps).map(one).fold(0.0, f64::max)
    }

    #[test]
    fn the_exact_oscillator_is_approached_as_the_square_of_the_step() {
        let [coarse, fine, finer] = [100, 200, 400].map(error);
        assert!(coarse < 0.1, "{coarse}");
        assert!((3.8..5.0).contains(&(coarse / fine)), "{coarse} {fine}");
        assert!((3.8..4.5).contains(&(fine / finer)), "{fine} {finer}");
    }

    #[test]
    fn a_wall_without_spring_falls_freely() {
        let (mut wall, dt) = (wall(4.0, 0.0), 0.01);
        // At rest at t = 0.
        wall.velocity = -0.5 * dt * 10.0;
        wall.displacement = 1.0;
        for step in 1..=30 {
            let acceleration = wall.kick(300.0, 6.0, dt).acceleration;
            let time = dt * f64::from(step);
            assert!((acceleration - 10.0).abs() < 1e-12);
            assert!((wall.displacement - 1.0 - 5.0 * time * time).abs() < 1e-12);
        }
    }

    #[test]
    fn a_spring_too_stiff_for_the_step_takes_its_place_at_once() {
        for (mass, stiffness, dt) in [(50.0, 1e9, 2e-3), (1.0, 1e7, 3e-3), (0.1, 1e7, 1e-3)] {
            let (mut wall, place) = (wall(mass, stiffness), 100.0 / stiffness);
            for _ in 0..20 {
                wall.kick(300.0, 0.0, dt);
                assert!((wall.displacement / place - 1.0).abs() < 0.5, "{mass} {stiffness}");
            }
            assert!((wall.displacement / place - 1.0).abs() < 1e-3, "{mass} {stiffness}");
            assert_eq!(wall.stops, 0);
        }
    }

    #[test]
    fn a_wall_comes_onto_its_stop_as_fast_as_it_moves() {
        // A light wall is held back by the water that it carries.
        for (mass, carried) in [(2.0, 0.0), (1e-3, 5.0), (1e-6, 5.0)] {
            let mut wall = SpringWall { displacement: 0.3, ..wall(mass, 8.0) };
            let speed = (0..4000).find_map(|_| {
                let step = wall.kick(200.0, carried, 5e-4);
                (wall.stops > 0).then_some(step.stop_speed)
            });
            let exact = 0.3 * (8.0 / (mass + carried)).sqrt();
            assert!((speed.unwrap() - exact).abs() < 2e-3 * exact, "{mass} {speed:?} {exact}");
        }
    }

    /// A wall at the end of a column of water that only carries sound, in cells with ρ = c0 = Δx =
    /// 1 with kick and drift. Half a cell moves with the wall. Returns the largest velocity after a
    /// push, in the second half of the time that sound takes there and back.
    fn swing_left(
        law: fn(&mut SpringWall, f64, f64, f64) -> WallStep,
        mass: f64,
        stiffness: f64,
    ) -> f64 {
        const CELLS: usize = 400;
        let dt = 0.9;
        let (mut pressure, mut velocity) = ([0.0; CELLS], [0.0; CELLS]);
        // In balance, far from the stop.
        let mut wall = SpringWall { displacement: 1e3 / stiffness, ..wall(mass, stiffness) };
        let mut left = 0.0_f64;
        for step in 0..2 * CELLS {
            let push = if step == 0 { 1.0 } else { 0.0 };
            let travel = law(&mut wall, 1200.0 + push + pressure[CELLS - 1], 0.5, dt).travel;
            for k in 1..CELLS {
                velocity[k] += dt * (pressure[k - 1] - pressure[k]);
            }
            for k in 0..CELLS {
                let out = if k + 1 < CELLS { velocity[k + 1] } else { travel / dt };
                pressure[k] += dt * (velocity[k] - out);
            }
            left = if step < CELLS { 0.0 } else { left.max(wall.velocity.abs()) };
        }
        left
    }

    #[test]
    fn sound_carries_a_light_walls_swing_away() {
        for mass in [1e-3, 0.1, 1.0] {
            for stiffness in [1.0, 10.0, 1e3] {
                let left = swing_left(SpringWall::kick, mass, stiffness);
                assert!(left < 1e-2, "m {mass} k {stiffness}: {left}");
            }
        }
        // If the force is held over the step, the same wall takes energy from the step itself.
        let held = |wall: &mut SpringWall, force: f64, added_mass: f64, dt: f64| {
            let SpringWall { mass, stiffness, threshold, displacement, velocity, .. } = *wall;
            let mass = mass + added_mass;
            let exact = Oscillator { mass, stiffness, force: force - threshold };
            let from = OscillatorState { position: displacement, velocity };
            let to = exact.advance(from, dt);
            (wall.displacement, wall.velocity) = (to.position, to.velocity);
            WallStep { travel: to.position - from.position, ..WallStep::default() }
        };
        assert!(swing_left(held, 0.1, 10.0) > 10.0);
    }
}
