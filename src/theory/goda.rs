//! Goda's formula for the force of waves on an upright wall (Goda, Random Seas and Design of Maritime
//! Structures: the formula of 1974).

/// Waves of normal incidence before an upright wall that stands on the bed, without a mound, and that no
/// water goes over.
///
/// ```text
/// η* = 1.5 H          p1 = α1 ρgH          p3 = α3 p1
/// α1 = 0.6 + ½ (2kh / sinh 2kh)²           α3 = 1 / cosh kh
/// ```
/// These are pressures above those of still water. At the still level it is p1. From there it falls in a
/// straight line to p3 at the bed, and in another to 0 at the height η*. Without a mound α2 is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goda {
    /// H/h.
    pub ratio: f64,
    /// kh = 2πh/L; 0 for the limit of long waves.
    pub depth_in_waves: f64,
}

impl Goda {
    /// A solitary wave has no length: it is taken as the limit of long waves, α1 = 1.1 and α3 = 1, and its
    /// height over still water as H.
    pub fn solitary(ratio: f64) -> Goda {
        Goda { ratio, depth_in_waves: 0.0 }
    }

    /// α1 and α3.
    pub fn factors(self) -> [f64; 2] {
        let kh = self.depth_in_waves;
        let steep = if kh > 0.0 { 2.0 * kh / libm::sinh(2.0 * kh) } else { 1.0 };
        [0.6 + 0.5 * steep * steep, 1.0 / libm::cosh(kh)]
    }

    /// The whole force over ρgh²/2, that of still water included: 1 + α1 H/h [(1 + α3) + 1.5 H/h].
    pub fn force(self) -> f64 {
        let [surface, bed] = self.factors();
        1.0 + surface * self.ratio * (1.0 + bed + 1.5 * self.ratio)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area under the pressure's straight lines, over ρgh²/2.
    fn area(wave: Goda) -> f64 {
        let [surface, bed] = wave.factors();
        let pressure = |height: f64| {
            let share = if height < 1.0 {
                bed + (1.0 - bed) * height
            } else {
                (1.0 - (height - 1.0) / (1.5 * wave.ratio)).max(0.0)
            };
            surface * wave.ratio * share
        };
        let step = 1e-5;
        2.0 * step * (0..300_000).map(|k| pressure((f64::from(k) + 0.5) * step)).sum::<f64>()
    }

    #[test]
    fn the_force_is_the_area_under_the_pressure() {
        for (ratio, depth_in_waves) in [(0.3, 0.0), (0.5, 0.7), (0.1, 3.0)] {
            let wave = Goda { ratio, depth_in_waves };
            assert!((wave.force() - 1.0 - area(wave)).abs() < 1e-6, "{wave:?}");
        }
    }

    #[test]
    fn worked_values() {
        // Long waves: 1 + 1.1 · 0.3 (2 + 0.45). Deep water, kh = π: sinh 2π = 267.74, cosh π = 11.592.
        assert!((Goda::solitary(0.3).force() - 1.8085).abs() < 1e-12);
        let [surface, bed] = Goda { ratio: 0.1, depth_in_waves: std::f64::consts::PI }.factors();
        assert!((surface - 0.600_275).abs() < 1e-6 && (bed - 0.086_27).abs() < 1e-5);
        let nearly = Goda { ratio: 0.3, depth_in_waves: 1e-4 }.force();
        assert!((nearly - Goda::solitary(0.3).force()).abs() < 1e-6);
    }
}
