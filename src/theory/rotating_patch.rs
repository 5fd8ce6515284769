//! A square of water that starts to rotate as a whole, without walls or gravity (Colagrossi 2005;
//! Le Touzé et al. 2013). Pressures are negative inside, and its corners grow into arms.

use std::f64::consts::PI;

/// The square at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotatingPatch {
    /// L, metres.
    pub side: f64,
    /// ω, 1/s.
    pub rate: f64,
}

impl RotatingPatch {
    /// u = ω y, v = -ω x, places from the centre.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.rate * y, -self.rate * x]
    }

    /// p/ρ, m²/s², places from the centre: ∇²p = 2ρω² with p = 0 on the sides,
    /// ```text
    /// p/ρ = ω² [y² - L²/4 + Σ 8 L²/(nπ)³ (-1)^((n-1)/2) cosh(nπx/L)/cosh(nπ/2) cos(nπy/L)],
    /// ```
    /// n odd: the double sine series of Le Touzé et al. 2013, Eq. 1, summed one way.
    pub fn pressure_over_density(&self, [x, y]: [f64; 2]) -> f64 {
        let side = self.side;
        let mut sum = y * y - 0.25 * side * side;
        for k in 0..60 {
            let n = PI * f64::from(2 * k + 1);
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            // cosh(nx/L)/cosh(n/2) without overflow.
            let (inner, outer) = (n * x.abs() / side, 0.5 * n);
            let ratio = libm::exp(inner - outer) * (1.0 + libm::exp(-2.0 * inner))
                / (1.0 + libm::exp(-2.0 * outer));
            sum += 8.0 * side * side / (n * n * n) * sign * ratio * libm::cos(n * y / side);
        }
        self.rate * self.rate * sum
    }

    /// Distance of a corner from the centre after `time`, metres, without pressure. At the start
    /// the pressure gradient vanishes at the corner. Later it holds the arms back.
    pub fn ballistic_arm(&self, time: f64) -> f64 {
        let turned = self.rate * time;
        0.5_f64.sqrt() * self.side * (1.0 + turned * turned).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATCH: RotatingPatch = RotatingPatch { side: 2.0, rate: 1.5 };

    #[test]
    fn the_pressure_solves_its_equation() {
        let p = |x: f64, y: f64| PATCH.pressure_over_density([x, y]);
        for along in [-0.9, -0.3, 0.0, 0.4, 0.8] {
            for edge in [p(1.0, along), p(-1.0, along), p(along, 1.0), p(along, -1.0)] {
                assert!(edge.abs() < 2e-5, "{edge} at {along}");
            }
        }
        let step = 1e-3;
        for [x, y] in [[0.1, 0.3], [-0.5, 0.2], [0.0, 0.0]] {
            let round = p(x + step, y) + p(x - step, y) + p(x, y + step) + p(x, y - step);
            let laplacian = (round - 4.0 * p(x, y)) / (step * step);
            assert!((laplacian - 2.0 * 1.5 * 1.5).abs() < 1e-3, "{laplacian}");
        }
        assert!(p(0.0, 0.0) < 0.0 && (p(0.2, 0.6) - p(0.6, 0.2)).abs() < 2e-5);
    }
}
