//! The wall's displacement for maxima: without the effect of the water's sound.
//!
//! Sound ([`super::sound`]) pushes a wall as any force does. To first order the displacement x is:
//! ```text
//! (m + m_a) x'' + b x' + k x = ΔF,   m_a = 0.543 ρ d²,   ω² = k/(m + m_a)
//! ```
//! d is the depth at the wall. m_a is the water that the wall carries with it
//! ([`wall_potential`](crate::theory::wall_potential)). b x' is the force of the wave that the wall
//! makes as it swings with ω ([`damping`](crate::theory::wavemaker::damping)). It is ρ d √(g d) for
//! a slow wall and nearly zero for a fast one.
//!
//! ΔF comes from the slope of the compression. This slope must be that over a time shorter than the
//! wall's period. A wall that swings faster than sound between bed and surface, c/(4d), follows the
//! force, and is treated like the force.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::quiet_force::Push;
use crate::body::Restraint;
use crate::theory::wall_potential::CARRIED;
use crate::theory::wavemaker::damping;

/// Memory reserved for this many samples.
const ROOM: usize = 256;
/// A wall whose frequency is this many times that of sound follows the force.
const FOLLOWS: f64 = 1.5;

/// The wall's mass and spring, over ½ρgh² of force and h of displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mount {
    /// m h/(½ρgh²), s².
    mass: f64,
    /// k h/(½ρgh²).
    stiffness: f64,
    /// h, m.
    depth: f64,
    /// √(h/g), s.
    unit_time: f64,
    /// 4 h/c0, s.
    sound_period: f64,
}

impl Mount {
    /// For a wall in still water of this depth, m, under this gravity, m/s². Still water presses it
    /// with `static_force`, N/m, and the speed of sound is `sound_speed`, m/s. None if nothing
    /// drives the wall back.
    pub fn new(
        held: &Restraint,
        depth: f64,
        gravity: f64,
        static_force: f64,
        sound_speed: f64,
    ) -> Option<Mount> {
        let scale = depth / static_force;
        let mount = Mount {
            mass: held.mass * scale,
            stiffness: held.stiffness * scale,
            depth,
            unit_time: (depth / gravity).sqrt(),
            sound_period: 4.0 * depth / sound_speed,
        };
        (held.stiffness > 0.0).then_some(mount)
    }

    /// Advances x and x' by `dt` seconds by the implicit midpoint rule, which is stable for any
    /// stiffness. If the sound is not known, the depth is that at rest.
    fn advance(&self, [x, v]: [f64; 2], push: Push, dt: f64) -> [f64; 2] {
        let deep = push.depth.map_or(1.0, |depth| depth / self.depth);
        let mass = self.mass + 2.0 * CARRIED * (deep * self.unit_time).powi(2);
        let swing = self.stiffness / mass;
        let taken = damping(swing * deep * self.unit_time * self.unit_time);
        let damping = 2.0 * libm::pow(deep, 1.5) * self.unit_time * taken;
        let resists = mass + 0.5 * dt * (damping + 0.5 * dt * self.stiffness);
        let force = self.heard(push, deep * swing.sqrt() / TAU);
        let rate = (force - damping * v - self.stiffness * (x + 0.5 * dt * v)) / resists;
        [x + dt * (v + 0.5 * dt * rate), v + dt * rate]
    }

    /// The force of sound on a wall with this frequency, 1/s, times d/h.
    fn heard(&self, push: Push, swings: f64) -> f64 {
        let faster = swings * self.sound_period;
        let follows = ((faster - 1.0) / (FOLLOWS - 1.0)).clamp(0.0, 1.0);
        push.swift + follows * (push.force - push.swift)
    }
}

/// A sample of the wall's displacement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Sample {
    time: f64,
    displacement: f64,
}

/// Keeps the last samples until the sound at their time is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct QuietTravel {
    waiting: VecDeque<Sample>,
    /// The part of X* that comes from sound, and its rate, 1/s.
    added: [f64; 2],
    /// Time up to which it is known, s.
    since: f64,
}

impl QuietTravel {
    /// For a wall on its stop.
    pub fn new() -> QuietTravel {
        QuietTravel { waiting: VecDeque::with_capacity(ROOM), added: [0.0; 2], since: 0.0 }
    }

    /// Takes X* at a time, s.
    pub fn push(&mut self, time: f64, displacement: f64) {
        self.waiting.push_back(Sample { time, displacement });
    }

    /// The next sample no later than `until`, s: its time, and X* without the part from sound.
    /// `sound` is the push until then. A stop sets that part to zero.
    pub fn next(&mut self, until: f64, sound: Push, mount: Option<Mount>) -> Option<(f64, f64)> {
        let sample = *self.waiting.front().filter(|sample| sample.time <= until)?;
        self.waiting.pop_front();
        let dt = sample.time - self.since;
        self.since = sample.time;
        self.added = match mount {
            Some(mount) if sample.displacement > 0.0 => mount.advance(self.added, sound, dt),
            _ => [0.0; 2],
        };
        Some((sample.time, sample.displacement - self.added[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTH: f64 = 0.2;
    const GRAVITY: f64 = 9.81;
    const SOUND_SPEED: f64 = 14.0;

    fn mount(mass: f64, stiffness: f64) -> Mount {
        let held = Restraint { threshold: 0.0, mass, stiffness };
        let still = 0.5 * 1000.0 * GRAVITY * DEPTH * DEPTH;
        Mount::new(&held, DEPTH, GRAVITY, still, SOUND_SPEED).unwrap()
    }

    fn push(force: f64) -> Push {
        Push { force, swift: force, depth: Some(0.3) }
    }

    /// Largest X* without sound, of a wall that follows F* - 1 = bell + sound by its spring.
    fn farthest(stiffness: f64, loudness: f64) -> f64 {
        let (mount, dt) = (mount(50.0, stiffness), 0.001);
        let bell = |t: f64| (-((t - 0.5) / 0.1).powi(2)).exp();
        let (mut quiet, mut told, mut state) = (QuietTravel::new(), 0.0_f64, [0.0; 2]);
        for k in 1..1000 {
            let (now, until) = (dt * f64::from(k), dt * f64::from(k - 30));
            state = mount.advance(state, push(bell(now) * (1.0 + loudness)), dt);
            quiet.push(now, state[0].max(0.0));
            while let Some((_, x)) = quiet.next(until, push(loudness * bell(until)), Some(mount)) {
                told = told.max(x);
            }
        }
        told
    }

    #[test]
    fn what_sound_adds_is_taken_off() {
        for stiffness in [500.0, 1e4, 1e5, 1e7] {
            let (loud, still) = (farthest(stiffness, 0.05), farthest(stiffness, 0.0));
            assert!((loud / still - 1.0).abs() < 2e-3, "{stiffness}: {loud} {still}");
        }
    }

    /// As the exact damped oscillator, in water at rest depth. Fast walls make no wave.
    #[test]
    fn it_swings_as_its_spring_mass_and_water_say() {
        for (stiffness, least, most) in [(2000.0, 0.2, 0.5), (1e6, 0.9999, 1.0)] {
            let wall = mount(50.0, stiffness);
            let mass = 50.0 + CARRIED * 1000.0 * DEPTH * DEPTH;
            let frequency = (stiffness / mass).sqrt();
            let steps = 200;
            let dt = std::f64::consts::PI / frequency / f64::from(steps);
            let mut state = [1e-3, 0.0];
            for _ in 0..steps {
                state = wall.advance(state, Push::default(), dt);
            }
            let slow = 1000.0 * DEPTH * (GRAVITY * DEPTH).sqrt();
            let taken = slow * damping(frequency * frequency * DEPTH / GRAVITY) / mass;
            let (fades, time) = (0.5 * taken, std::f64::consts::PI / frequency);
            let swings = (frequency * frequency - fades * fades).sqrt();
            let (sin, cos) = (swings * time).sin_cos();
            let left = -(-fades * time).exp() * (cos + fades / swings * sin);
            let told = state[0] / -1e-3;
            assert!((told - left).abs() < 1e-3, "{stiffness}: {told} {left}");
            assert!((least..=most).contains(&told), "{stiffness}: {told}");
        }
    }

    #[test]
    fn walls_slower_than_sound_hear_it_and_faster_ones_follow_the_force() {
        let push = Push { force: 1.0, swift: 3.0, depth: Some(DEPTH) };
        for (stiffness, heard) in [(1e3, 3.0), (5e5, 3.0), (1e7, 1.0)] {
            let rest = mount(50.0, stiffness).advance([0.0; 2], push, 1e-6);
            let told = mount(50.0, stiffness).advance([0.0; 2], Push { swift: 1.0, ..push }, 1e-6);
            assert!((rest[0] / told[0] - heard).abs() < 0.05, "{stiffness}: {rest:?} {told:?}");
        }
    }

    #[test]
    fn a_stop_takes_what_sound_has_added_and_free_walls_are_left_alone() {
        let mut quiet = QuietTravel::new();
        for (time, x) in [(0.1, 0.01), (0.2, 0.0), (0.3, 0.01)] {
            quiet.push(time, x);
        }
        let wall = Some(mount(50.0, 1e5));
        assert!(quiet.next(0.1, push(1.0), wall).unwrap().1 < 0.01);
        assert_eq!(quiet.next(0.2, push(1.0), wall), Some((0.2, 0.0)));
        assert_eq!(quiet.next(0.2, push(1.0), wall), None);
        assert_eq!(quiet.next(0.3, push(1.0), None), Some((0.3, 0.01)));
        let held = Restraint { threshold: 0.0, mass: 50.0, stiffness: 0.0 };
        assert!(Mount::new(&held, DEPTH, GRAVITY, 196.0, SOUND_SPEED).is_none());
    }
}
