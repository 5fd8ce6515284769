//! The water's pairs: its neighbour lists, when they are out of date, and how they are made.

use std::mem::take;

use super::fluid::{Fluid, reorder};
use super::pair_list::PointSet;
use super::parts::{Part, Tally, cut};
use super::strips::Strips;
use super::verlet::{Drift, Reach};
use crate::math::simd::{LANES, SimdPath};
use crate::math::team::Team;

/// Margin of the water's lists, in particle spacings.
const WATER_MARGIN: f64 = 0.4;
/// Margin of the lists that involve ghosts, in particle spacings.
pub const GHOST_MARGIN: f64 = 1.5;
/// Largest number of listed sets: the water, and the ghosts of each body.
const MOST_SETS: usize = 8;

/// The pairs of the water with itself and with ghosts, and the passes over them.
#[derive(Debug, Clone)]
pub struct Pairs {
    /// The instructions of the loops.
    pub path: SimdPath,
    pub(super) team: Team,
    pub(super) parts: Vec<Part>,
    strips: Strips,
    drift: Drift,
    /// x and y of the water where the lists were made, metres.
    reference: [Vec<f64>; 2],
    /// Offsets of the bodies at that time, metres.
    offsets: Vec<f64>,
    /// Kernel's support radius, metres.
    radius: f64,
    /// Particle spacing, metres.
    spacing: f64,
    order: Vec<u32>,
    scratch: Vec<f64>,
    padded: [Vec<f64>; 2],
    rebuilds: u64,
}

impl Pairs {
    /// No lists yet, for a kernel's support radius and a particle spacing, metres.
    pub fn new(path: SimdPath, radius: f64, spacing: f64) -> Pairs {
        Pairs {
            path,
            team: Team::default(),
            parts: Vec::new(),
            strips: Strips::default(),
            drift: Drift::default(),
            reference: Default::default(),
            offsets: Vec::new(),
            radius,
            spacing,
            order: Vec::new(),
            scratch: Vec::new(),
            padded: Default::default(),
            rebuilds: 0,
        }
    }

    /// Sets the team. No lists must have been made yet.
    pub fn take_on(&mut self, team: &Team) {
        assert!(!self.are_listed(), "lists are in the parts of another team");
        self.team = team.clone();
    }

    /// Whether lists have been made.
    pub fn are_listed(&self) -> bool {
        !self.reference[0].is_empty()
    }

    /// The water's strips, and x and y where the lists were made, metres.
    pub fn sorted(&self) -> (&Strips, &[f64], &[f64]) {
        (&self.strips, &self.reference[0], &self.reference[1])
    }

    /// Distance up to which ghosts are listed, metres.
    pub fn ghost_reach(&self) -> f64 {
        self.radius + GHOST_MARGIN * self.spacing
    }

    /// How often lists have been made.
    pub fn rebuilds(&self) -> u64 {
        self.rebuilds
    }

    /// The data that give the same lists again: x and y of the water where they were made, and the
    /// offsets of the bodies then, metres.
    pub fn reference(&self) -> ([&[f64]; 2], &[f64]) {
        ([&self.reference[0], &self.reference[1]], &self.offsets)
    }

    /// Goes back to stored data. The lists must then be made again.
    pub fn restore(&mut self, reference: [Vec<f64>; 2], offsets: Vec<f64>, rebuilds: u64) {
        (self.reference, self.offsets, self.rebuilds) = (reference, offsets, rebuilds);
        let [x, y] = &self.reference;
        self.strips = Strips::of_sorted(x, y, Strips::width(self.spacing));
    }

    /// Whether a pair may have come into reach unseen, with the water at these places and these
    /// offsets of the bodies.
    pub fn are_worn(&mut self, places: [&[f64]; 2], offsets: impl Iterator<Item = f64>) -> bool {
        if !self.are_listed() {
            return true;
        }
        let reach = Reach { radius: self.radius, margin: WATER_MARGIN * self.spacing };
        let [x, y] = &self.reference;
        let (met, farthest) = self.drift.measure(places, [x, y], reach);
        let moved = offsets.zip(&self.offsets).map(|(new, old)| (new - old).abs());
        let near = farthest + moved.fold(0.0, f64::max) < GHOST_MARGIN * self.spacing;
        // So NaN counts as out of date.
        met || !near
    }

    /// Sorts the water again, together with its particles' fields and fields of two numbers each.
    pub fn sort<'a>(
        &mut self,
        fluid: &mut Fluid,
        fields: impl IntoIterator<Item = &'a mut Vec<f64>>,
        doubles: &mut [[f64; 2]],
        offsets: impl Iterator<Item = f64>,
    ) {
        self.rebuilds += 1;
        let n = fluid.len();
        let Pairs { strips, order, scratch, reference: [x, y], .. } = self;
        let width = Strips::width(self.spacing);
        strips.renew(&fluid.x[..n], &fluid.y[..n], &fluid.id[..n], width, order);
        fluid.reorder(order, scratch);
        for field in fields {
            reorder(&mut field[..n], order, scratch);
        }
        for part in 0..2 {
            scratch.clear();
            scratch.extend(order.iter().map(|&from| doubles[from as usize][part]));
            for (numbers, value) in doubles.iter_mut().zip(&*scratch) {
                numbers[part] = *value;
            }
        }
        for (reference, places) in [(x, &fluid.x), (y, &fluid.y)] {
            reference.clear();
            reference.extend_from_slice(&places[..n]);
        }
        self.offsets.clear();
        self.offsets.extend(offsets);
    }

    /// Lists the neighbours where the water was sorted: water and ghosts. The ghosts' sets come
    /// without offset and reach.
    pub fn list<'a>(&mut self, ghosts: impl Iterator<Item = PointSet<'a>>) {
        let reach = self.ghost_reach();
        let Pairs { path, team, parts, strips, drift, reference: [x, y], offsets, .. } = self;
        let water = PointSet {
            strips,
            x,
            y,
            offset: 0.0,
            first: 0,
            reach: self.radius + WATER_MARGIN * self.spacing,
            bounds: PointSet::EVERYWHERE,
        };
        drift.divide(strips, Strips::width(self.spacing), y, self.radius);
        let mut sets = [water; MOST_SETS];
        let mut count = 1;
        for ((set, ghosts), &offset) in sets[1..].iter_mut().zip(ghosts).zip(&*offsets) {
            *set = PointSet { offset, reach, ..ghosts };
            count += 1;
        }
        let n = x.len();
        let padded = n.next_multiple_of(LANES);
        for (padded_places, places) in self.padded.iter_mut().zip([&*x, &*y]) {
            padded_places.clear();
            padded_places.extend_from_slice(places);
            padded_places.resize(padded, places[n - 1]);
        }
        cut(parts, padded / LANES, team);
        let (path, [x, y], sets) = (*path, &self.padded, &sets[..count]);
        team.share(parts, (), &|part, ()| part.list(path, [x, y], sets));
    }

    /// The tallies of all parts.
    pub fn tallies(&self) -> impl Iterator<Item = &Tally> {
        self.parts.iter().map(|part| &part.tally)
    }

    /// The number of pairs in passes for forces since the last call.
    pub fn take_force_pairs(&mut self) -> u64 {
        let entries = self.parts.iter_mut().map(|part| take(&mut part.tally.force_entries));
        (LANES * entries.sum::<usize>()) as u64
    }

    /// The same for passes for the flow.
    pub fn take_flow_pairs(&mut self) -> u64 {
        let entries = self.parts.iter_mut().map(|part| take(&mut part.tally.flow_entries));
        (LANES * entries.sum::<usize>()) as u64
    }

    /// The sum of all powers, W per metre of width.
    pub fn power(&self) -> f64 {
        self.tallies().flat_map(|tally| &tally.powers).fold(0.0, |sum, power| sum + power)
    }
}
