//! The steps of bodies that give their work back to the water: see `giving.rs`.

use super::alongside::Alongside;
use super::exchange::Exchange;
use super::ghosts::Ghosts;
use super::giving::Giving;
use crate::body::{BodyMotion, Place};
use crate::math::simd::{LANES, Lanes, SimdPath, Task, dispatch};
use crate::pairs::{Factors, Flow, Record};

/// Gives back the water that flows into the ghosts of some blocks.
struct GiveBack<'a> {
    exchange: &'a Exchange,
    giving: &'a Giving,
    bodies: &'a [BodyMotion],
    velocities: [&'a [f64]; 2],
    given: &'a mut [f64],
}

impl Task for GiveBack<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let GiveBack { exchange, giving, bodies, velocities: [u, v], given } = self;
        for part in &exchange.parts {
            for &block in part.among(giving.blocks(&exchange.counting)) {
                let (row, image) = (block as usize, &exchange.images[block as usize]);
                let ([along, up], [beside_u, beside_v]) =
                    (giving.fluxes_of(row), giving.beside::<L>(row, bodies));
                let along = run_in(along, u, beside_u);
                let up = run_in(up, v, beside_v);
                // A pressure held at its lower bound is not that of the water.
                let (zero, pressure) = (L::splat(0.0), L::load(&image.pressure));
                let mut flux = along + up;
                if giving.smooth.is_on() {
                    flux = flux - giving.smooth.covered(row, &exchange.means[row]);
                }
                let flux = L::load(&image.lowest).select_less(pressure, flux, zero);
                let flux = flux * L::load(&exchange.scale[row]) * L::splat(giving.share);
                let (entries, weights) = part.held.of(row - part.blocks.start);
                for (&k, weight) in entries.iter().zip(weights) {
                    given[k as usize] += (L::load(weight) * flux).sum();
                }
            }
        }
    }
}

/// Σ_i f_i (u_i - U), with fluxes f and velocities u of the water around eight ghosts.
#[inline(always)]
fn run_in<L: Lanes>(held: (&[u32], &[[f64; LANES]]), velocity: &[f64], beside: L) -> L {
    let of_one = |sum: L, (&i, flux): (&u32, &[f64; LANES])| {
        L::load(flux).mul_add(L::splat(velocity[i as usize]) - beside, sum)
    };
    held.0.iter().zip(held.1).fold(L::splat(0.0), of_one)
}

/// The bed's ghosts as neighbours, with velocities relative to those of water beside a wall.
struct Relative<'a> {
    exchange: &'a Exchange,
    giving: &'a Giving,
    bodies: &'a [BodyMotion],
    flow: Flow,
    factors: &'a mut [Factors],
}

impl Task for Relative<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Relative { exchange, giving, bodies, flow, factors } = self;
        let ((factors, _), zero) = (factors.as_chunks_mut::<LANES>(), L::splat(0.0));
        for &block in giving.blocks(&exchange.counting) {
            let (row, image) = (block as usize, &exchange.images[block as usize]);
            let [u, v] = giving.beside::<L>(row, bodies);
            let velocity = [L::load(&image.velocity[0]) - u, L::load(&image.velocity[1]) - v];
            let place = [L::load(&image.place[0]), L::load(&image.place[1])];
            L::store_records(flow.numbers(velocity, place, [zero, zero]), &mut factors[row]);
        }
    }
}

/// Returns to the water the pushes of the bed's ghosts along the bed.
struct HandBack<'a> {
    exchange: &'a Exchange,
    giving: &'a Giving,
    mass: &'a [f64],
    accelerations: [&'a mut [f64]; 2],
}

impl Task for HandBack<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let HandBack { exchange, giving, mass, accelerations: [along, up] } = self;
        for part in &exchange.parts {
            for &block in part.among(giving.blocks(&exchange.counting)) {
                let (row, image) = (block as usize, &exchange.images[block as usize]);
                let pressure = L::load(&image.pressure) * L::load(&exchange.scale[row]);
                let [push_x, push_y] = giving.smooth.slants::<L>(row).map(|slant| slant * pressure);
                let (entries, weights) = part.held.of(row - part.blocks.start);
                for (&k, weight) in entries.iter().zip(weights) {
                    let (k, weight) = (k as usize, L::load(weight));
                    along[k] += (weight * push_x).sum() / mass[k];
                    up[k] += (weight * push_y).sum() / mass[k];
                }
            }
        }
    }
}

/// The data of a body that gives back, as the water needs it.
pub struct Gives<'a> {
    /// Number of its ghosts among the groups of neighbours.
    pub group: usize,
    /// The share of its work that it gives back.
    pub share: f64,
    /// The velocity of water along the bed beside moving walls.
    pub alongside: Option<&'a Alongside>,
}

impl Exchange {
    /// The bodies that give back their work now.
    pub fn gives(&self) -> impl Iterator<Item = Gives<'_>> {
        self.giving_now().map(|Giving { place, share, alongside, .. }| Gives {
            group: place.number() + 1,
            share: *share,
            alongside: alongside.as_ref(),
        })
    }

    fn giving_now(&self) -> impl Iterator<Item = &Giving> {
        self.giving.iter().filter(|giving| giving.share > 0.0)
    }

    /// Finds the flow of water into the ghosts of bodies that give back, for the steps until the
    /// next full one. The records are those of the water, and of the ghosts alone.
    pub fn find_fluxes(
        &mut self,
        path: SimdPath,
        (ghosts, bodies): (&Ghosts, &[BodyMotion]),
        records: [&[Record]; 2],
    ) {
        let mut all = std::mem::take(&mut self.giving);
        for giving in &mut all {
            giving.share = self.share_given(giving.place, ghosts, records[1]);
            if giving.share > 0.0 {
                let counting = (&*self.counting, &*self.images);
                giving.find(path, &self.rules, (ghosts, bodies), counting, records);
            }
        }
        self.giving = all;
    }

    /// The share that a body gives back. For a wall with a crest it is the share to which water is
    /// at its crest.
    fn share_given(&self, place: Place, ghosts: &Ghosts, records: &[Record]) -> f64 {
        let Some(crest) = ghosts.crest.as_ref().filter(|_| place == Place::Right) else {
            return 1.0;
        };
        let body = &ghosts.bodies[place.number()];
        let on_face = body.faces.clone().filter(|&face| ghosts.target_x[face] <= crest.ends[0]);
        let on_face = on_face.map(|it| [ghosts.target_y[it], self.wet_share(place.number(), it)]);
        let whole = self.rules.scaling.weight_per_volume;
        let on_top = body.ghosts.clone().filter(|&g| ghosts.is_deep(g) && ghosts.volume[g] > 0.0);
        let on_top = on_top.map(|g| records[g].0[Record::WEIGHT] / (ghosts.volume[g] * whole));
        on_top.fold(crest.reached(on_face), f64::max)
    }

    /// Finds the volume per second that each particle gives to the ghosts, m²/s, from velocities
    /// along x and y. The velocities of ghosts relative to walls beside them go into `factors`,
    /// their numbers as neighbours.
    pub fn give_back(
        &self,
        path: SimdPath,
        bodies: &[BodyMotion],
        velocities: [&[f64]; 2],
        given: &mut [f64],
        (flow, factors): (Flow, &mut [Factors]),
    ) {
        given.fill(0.0);
        for giving in self.giving_now() {
            let (given, factors) = (&mut *given, &mut *factors);
            dispatch(path, GiveBack { exchange: self, giving, bodies, velocities, given });
            if giving.alongside.is_some() {
                dispatch(path, Relative { exchange: self, giving, bodies, flow, factors });
            }
        }
    }

    /// Adds to the water's accelerations, m/s², what it gets back of the ghosts' pushes along the
    /// bed. Masses are per metre of width, kg/m.
    pub fn hand_back(&self, path: SimdPath, mass: &[f64], accelerations: [&mut [f64]; 2]) {
        if let Some(giving) = self.giving.iter().find(|giving| giving.smooth.is_on()) {
            dispatch(path, HandBack { exchange: self, giving, mass, accelerations });
        }
    }
}
