//! The first-order solitary wave.

/// A wave that a paddle at x = 0 makes by Goring's law, to first order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryWave {
    /// H/h.
    pub ratio: f64,
    /// Still depth h, m.
    pub depth: f64,
    /// g, m/s².
    pub gravity: f64,
}

impl SolitaryWave {
    /// The surface over still water, over h: η/h = H/h sech²(κ (x - S/2 - c t)). κ = √(3H/4h³), c =
    /// √(g (h + H)), and the stroke is S = √(16 H h/3). `time` (s) is counted from the middle of
    /// the stroke, `x` (m) from the paddle at rest (Goring 1978; Liang et al. 2017, Fig. 2).
    pub fn surface(self, x: f64, time: f64) -> f64 {
        let SolitaryWave { ratio, depth, gravity } = self;
        let wavenumber = (0.75 * ratio).sqrt() / depth;
        let speed = (gravity * depth * (1.0 + ratio)).sqrt();
        let stroke = depth * (16.0 * ratio / 3.0).sqrt();
        let cosh = libm::cosh(wavenumber * (x - stroke / 2.0 - speed * time));
        ratio / (cosh * cosh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wave_keeps_its_height_and_holds_what_the_paddle_moved() {
        let wave = SolitaryWave { ratio: 0.3, depth: 0.2, gravity: 9.81 };
        let step = 1e-3;
        let sum =
            |time: f64| (-3000..9000).map(|i| wave.surface(f64::from(i) * step, time)).sum::<f64>();
        let stroke = 0.2 * (16.0_f64 * 0.3 / 3.0).sqrt();
        assert!((sum(1.0) * step / stroke - 1.0).abs() < 1e-6, "the stroke's volume over h");
        let crest = stroke / 2.0 + (9.81_f64 * 0.26).sqrt();
        assert!((wave.surface(crest, 1.0) - 0.3).abs() < 1e-12);
    }
}
