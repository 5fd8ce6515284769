//! The share of a kernel's support that bed and walls leave open.

use super::ghosts::Ghosts;
use super::plane::Plane;
use super::profile::Profile;
use super::rules::ExchangeRules;
use crate::body::Place;
use crate::kernel::KernelChoice;

const DIRECTIONS: usize = 96;
const RINGS: usize = 48;

/// The open part around a bed that is not level, with its walls at rest.
pub(super) struct Open<'a> {
    profile: &'a Profile,
    walls: Vec<Plane>,
    /// Points of a disc, metres, and their shares of the kernel.
    disc: Vec<[f64; 3]>,
}

impl<'a> Open<'a> {
    pub(super) fn of(rules: &ExchangeRules, profile: &'a Profile, ghosts: &Ghosts) -> Open<'a> {
        // A wall with a crest is part of the outline.
        let walls = if ghosts.crest.is_some() { 1 } else { ghosts.bodies.len() - 1 };
        Open::within(rules, profile, ghosts, walls)
    }

    /// The same for an endless wall, even if the wall has a crest.
    pub(super) fn of_endless(rules: &ExchangeRules, bed: &'a Profile, ghosts: &Ghosts) -> Open<'a> {
        Open::within(rules, bed, ghosts, Place::Right.number())
    }

    /// With only this many walls.
    fn within(
        rules: &ExchangeRules,
        profile: &'a Profile,
        ghosts: &Ghosts,
        walls: usize,
    ) -> Open<'a> {
        let walls = ghosts.bodies[1..].iter().take(walls).map(|body| body.plane).collect();
        Open { profile, walls, disc: disc(rules.kernel, rules.scaling.support_radius) }
    }

    /// The share of the kernel around a point that is open.
    pub(super) fn share(&self, [x, y]: [f64; 2]) -> f64 {
        let is_open = |&&[dx, dy, _]: &&[f64; 3]| {
            let place = [x + dx, y + dy];
            place[1] >= self.profile.height(place[0])
                && self.walls.iter().all(|wall| wall.beyond(place) <= 0.0)
        };
        self.disc.iter().filter(is_open).map(|[_, _, share]| share).sum()
    }
}

fn disc(kernel: KernelChoice, radius: f64) -> Vec<[f64; 3]> {
    let ring = |k: usize| (k as f64 + 0.5) / RINGS as f64;
    let mass: f64 = (0..RINGS).map(|k| kernel.shape_at(ring(k)) * ring(k)).sum();
    let place = |k: usize, n: usize| {
        // Rings are turned by half a direction against each other, so that a straight face does not
        // cut along a ray.
        let angle =
            std::f64::consts::TAU * (n as f64 + 0.5 * (k % 2) as f64 + 0.25) / DIRECTIONS as f64;
        let share = kernel.shape_at(ring(k)) * ring(k) / (mass * DIRECTIONS as f64);
        [radius * ring(k) * libm::cos(angle), radius * ring(k) * libm::sin(angle), share]
    };
    (0..RINGS).flat_map(|k| (0..DIRECTIONS).map(move |n| place(k, n))).collect()
}
