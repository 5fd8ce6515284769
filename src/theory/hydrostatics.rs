//! Water at rest under a linear, weakly compressible state equation.

/// A still column of depth h with p = c0² (ρ - ρ_s).
///
/// ρ(y) = ρ_s e^{g (h - y)/c0²} balances gravity exactly. ρ_s = ρ0 x/(eˣ - 1), x = g h/c0², is the
/// surface density for which the column weighs ρ0 g h at the height h: pressure, level and weight
/// are then those of the incompressible column at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StillColumn {
    /// ρ_s, kg/m³.
    pub surface_density: f64,
    depth: f64,
    gravity: f64,
    sound_speed: f64,
}

impl StillColumn {
    /// A column of depth h (m) and mean density ρ0 (kg/m³), with gravity (m/s²) and c0 (m/s).
    pub fn new(depth: f64, density: f64, gravity: f64, sound_speed: f64) -> StillColumn {
        let x = gravity * depth / (sound_speed * sound_speed);
        StillColumn { surface_density: density * x / libm::expm1(x), depth, gravity, sound_speed }
    }

    /// ρ at the height y above the bed, kg/m³.
    pub fn density(&self, y: f64) -> f64 {
        let c = self.sound_speed;
        self.surface_density * libm::exp(self.gravity * (self.depth - y) / (c * c))
    }
}

/// Hydrostatic force on a vertical wall, ρ0 g h²/2, N per metre of width.
pub fn wall_force(depth: f64, density: f64, gravity: f64) -> f64 {
    0.5 * density * gravity * depth * depth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_column_weighs_what_it_should_and_is_in_balance() {
        let (h, rho, g, c) = (0.2, 1000.0, 9.81, 14.0);
        let column = StillColumn::new(h, rho, g, c);
        let n = 20_000;
        let dy = h / f64::from(n);
        let mass: f64 = (0..n).map(|k| column.density((f64::from(k) + 0.5) * dy) * dy).sum();
        assert!((mass - rho * h).abs() < 1e-8 * rho * h);
        assert!((column.density(h) - column.surface_density).abs() < 1e-9);
        let pressure = |y: f64| c * c * (column.density(y) - column.surface_density);
        for y in [0.01, 0.1, 0.19] {
            let gradient = (pressure(y + 1e-5) - pressure(y - 1e-5)) / 2e-5;
            assert!((gradient + column.density(y) * g).abs() < 1e-3);
        }
    }
}
