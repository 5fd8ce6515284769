//! Passes over all particles, eight at a time, part by part.

use std::ops::Range;

use super::around::{Around, Neighbours};
use super::fields::Here;
use super::held_sums::Held;
use super::lists::Pairs;
use super::parts::Part;
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::math::team::Rows;

/// An equation with terms of all pairs, which writes rows `R`.
pub trait Equation<R>: Sync {
    /// Sums its terms over the neighbours of eight particles, and writes the results.
    fn at<D: Lanes>(&self, here: Here, around: &mut Around<'_>, rows: &mut R);
}

/// An equation with terms of held pairs.
pub trait HeldEquation<R>: Sync {
    /// Whether pairs are counted as those of forces; otherwise as those of the flow.
    const FORCES: bool;
    /// Sums its terms over the pairs of eight particles, and writes the results.
    fn at<D: Lanes>(&self, here: Here, held: &mut Held<'_, '_>, rows: &mut R);
}

/// Work that is done particle by particle.
pub trait Each<R>: Sync {
    /// Writes the results of eight particles.
    fn at<D: Lanes>(&self, here: Here, rows: &mut R);
}

/// Work that is done particle by particle, with a sum over all.
pub trait Summed<R>: Sync {
    /// Writes the results of eight particles; returns their contribution to the sum.
    fn at<D: Lanes>(&self, here: Here, rows: &mut R) -> D;
}

struct Adding<'a, E, R> {
    work: &'a E,
    part: &'a mut Part,
    rows: R,
}

impl<R, E: Summed<R>> Task for Adding<'_, E, R> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Part { clusters, tally, .. } = self.part;
        tally.added.clear();
        for (list, cluster) in clusters.clone().enumerate() {
            let added = self.work.at::<L>(Here::new(cluster, list), &mut self.rows);
            tally.added.push(added.to_array());
        }
    }
}

/// The sum over all parts, lane by lane in the order of the clusters.
struct Total<'a>(&'a [Part]);

impl Task for Total<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let mut sum = L::splat(0.0);
        for part in self.0 {
            for added in &part.tally.added {
                sum += L::load(added);
            }
        }
        sum.sum()
    }
}

struct OverAll<'a, E, R> {
    work: &'a E,
    clusters: Range<usize>,
    rows: R,
}

impl<R, E: Each<R>> Task for OverAll<'_, E, R> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        for (list, cluster) in self.clusters.enumerate() {
            self.work.at::<L>(Here::new(cluster, list), &mut self.rows);
        }
    }
}

struct InTurn<'a, E, R> {
    work: &'a E,
    clusters: Range<usize>,
    rows: R,
}

impl<R, E: Summed<R>> Task for InTurn<'_, E, R> {
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> f64 {
        let mut sum = L::splat(0.0);
        for cluster in self.clusters {
            sum += self.work.at::<L>(Here::new(cluster, cluster), &mut self.rows);
        }
        sum.sum()
    }
}

/// Goes through this many particles on one thread; returns the sum.
pub fn sum_in_turn<R>(path: SimdPath, particles: usize, rows: R, work: &impl Summed<R>) -> f64 {
    dispatch(path, InTurn { work, clusters: 0..particles.div_ceil(LANES), rows })
}

impl Pairs {
    /// Goes through all particles.
    pub fn each<R: Rows>(&mut self, rows: R, work: &impl Each<R>) {
        let path = self.path;
        self.team.share(&mut self.parts, rows, &|part, rows| {
            let clusters = part.clusters.clone();
            dispatch(path, OverAll { work, clusters, rows });
        });
    }

    /// Goes through all particles; returns the sum.
    pub fn sum_each<R: Rows>(&mut self, rows: R, work: &impl Summed<R>) -> f64 {
        let path = self.path;
        self.team.share(&mut self.parts, rows, &|part, rows| {
            dispatch(path, Adding { work, part, rows });
        });
        dispatch(path, Total(&self.parts))
    }

    /// Goes through all particles with an equation, and holds the geometry of their pairs.
    pub fn full_pass<R: Rows>(
        &mut self,
        neighbours: &Neighbours<'_>,
        rows: R,
        equation: &impl Equation<R>,
    ) {
        let path = self.path;
        self.team.share(&mut self.parts, rows, &|part, rows| {
            dispatch(path, Full { equation, part, neighbours, rows });
        });
    }

    /// Goes through all particles with an equation over held pairs.
    pub fn held_pass<R: Rows>(&mut self, rows: R, equation: &impl HeldEquation<R>) {
        let path = self.path;
        self.team.share(&mut self.parts, rows, &|part, rows| {
            dispatch(path, OverHeld { equation, part, rows });
        });
    }
}

struct Full<'a, E, R> {
    equation: &'a E,
    part: &'a mut Part,
    neighbours: &'a Neighbours<'a>,
    rows: R,
}

impl<R, E: Equation<R>> Task for Full<'_, E, R> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Part { clusters, pairs, held, near, tally } = self.part;
        held.restart(self.neighbours.bodies + 1);
        near.clear();
        tally.clear();
        tally.responding.clear();
        tally.force_entries += pairs.len();
        for (list, cluster) in clusters.clone().enumerate() {
            let (here, neighbours) = (Here::new(cluster, list), self.neighbours);
            let mut around = Around {
                neighbours,
                pairs,
                held: &mut *held,
                near: &mut *near,
                tally: &mut *tally,
                here,
            };
            self.equation.at::<L>(here, &mut around, &mut self.rows);
        }
    }
}

struct OverHeld<'a, E, R> {
    equation: &'a E,
    part: &'a mut Part,
    rows: R,
}

impl<R, E: HeldEquation<R>> Task for OverHeld<'_, E, R> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(mut self) {
        let Part { clusters, held: pairs, near, tally, .. } = self.part;
        if E::FORCES {
            tally.clear();
            tally.force_entries += pairs.len();
        } else {
            tally.powers.clear();
            tally.flow_entries += pairs.len();
        }
        let mut near = near.iter();
        for (list, cluster) in clusters.clone().enumerate() {
            let here = Here::new(cluster, list);
            let mut held = Held { pairs, near: &mut near, tally: &mut *tally, here };
            self.equation.at::<L>(here, &mut held, &mut self.rows);
        }
    }
}
