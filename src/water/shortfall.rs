//! The expected measure of crowding in evenly spread water under a level surface.

use crate::kernel::KernelChoice;

/// Depths below the surface, over R, between which the correction of volume fades in. Above, the
/// surface is too near for the volume to be measured.
pub const VOLUME_DEPTHS: [f64; 2] = [0.4, 0.6];

/// The shortfall of ½ tr Σ V_j (x_j - x_i) ⊗ ∇W below 1, row by row under a level surface in evenly
/// spread water. It is that of the lattice from which water starts, so water starts at rest.
#[derive(Debug, Clone)]
pub struct Shortfall {
    /// For rows at half a spacing below the surface, and a spacing deeper each.
    rows: Vec<f64>,
    /// R over the particle spacing.
    support: f64,
}

impl Shortfall {
    /// For a kernel whose support is this many spacings.
    pub fn of(kernel: KernelChoice, support: f64) -> Shortfall {
        let reach = support.ceil() as i32;
        let slope = kernel.normalisation() / support.powi(3);
        let half_trace = |above: i32| -> f64 {
            (-reach..=reach)
                .flat_map(|x| (-reach..=above).map(move |y| f64::from(x).hypot(f64::from(y))))
                .filter(|&distance| distance > 0.0 && distance < support)
                .map(|distance| -0.5 * slope * kernel.slope_at(distance / support) * distance)
                .sum()
        };
        Shortfall { rows: (0..=reach).map(|above| 1.0 - half_trace(above)).collect(), support }
    }

    /// At a depth over R.
    pub fn at(&self, depth: f64) -> f64 {
        let last = self.rows.len() - 2;
        let place = (depth * self.support - 0.5).clamp(0.0, last as f64 + 1.0);
        let from = (place as usize).min(last);
        let [low, high] = [self.rows[from], self.rows[from + 1]];
        (high - low).mul_add(place - from as f64, low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under a straight surface ½ tr Σ is C - ½ d dC/dd, where C is the share of the kernel below
    /// the surface. This holds because ∫ r·∇W over a half-plane is the flow through its edge less
    /// 2C.
    #[test]
    fn rows_fall_short_like_the_half_plane() {
        let kernel = KernelChoice::WendlandC2;
        for support in [4.0, 5.0] {
            let shortfall = Shortfall::of(kernel, support);
            for row in 0..8 {
                let (depth, step) = ((f64::from(row) + 0.5) / support, 1e-3);
                let share = |depth: f64| kernel.half_plane_fraction(depth);
                let slope = (share(depth + step) - share(depth - step)) / (2.0 * step);
                let exact = 1.0 - share(depth) + 0.5 * depth * slope;
                let found = shortfall.at(depth);
                println!("{support}, {row}: {found:.5} {exact:.5}");
                assert!((found - exact).abs() < 6e-3, "{found} for {exact} in row {row}");
            }
        }
    }
}
