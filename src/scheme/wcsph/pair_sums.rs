//! Sums over the neighbours of eight particles.

use crate::math::simd::{LANES, Lanes, Vector};

/// Sums over the neighbours of one cluster in one group, a value per lane.
#[derive(Clone, Copy)]
pub(super) struct Sums {
    /// -Σ g (p_i + p_j) Δ.
    pub push: [[f64; LANES]; 2],
    /// Σ g drag Δ.
    pub viscous: [[f64; LANES]; 2],
    /// Σ g ΔΔᵀ: xx, xy, yy.
    pub moment: [[f64; LANES]; 3],
    /// Σ g Δ.
    pub concentration: [[f64; LANES]; 2],
    /// Σ g (ρ_j - ρ_i) Δ, of fluid neighbours.
    pub gradient: [[f64; LANES]; 2],
    /// Σ g b_j Δ, b the response of a wall ghost's pressure.
    pub response: [[f64; LANES]; 2],
    /// Pairs in reach.
    pub count: usize,
}

impl Sums {
    pub(super) fn add(&mut self, other: &Sums) {
        let add = |into: &mut [[f64; LANES]], from: &[[f64; LANES]]| {
            for (a, b) in into.as_flattened_mut().iter_mut().zip(from.as_flattened()) {
                *a += b;
            }
        };
        add(&mut self.push, &other.push);
        add(&mut self.viscous, &other.viscous);
        add(&mut self.moment, &other.moment);
        add(&mut self.concentration, &other.concentration);
    }
}

/// Running sums over pairs.
#[derive(Clone, Copy)]
pub(super) struct Running<V: Vector> {
    pub push: (V, V),
    pub viscous: (V, V),
    pub moment: (V, V, V),
    /// Held passes take differences to it: double precision.
    pub concentration: (V::Wide, V::Wide),
    pub gradient: (V, V),
    pub response: (V, V),
}

impl<V: Vector> Running<V> {
    #[inline(always)]
    pub fn nothing() -> Running<V> {
        let zero = V::splat(0.0);
        Running {
            push: (zero, zero),
            viscous: (zero, zero),
            moment: (zero, zero, zero),
            concentration: (V::Wide::splat(0.0), V::Wide::splat(0.0)),
            gradient: (zero, zero),
            response: (zero, zero),
        }
    }

    /// The sums over all neighbours, of all turns and so many pairs.
    #[inline(always)]
    pub fn sums([even, odd]: [Running<V>; 2], count: usize) -> Sums {
        Sums {
            push: [total(even.push.0, odd.push.0), total(even.push.1, odd.push.1)],
            viscous: [total(even.viscous.0, odd.viscous.0), total(even.viscous.1, odd.viscous.1)],
            moment: [
                total(even.moment.0, odd.moment.0),
                total(even.moment.1, odd.moment.1),
                total(even.moment.2, odd.moment.2),
            ],
            concentration: [
                exact::<V>(even.concentration.0, odd.concentration.0),
                exact::<V>(even.concentration.1, odd.concentration.1),
            ],
            gradient: [
                total(even.gradient.0, odd.gradient.0),
                total(even.gradient.1, odd.gradient.1),
            ],
            response: [
                total(even.response.0, odd.response.0),
                total(even.response.1, odd.response.1),
            ],
            count,
        }
    }
}

/// A sum in double precision over all neighbours, of all turns.
#[inline(always)]
fn exact<V: Vector>(even: V::Wide, odd: V::Wide) -> [f64; LANES] {
    if V::TURNS > 1 { (even + odd).to_array() } else { even.to_array() }
}

/// The same of a sum in the precision of the pairs.
#[inline(always)]
fn total<V: Vector>(even: V, odd: V) -> [f64; LANES] {
    exact::<V>(even.widened(), odd.widened())
}
