//! The mean surface in a train of waves that a piston sends into still water.

use std::f64::consts::TAU;

use seawall::theory::wavemaker::travelling;

/// η̄ behind the front of a train of height H, metres.
/// ```text
/// η̄ = -S/(√(gh) (√(gh) + c_g)),   S = g H²/8 (2n - ½),   n = ½ + kh/sinh 2kh,   c_g = n ω/k
/// ```
///
/// The stress S draws the surface under the train down by S/(gh - c_g²) (Longuet-Higgins & Stewart 1962, Radiation
/// stress and mass transport in gravity waves, *J. Fluid Mech.* 13, 481-504). That is a long wave bound to the
/// train, which takes the flow c_g η with it. The piston lets no water through, so a free long wave of -c_g/√(gh) of it
/// leaves with the train. The sum of both is what stands above.
pub fn set_down(height: f64, (depth, gravity): (f64, f64), period: f64) -> f64 {
    let frequency = TAU / period;
    let kh = travelling(frequency * frequency * depth / gravity);
    let n = 0.5 + kh / libm::sinh(2.0 * kh);
    let group = n * frequency * depth / kh;
    let long = (gravity * depth).sqrt();
    let stress = gravity * height * height / 8.0 * (2.0 * n - 0.5);
    -stress / (long * (long + group))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deep water: n = ½, S = gH²/16. Shallow water: c_g = √(gh), S = 3gH²/16, so -3H²/(32h).
    #[test]
    fn deep_and_shallow_trains_have_their_limits() {
        let (height, depth, gravity): (f64, f64, f64) = (0.02, 3.0, 9.81);
        let (period, long) = (0.5, (gravity * depth).sqrt());
        let group = gravity * period / (2.0 * TAU);
        let exact = -gravity * height * height / 16.0 / (long * (long + group));
        assert!((set_down(height, (depth, gravity), period) / exact - 1.0).abs() < 1e-9);
        let shallow = set_down(height, (0.2, gravity), 60.0);
        assert!((shallow / (-3.0 * height * height / (32.0 * 0.2)) - 1.0).abs() < 1e-3);
    }
}
