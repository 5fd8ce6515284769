//! Sums over a particle's neighbours in evenly spread water.

use super::options::IsphOptions;

/// The Laplacian that preconditions the exact one takes neighbours within this many spacings.
const NARROW: f64 = 2.1;

/// Sums over a square lattice of the options' spacing, for a particle inside it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Even {
    /// Σ F.
    pub weight: f64,
    /// Σ V W.
    pub coverage: f64,
    /// V² F at the edge of the narrow Laplacian, and Σ F Δ² over the same sum within that edge.
    pub narrow: (f64, f64),
}

pub(super) fn even_water(options: &IsphOptions) -> Even {
    let (dx, radius) = (options.spacing, options.support_radius);
    let rings = (radius / dx).ceil() as i64;
    let factor = dx * dx * options.kernel.normalisation() / (radius * radius);
    let weight_at = |q: f64| -factor * options.kernel.slope_at(q) / (q * radius * radius);
    let (mut weight, mut coverage) = (0.0, factor * options.kernel.shape_at(0.0));
    let (mut moment, mut narrow_moment) = (0.0, 0.0);
    for i in -rings..=rings {
        for j in -rings..=rings {
            let distance = (i as f64).hypot(j as f64);
            let q = distance * dx / radius;
            if q > 0.0 && q < 1.0 {
                weight += weight_at(q);
                coverage += factor * options.kernel.shape_at(q);
                moment += distance * distance * weight_at(q);
                if distance < NARROW {
                    narrow_moment += distance * distance * weight_at(q);
                }
            }
        }
    }
    let edge = (NARROW * dx / radius).min(1.0);
    Even { weight, coverage, narrow: (dx * dx * weight_at(edge), moment / narrow_moment) }
}
