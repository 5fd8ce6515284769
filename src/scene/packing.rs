//! Moves particles before a leaning wall or over an uneven bed, so that they and the ghosts fill
//! space evenly.

use super::squares::Squares;
use crate::body::Place;
use crate::boundary::{Ghosts, Plane, Profile};
use crate::kernel::KernelChoice;

/// Number of rounds. Each removes about a tenth of the longest unevenness within reach.
const ROUNDS: usize = 200;
/// τ of a round. It is stable below 2 over the largest eigenvalue of R² Σ V ∇∇W, which is about 17.
const STEP: f64 = 0.05;
/// Particles within this many support radii of the wall move.
const REACH: f64 = 2.0;
/// Entries of the table of slopes.
const ENTRIES: usize = 1024;

/// A face whose ghosts do not continue the water's lattice.
pub(super) enum Uneven<'a> {
    /// A leaning wall.
    Wall(Plane),
    /// A bed, from where it stops being level.
    Bed(&'a Profile),
}

impl Uneven<'_> {
    /// Whether a place is nearer to the face than `room`, metres, or behind it.
    fn is_near(&self, place: [f64; 2], room: f64) -> bool {
        match self {
            Uneven::Wall(wall) => wall.beyond(place) > -room,
            Uneven::Bed(bed) => place[0] > bed.level_up_to() - room && bed.nearest(place).1 > -room,
        }
    }
}

/// The inputs of packing.
pub(super) struct Packing<'a> {
    pub kernel: KernelChoice,
    /// Support radius, metres.
    pub support_radius: f64,
    /// Particle spacing, metres.
    pub spacing: f64,
    /// The face along which the lattices do not fit.
    pub face: Uneven<'a>,
    pub ghosts: &'a Ghosts,
    /// Particles above this height do not move: they represent water that goes on.
    pub held_above: f64,
}

/// A particle that moves, and the others that may come in reach of it.
struct Mover {
    number: usize,
    water: Vec<u32>,
    solid: Vec<u32>,
}

impl Packing<'_> {
    /// Moves particles (x, y, volume) by δr = -τ R² Σ V_j ∇_iW_ij, round after round: the packing
    /// of Colagrossi et al. 2012. Level rows and the ghosts of a leaning wall are lattices of
    /// different directions. Without packing they press unevenly on the water between them, until
    /// it has crept to an even place.
    pub(super) fn pack(&self, particles: &mut [[f64; 3]]) {
        let volumes: Vec<f64> = (0..self.ghosts.len()).map(|g| self.volume(g)).collect();
        let movers = self.movers(particles, &volumes);
        let slopes: Vec<f64> =
            (0..=ENTRIES).map(|k| self.kernel.slope_at(k as f64 / ENTRIES as f64)).collect();
        // C/R³ of the gradient times τ R², per place over R.
        let factor = STEP * self.kernel.normalisation() / self.support_radius;
        let mut moves = vec![[0.0; 2]; movers.len()];
        for _ in 0..ROUNDS {
            for (mover, step) in movers.iter().zip(&mut moves) {
                let place = particles[mover.number];
                let mut sum = [0.0; 2];
                for &j in &mover.water {
                    self.add(&slopes, place, particles[j as usize], &mut sum);
                }
                for &g in &mover.solid {
                    let g = g as usize;
                    let ghost = [self.ghosts.x[g], self.ghosts.y[g], volumes[g]];
                    self.add(&slopes, place, ghost, &mut sum);
                }
                *step = sum.map(|part| -factor * part);
            }
            for (mover, [x, y]) in movers.iter().zip(&moves) {
                let place = &mut particles[mover.number];
                place[0] += x;
                place[1] += y;
            }
        }
    }

    /// Adds V_j w'(q) (r_i - r_j)/|r_i - r_j|.
    fn add(&self, slopes: &[f64], here: [f64; 3], other: [f64; 3], sum: &mut [f64; 2]) {
        let apart = [here[0] - other[0], here[1] - other[1]];
        let distance = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
        let at = distance / self.support_radius * ENTRIES as f64;
        if at < ENTRIES as f64 && distance > 0.0 {
            let k = at as usize;
            let part = at - k as f64; // `fract` is a call
            let slope = slopes[k] + part * (slopes[k + 1] - slopes[k]);
            let weight = other[2] * slope / distance;
            sum[0] += weight * apart[0];
            sum[1] += weight * apart[1];
        }
    }

    /// Volume of a ghost. Of a level bed that goes on beneath the wall only the part before the
    /// wall counts; the wall's corner block takes the place of the rest. A column of the bed may
    /// lie on both sides.
    fn volume(&self, g: usize) -> f64 {
        let [bed, wall] =
            [Place::Bed, Place::Right].map(|place| &self.ghosts.bodies[place.number()]);
        let goes_on = matches!(self.face, Uneven::Bed(bed) if bed.ends_level());
        let volume = self.ghosts.volume[g];
        if goes_on && bed.ghosts.contains(&g) {
            let before = (wall.plane.point[0] - self.ghosts.x[g]) / self.spacing;
            volume * (0.5 + before).clamp(0.0, 1.0)
        } else {
            volume
        }
    }

    fn movers(&self, particles: &[[f64; 3]], volumes: &[f64]) -> Vec<Mover> {
        let (reach, slack) = (self.support_radius + self.spacing, REACH * self.support_radius);
        let near = |place: &[f64; 3], room: f64| self.face.is_near([place[0], place[1]], room);
        let around: Vec<u32> = (0..particles.len() as u32)
            .filter(|&j| near(&particles[j as usize], slack + reach))
            .collect();
        let ghosts = self.ghosts;
        let solid = (0..ghosts.len() as u32).filter_map(|g| {
            let [x, y] = [&ghosts.x, &ghosts.y].map(|places| places[g as usize]);
            let counts = volumes[g as usize] > 0.0 && near(&[x, y, 0.0], slack + reach);
            counts.then_some((g, [x, y]))
        });
        let solid = Squares::new(reach, solid);
        let place = |number: u32| {
            let [x, y, _] = particles[number as usize];
            [x, y]
        };
        let water = Squares::new(reach, around.iter().map(|&j| (j, place(j))));
        around
            .iter()
            .filter(|&&number| near(&particles[number as usize], slack))
            .filter(|&&number| particles[number as usize][1] < self.held_above)
            .map(|&number| {
                let here = place(number);
                let mut water = water.near(here);
                water.retain(|&other| other != number);
                Mover { number: number as usize, water, solid: solid.near(here) }
            })
            .collect()
    }
}
