//! The moments of a particle's support, and the correction of gradients.

use super::images::Point;
use crate::pairs::{Field, Near};

/// The correction of gradients fades from the moment's inverse, above this eigenvalue, ...
const CORRECT_FULL: f64 = 0.30;
/// ... to the identity, below this one.
const CORRECT_FROM: f64 = 0.20;

/// Operators at r*, one entry per fluid particle.
#[derive(Debug, Clone, Default)]
pub(super) struct Operators {
    /// Σ V W, itself included.
    pub coverage: Vec<f64>,
    /// Σ F.
    pub weight: Vec<f64>,
    /// s = Σ F Δ.
    pub sway: Vec<[f64; 2]>,
    /// Σ F ΔΔᵀ: xx, xy, yy.
    pub moment: Vec<[f64; 3]>,
    /// Its inverse, faded to the identity where it is near singular.
    pub correction: Vec<[f64; 3]>,
    /// Its smallest eigenvalue: 1 inside the water, 1/2 at a flat surface.
    pub completeness: Vec<f64>,
    /// Whether a particle is at the surface, ∇·r < 1.5; and what the zero pressure there adds to
    /// the diagonal of particles near it.
    pub at_surface: Vec<bool>,
    pub grip: Vec<f64>,
}

impl Operators {
    /// Sums over all pairs of the water's `n` particles, and finds every operator from the sums.
    pub fn find(&mut self, near: &mut Near, n: usize) {
        for field in [&mut self.coverage, &mut self.weight, &mut self.completeness] {
            field.resize(n, 0.0);
        }
        self.sway.resize(n, [0.0; 2]);
        self.moment.resize(n, [0.0; 3]);
        self.correction.resize(n, [0.0; 3]);
        self.grip.resize(n, 0.0);
        let Operators { coverage, weight, sway, moment, correction, completeness, .. } = self;
        let sums = (Field(coverage), (Field(weight), Field(sway)));
        let support = (Field(moment), (Field(correction), Field(completeness)));
        near.weigh((sums, support), |of| {
            ((of.coverage, (of.weight, of.sway)), (of.moment, invert(of.moment)))
        });
    }

    /// L of every point, turned as its image is.
    pub fn turn(&self, (near, points): (&Near, &[Point]), turned: &mut Vec<[f64; 3]>) {
        turned.resize(points.len(), [0.0; 3]);
        near.of_points(turned, |e| {
            points[e].turned_tensor(self.correction[points[e].original as usize])
        });
    }

    /// κ_i = ½ tr (Σ F ΔΔᵀ)⁻¹: Schwaiger's (2008) normalisation of an incomplete support. It scales
    /// the compact Laplacian to the size of the exact one. Below the completeness `least` it is its
    /// upper bound.
    pub fn kappa(&self, i: usize, least: f64) -> f64 {
        const FULLEST: f64 = 3.0;
        let [xx, xy, yy] = self.moment[i];
        let determinant = xx * yy - xy * xy;
        if determinant > 0.0 && self.completeness[i] > least {
            (0.5 * (xx + yy) / determinant).clamp(1.0 / FULLEST, FULLEST)
        } else {
            FULLEST
        }
    }
}

/// The inverse of a moment, faded to the identity, and the moment's smallest eigenvalue.
fn invert([xx, xy, yy]: [f64; 3]) -> ([f64; 3], f64) {
    let mean = 0.5 * (xx + yy);
    let spread = (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
    let smallest = mean - spread;
    let keep = ((smallest - CORRECT_FROM) / (CORRECT_FULL - CORRECT_FROM)).clamp(0.0, 1.0);
    if keep == 0.0 {
        return ([1.0, 0.0, 1.0], smallest);
    }
    let scale = keep / (xx * yy - xy * xy);
    ([yy * scale + 1.0 - keep, -xy * scale, xx * scale + 1.0 - keep], smallest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_moment_is_inverted_and_a_poor_one_left_alone() {
        let ([xx, xy, yy], least) = invert([1.1, 0.2, 0.7]);
        assert!((xx * 1.1 + xy * 0.2 - 1.0).abs() < 1e-12 && (xx * 0.2 + xy * 0.7).abs() < 1e-12);
        assert!((xy * 0.2 + yy * 0.7 - 1.0).abs() < 1e-12 && least > 0.5);
        assert_eq!(invert([1.0, 0.0, 0.1]).0, [1.0, 0.0, 1.0]);
    }
}
