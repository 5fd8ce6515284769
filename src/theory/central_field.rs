//! A force towards a centre that grows with the distance.

/// The acceleration -Ω² r, r from the centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CentralField {
    /// Metres.
    pub centre: [f64; 2],
    /// Ω, 1/s.
    pub rate: f64,
}

impl CentralField {
    /// -Ω² r, m/s².
    #[inline(always)]
    pub fn acceleration(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let strength = -self.rate * self.rate;
        [strength * (x - self.centre[0]), strength * (y - self.centre[1])]
    }

    /// ½ Ω² r², J/kg.
    pub fn potential(&self, [x, y]: [f64; 2]) -> f64 {
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        0.5 * self.rate * self.rate * (dx * dx + dy * dy)
    }
}
