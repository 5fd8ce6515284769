//! Linear standing gravity waves between vertical walls, in water without and with viscosity.

use std::f64::consts::{PI, TAU};

/// Steps in a period of a viscous wave.
const STEPS: f64 = 1000.0;
/// The finest modes are this many times thinner than the layer of vorticity below the surface.
const FINE: f64 = 8.0;
/// Smallest and largest number of vorticity modes over the depth.
const MODES: [f64; 2] = [24.0, 1000.0];

/// A standing wave on water of uniform depth. The walls are half a wavelength, or a multiple of it,
/// apart.
///
/// The potential flow is u = Û cos(ωt) sin(kx) cosh(ky)/sinh(kh) and v = -Û cos(ωt) cos(kx)
/// sinh(ky)/sinh(kh), with y from the bed. The surface starts flat. Its vertical speed has the
/// amplitude Û.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StandingWave {
    /// h, metres.
    pub depth: f64,
    /// k, 1/m.
    pub wavenumber: f64,
    /// g, m/s².
    pub gravity: f64,
}

impl StandingWave {
    /// ω = √(g k tanh(kh)), 1/s: Lamb, Hydrodynamics, § 228.
    pub fn frequency(&self) -> f64 {
        let (k, h) = (self.wavenumber, self.depth);
        (self.gravity * k * libm::tanh(k * h)).sqrt()
    }

    /// Initial decay rate 2νk² of the amplitude, which falls as exp(-2νk²t), 1/s. It is the
    /// dissipation of irrotational motion between free-slip walls, at any depth (Lamb, § 348).
    pub fn damping(&self, kinematic_viscosity: f64) -> f64 {
        2.0 * kinematic_viscosity * self.wavenumber * self.wavenumber
    }

    /// The share of its flow that a wave of this viscosity still has, with its time, from the start
    /// up to a time, s.
    ///
    /// No stress acts along the surface, so the water there has the vorticity -2kA, if A is the
    /// vertical speed. The vorticity diffuses downwards as ∂Z/∂t = ν(Z'' - k²Z). It is zero at the
    /// start, and zero at a free-slip bed. With the pressure and the normal stress at the surface η
    /// this gives (Prosperetti 1976 in deep water):
    ///
    /// A' = -ω²η - 4νk²A - 2νk tanh(kh) ∫ k Z sinh(ky)/sinh(kh) dy
    ///
    /// So the wave decays less than exp(-2νk²t), in the end by √(νk²/2ω) of that, and oscillates
    /// more slowly. Z is -2kA sinh(ky)/sinh(kh) plus sines that vanish at bed and surface. Each
    /// sine decays by itself.
    pub fn swing(&self, viscosity: f64, until: f64) -> Vec<(f64, f64)> {
        let (k, h, frequency) = (self.wavenumber, self.depth, self.frequency());
        let (slope, step) = (libm::tanh(k * h), TAU / (STEPS * frequency));
        let layer = (2.0 * viscosity / frequency).sqrt().min(1.0 / k);
        let modes = (FINE * h / (PI * layer)).ceil().clamp(MODES[0], MODES[1]) as u32;
        let turning = 2.0 * viscosity * k * slope;
        let mut turns: Vec<Turn> = (1..=modes)
            .map(|number| Turn::new(self, f64::from(number) * PI / h, step * viscosity))
            .collect();
        // Finer modes follow the surface at once.
        let squares = 0.5 / (slope * k) - 0.5 * h / libm::sinh(k * h).powi(2);
        let finer =
            squares - turns.iter().map(|turn| turn.share * turn.share).sum::<f64>() * 0.5 * h;
        let damping = 2.0 * self.damping(viscosity) - turning * 2.0 * k * k * finer;
        // The effect of the modes on A' through A at the end of a step.
        let own = turning * turns.iter().map(|turn| turn.weight * turn.later).sum::<f64>();
        let (mut surface, mut speed, half) = (0.0, 1.0, 0.5 * step);
        let mut all = vec![(0.0, speed)];
        for number in 1..=(until / step).ceil() as u64 {
            let before = turning * turns.iter().map(|turn| turn.weight * turn.size).sum::<f64>();
            turns
                .iter_mut()
                .for_each(|turn| turn.size = turn.left * turn.size + turn.sooner * speed);
            let known = turning * turns.iter().map(|turn| turn.weight * turn.size).sum::<f64>();
            let square = frequency * frequency;
            let push = -square * (2.0 * surface + half * speed) - damping * speed - before - known;
            let next = (speed + half * push) / (1.0 + half * (square * half + damping + own));
            turns.iter_mut().for_each(|turn| turn.size += turn.later * next);
            surface += half * (speed + next);
            speed = next;
            all.push((number as f64 * step, speed));
        }
        all
    }

    /// The flow at t = 0 for Û = 1.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (k, h) = (self.wavenumber, self.depth);
        let scale = 1.0 / libm::sinh(k * h);
        [
            libm::sin(k * x) * libm::cosh(k * y) * scale,
            -libm::cos(k * x) * libm::sinh(k * y) * scale,
        ]
    }
}

/// The vorticity below the surface of a viscous wave: one sine of it over the depth.
///
/// The part that follows the surface at once is left out. B' = -λ (B + 2k s A), where s is the
/// sine's share in sinh(ky)/sinh(kh), and λ its decay rate.
struct Turn {
    /// s.
    share: f64,
    /// B.
    size: f64,
    /// Weight of B in ∫ k Z sinh(ky)/sinh(kh) dy.
    weight: f64,
    /// The share of B that is left after a step, and its gain from A before and after it; A is
    /// linear in between.
    left: f64,
    sooner: f64,
    later: f64,
}

impl Turn {
    /// For a sine of this wavenumber, 1/m, and steps of this ν Δt, m².
    fn new(wave: &StandingWave, wavenumber: f64, step: f64) -> Turn {
        let (k, h, q) = (wave.wavenumber, wave.depth, wavenumber);
        let share = -2.0 / h * libm::cos(q * h) * q / (k * k + q * q);
        let decay = step * (k * k + q * q);
        let left = libm::exp(-decay);
        let mean = if decay > 0.0 { -libm::expm1(-decay) / decay } else { 1.0 };
        let asked = -2.0 * k * share;
        let (sooner, later) = (asked * (mean - left), asked * (1.0 - mean));
        Turn { share, size: 0.0, weight: 0.5 * k * h * share, left, sooner, later }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAVE: StandingWave = StandingWave { depth: 0.3, wavenumber: 5.0, gravity: 9.81 };

    #[test]
    fn the_flow_has_neither_sources_nor_swirl_and_keeps_to_bed_and_walls() {
        let step = 1e-5;
        for [x, y] in [[0.1, 0.05], [0.4, 0.2], [0.05, 0.29]] {
            let along = |axis: usize, part: usize| {
                let (mut low, mut high) = ([x, y], [x, y]);
                low[axis] -= step;
                high[axis] += step;
                (WAVE.velocity(high)[part] - WAVE.velocity(low)[part]) / (2.0 * step)
            };
            assert!((along(0, 0) + along(1, 1)).abs() < 1e-8);
            assert!((along(1, 0) - along(0, 1)).abs() < 1e-8);
        }
        assert_eq!(WAVE.velocity([0.2, 0.0])[1], 0.0);
        assert!(WAVE.velocity([std::f64::consts::PI / 5.0, 0.1])[0].abs() < 1e-12);
        assert!((WAVE.velocity([0.0, 0.3])[1] + 1.0).abs() < 1e-12);
    }

    #[test]
    fn long_waves_are_those_of_shallow_water() {
        let long = StandingWave { wavenumber: 1e-3, ..WAVE };
        let celerity = long.frequency() / long.wavenumber;
        assert!((celerity - (9.81_f64 * 0.3).sqrt()).abs() < 1e-6);
    }

    /// Decay rate over 2νk², and period over that without viscosity, of late oscillations.
    fn late(wave: &StandingWave, share: f64) -> [f64; 2] {
        let frequency = wave.frequency();
        let viscosity = share * frequency / wave.wavenumber.powi(2);
        let series = wave.swing(viscosity, 6.0 * TAU / frequency);
        let zeros: Vec<f64> = (series.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0))
            .map(|pair| pair[0].0 + (pair[1].0 - pair[0].0) * pair[0].1 / (pair[0].1 - pair[1].1))
            .collect();
        let peak =
            |number: usize| {
                let inside =
                    series.iter().filter(|one| one.0 > zeros[number] && one.0 < zeros[number + 1]);
                inside.fold((0.0, 0.0), |best: (f64, f64), one| {
                    if one.1.abs() > best.1 { (one.0, one.1.abs()) } else { best }
                })
            };
        let [(t, a), (u, b)] = [peak(4), peak(10)];
        let rate = libm::log(a / b) / (u - t) / wave.damping(viscosity);
        [rate, (zeros[11] - zeros[5]) / 3.0 * frequency / TAU]
    }

    /// Deep water: (s + 2νk²)² + ω² = 4ν²k³ √(k² + s/ν) (Lamb, § 349), solved before with complex
    /// numbers. Each line has νk²/ω, the rate over 2νk², and the period over that without
    /// viscosity.
    #[test]
    fn viscous_waves_in_deep_water_decay_by_lambs_roots() {
        let deep = StandingWave { depth: 1.5, ..WAVE };
        for (share, rate, period) in [
            (0.001, 0.97763, 1.00004),
            (0.005, 0.94987, 1.00050),
            (0.03, 0.87568, 1.00729),
            (0.1, 0.76509, 1.04424),
        ] {
            let [computed, swing] = late(&deep, share);
            assert!((computed - rate).abs() < 1.5e-3, "{share}: {computed} for {rate}");
            assert!((swing - period).abs() < 2e-4, "{share}: {swing} for {period}");
        }
    }

    #[test]
    fn a_viscous_wave_begins_to_decay_as_without_a_layer_at_its_surface() {
        let viscosity = 1e-4;
        let frequency = WAVE.frequency();
        // cos(ωt) exp(-2νk²t) for a small part of a period, except for an effect that grows as
        // t^(3/2).
        let series = WAVE.swing(viscosity, 0.01 * TAU / frequency);
        let (time, left) = *series.last().unwrap();
        let lost = 1.0 - left - (1.0 - libm::cos(frequency * time));
        let share = lost / (2.0 * WAVE.damping(viscosity) * time);
        assert!((share - 1.0).abs() < 0.08, "{share}");
        // Without viscosity it does not decay.
        let (time, left) = *WAVE.swing(0.0, TAU / frequency).last().unwrap();
        assert!((left - libm::cos(frequency * time)).abs() < 1e-4, "{left}");
    }
}
