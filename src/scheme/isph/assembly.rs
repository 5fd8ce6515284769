//! The pressure equation as a matrix.

use super::lattice::Even;
use super::operators::Operators;
use super::options::Laplacian;
use super::system::System;
use crate::math::simd::LANES;
use crate::pairs::{Coupling, Here, Near, Pair, Real};

/// This share of the diagonal is added to it, so that parts of the water without a held pressure
/// stay solvable.
const HOLD: f64 = 1e-8;

/// The pair weight 2 V_i V_j F of Liang et al. 2017, Eq. 4, or its form in another Laplacian. F =
/// -g, Δ = r_j - r_i.
#[derive(Clone, Copy)]
struct Compact<'a> {
    /// V_i, padded.
    volume: &'a [f64],
    /// Where only near pairs are taken: the least V_i V_j F of such a pair, and the factor on it.
    narrow: Option<(f64, f64)>,
    /// L s of every particle, padded, where 2 s·∇p is subtracted.
    tilt: Option<&'a [[f64; 2]]>,
}

impl Coupling for Compact<'_> {
    /// Volume and tilt.
    type Own<R: Real> = (R, [R; 2]);

    #[inline(always)]
    fn own<R: Real>(&self, here: Here) -> (R, [R; 2]) {
        let tilt = match self.tilt {
            Some(tilt) => here.both(tilt),
            None => [R::splat(0.0); 2],
        };
        (here.of(self.volume), tilt)
    }

    #[inline(always)]
    fn of<R: Real>(&self, &(volume, tilt): &(R, [R; 2]), pair: &Pair<R>) -> Option<R> {
        let zero = R::splat(0.0);
        let mut weight = zero - volume * pair.slope();
        if let Some((least, scale)) = self.narrow {
            weight = weight.select_less(R::splat(least), zero, weight * R::splat(scale));
        }
        if self.tilt.is_some() {
            let back = tilt[0].mul_add(pair.dx, tilt[1] * pair.dy);
            weight = back.mul_add(weight, weight);
        }
        weight += weight;
        (self.narrow.is_none() || zero.any_less(weight)).then_some(weight)
    }
}

impl System {
    /// Rows are V_i times 2 Σ F (p_i - p_j) + grip p_i, for the dynamic pressure (Liang et al.
    /// 2017, Eqs. 4 and 11). The grip is the zero pressure at the surface.
    ///
    /// The normalisation κ_i of an incomplete support is on the right-hand side, so that the matrix
    /// stays symmetric. With [`Laplacian::Schwaiger`] F becomes F (1 - s·L Δ). This subtracts 2
    /// s·∇p: the sum is then zero on linear fields in any arrangement. For [`Laplacian::Exact`]
    /// only near neighbours are taken.
    pub fn assemble(
        &mut self,
        laplacian: Laplacian,
        (near, operators): (&Near, &Operators),
        even: &Even,
    ) {
        let exact = laplacian == Laplacian::Exact;
        let tilted = laplacian == Laplacian::Schwaiger;
        if tilted {
            find_tilts(operators, operators.grip.len().next_multiple_of(LANES), &mut self.tilts);
        }
        let System { matrix, blocks, tilts, .. } = &mut *self;
        let coupling = Compact {
            volume: &near.volume,
            narrow: exact.then_some(even.narrow),
            tilt: tilted.then_some(tilts.as_slice()),
        };
        near.couple(coupling, blocks, matrix);
        let grip = &operators.grip;
        for ((diagonal, volume), grip) in matrix.diagonal.iter_mut().zip(&near.volume).zip(grip) {
            *diagonal += volume * grip;
        }
        if exact {
            // Parts without a held pressure stay solvable.
            matrix.diagonal.iter_mut().for_each(|diagonal| *diagonal *= 1.0 + HOLD);
        } else {
            self.hold_components(grip);
        }
    }
}

/// L s of all particles away from the surface, padded; zero elsewhere.
fn find_tilts(operators: &Operators, padded: usize, tilts: &mut Vec<[f64; 2]>) {
    tilts.clear();
    tilts.resize(padded, [0.0; 2]);
    for (i, tilt) in tilts.iter_mut().take(operators.grip.len()).enumerate() {
        if operators.grip[i] == 0.0 {
            let ([sx, sy], [cx, cxy, cy]) = (operators.sway[i], operators.correction[i]);
            *tilt = [sx * cx + sy * cxy, sx * cxy + sy * cy];
        }
    }
}
