//! Goda's formula for the force of waves on an upright wall (Goda, Random Seas and Design of Maritime
//! Structures: the formula of 1974).

/// Waves of normal incidence before an upright wall that stands on the bed, without a mound.
///
/// ```text
/// η* = 1.5 H          p1 = α1 ρgH          p3 = α3 p1
/// α1 = 0.6 + ½ (2kh / sinh 2kh)²           α3 = 1 / cosh kh
/// ```
/// These pressures are in addition to those of still water. At the still level it is p1. From there
/// it falls linearly to p3 at the bed, and linearly to 0 at the height η*. Without a mound α2 is 0.
/// If the wall ends below η*, the pressure above its crest is left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goda {
    /// H/h.
    pub ratio: f64,
    /// kh = 2πh/L. It is 0 in the limit of long waves, which is used for a solitary wave: α1 = 1.1
    /// and α3 = 1.
    pub depth_in_waves: f64,
    /// Height of the wall's crest over still water, over h; infinite if no water goes over it.
    pub freeboard: f64,
}

impl Goda {
    /// α1 and α3.
    pub fn factors(self) -> [f64; 2] {
        let kh = self.depth_in_waves;
        let steep = if kh > 0.0 { 2.0 * kh / libm::sinh(2.0 * kh) } else { 1.0 };
        [0.6 + 0.5 * steep * steep, 1.0 / libm::cosh(kh)]
    }

    /// The whole force over ρgh²/2, that of still water included. On an endless wall it is 1 + α1
    /// H/h [(1 + α3) + 1.5 H/h]. With a crest at h_c the last term 1.5 H/h becomes 2 h_c/h (1 -
    /// h_c/2η*).
    pub fn force(self) -> f64 {
        let [surface, bed] = self.factors();
        let top = 1.5 * self.ratio;
        let above =
            if self.freeboard < top { self.freeboard * (2.0 - self.freeboard / top) } else { top };
        1.0 + surface * self.ratio * (1.0 + bed + above)
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
            } else if height > 1.0 + wave.freeboard {
                0.0
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
        let endless = f64::INFINITY;
        for (ratio, depth_in_waves, freeboard) in
            [(0.3, 0.0, endless), (0.5, 0.7, endless), (0.1, 3.0, endless), (0.5, 0.7, 0.2)]
        {
            let wave = Goda { ratio, depth_in_waves, freeboard };
            assert!((wave.force() - 1.0 - area(wave)).abs() < 2e-5, "{wave:?}");
        }
    }

    #[test]
    fn worked_values() {
        let of = |ratio, depth_in_waves| Goda { ratio, depth_in_waves, freeboard: f64::INFINITY };
        // Long waves: 1 + 1.1 · 0.3 (2 + 0.45). Deep water, kh = π: sinh 2π = 267.74, cosh π = 11.592.
        assert!((of(0.3, 0.0).force() - 1.8085).abs() < 1e-12);
        let [surface, bed] = of(0.1, std::f64::consts::PI).factors();
        assert!((surface - 0.600_275).abs() < 1e-6 && (bed - 0.086_27).abs() < 1e-5);
        let nearly = of(0.3, 1e-4).force();
        assert!((nearly - of(0.3, 0.0).force()).abs() < 1e-6);
    }
}
