//! The waves of a train: a row for every period of the paddle.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::looks::Looks;

/// One period of the paddle: at the wave gauge, and at the wall.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct WaveRow {
    /// When it begins, seconds.
    pub from_s: f64,
    /// Highest and lowest surface over still water, metres.
    pub surface_m: [f64; 2],
    /// Amplitudes of the surface at the paddle's frequency and at twice that, metres.
    pub harmonics_m: [f64; 2],
    /// Largest and smallest F*, of the running mean.
    pub force: [f64; 2],
    /// Largest R*.
    pub runup_max: f64,
    /// Mean of the surface over still water, metres.
    #[serde(default)]
    pub mean_m: f64,
}

/// The surface at an instant, seconds and metres over still water.
type Level = [f64; 2];

/// A period that is not yet complete.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Gathered {
    surface: Option<[f64; 2]>,
    force: Option<[f64; 2]>,
    runup: Option<f64>,
    /// Seconds of the surface so far, and ∫ η, ∫ η cos nωt, ∫ η sin nωt over them.
    known: f64,
    sum: f64,
    sums: [[f64; 2]; 2],
}

/// Follows a train period by period.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Waves {
    period: f64,
    rows: Vec<Gathered>,
    at_rest: Option<f64>,
    last: Option<Level>,
    looks: Looks,
    /// Time up to which the surface and the force are known, seconds.
    reached: f64,
}

impl Waves {
    /// For a paddle with this period, seconds.
    pub fn of(period: f64) -> Waves {
        let (rows, at_rest, last) = (Vec::new(), None, None);
        Waves { period, rows, at_rest, last, looks: Looks::default(), reached: 0.0 }
    }

    /// The period of a time, seconds.
    fn at(&mut self, time: f64) -> &mut Gathered {
        let number = (time.max(0.0) / self.period) as usize;
        if self.rows.len() <= number {
            self.rows.resize_with(number + 1, Gathered::default);
        }
        &mut self.rows[number]
    }

    /// Takes F* of the running mean at a time.
    pub fn press(&mut self, time: f64, force: f64) {
        widen(&mut self.at(time).force, force);
        self.reached = time;
    }

    /// Takes R*.
    pub fn run_up(&mut self, time: f64, runup: f64) {
        let highest = &mut self.at(time).runup;
        *highest = Some(highest.map_or(runup, |highest| highest.max(runup)));
    }

    /// Whether the gauge is to be read now; see [`Looks::is_due`].
    pub fn is_due(&mut self, time: f64, intervals: (f64, f64)) -> bool {
        self.looks.is_due(time, 0.0, intervals)
    }

    /// Takes the level at the gauge, metres over the bed.
    pub fn rise(&mut self, time: f64, level: f64) {
        let surface = level - *self.at_rest.get_or_insert(level);
        widen(&mut self.at(time).surface, surface);
        if let Some([before, then]) = self.last.replace([time, surface]) {
            let (span, frequency) = (time - before, TAU / self.period);
            let row = self.at(0.5 * (before + time));
            row.known += span;
            row.sum += 0.5 * span * (then + surface);
            for (times, [even, odd]) in [1.0, 2.0].into_iter().zip(&mut row.sums) {
                for (at, level) in [(before, then), (time, surface)] {
                    let phase = times * frequency * at;
                    *even += 0.5 * span * level * libm::cos(phase);
                    *odd += 0.5 * span * level * libm::sin(phase);
                }
            }
        }
    }

    /// A row for every complete period.
    pub fn rows(&self) -> Vec<WaveRow> {
        let whole = (self.reached / self.period + 1e-2) as usize;
        let row = |(number, row): (usize, &Gathered)| {
            let amplitude = |[even, odd]: [f64; 2]| 2.0 * libm::hypot(even, odd) / row.known;
            Some(WaveRow {
                from_s: number as f64 * self.period,
                surface_m: row.surface?,
                harmonics_m: row.sums.map(amplitude),
                force: row.force?,
                runup_max: row.runup?,
                mean_m: row.sum / row.known,
            })
        };
        self.rows.iter().enumerate().take(whole).filter_map(row).collect()
    }
}

/// Extends the range from the lowest to the highest by a value.
fn widen(known: &mut Option<[f64; 2]>, value: f64) {
    let [high, low] = known.unwrap_or([value; 2]);
    *known = Some([high.max(value), low.min(value)]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// η = 3 cos ωt + cos 2ωt in millimetres, growing by a tenth from period to period.
    #[test]
    fn each_period_has_its_own_row() {
        let (period, mut waves) = (0.8, Waves::of(0.8));
        let growth = |time: f64| 1.0 + 0.1 * (time / period).floor();
        for step in 0..2500 {
            let time = 0.001 * f64::from(step) + 1e-4;
            let phase = TAU * time / period;
            let share = if time < 0.005 { 0.0 } else { growth(time) };
            if waves.is_due(time, (0.005, 0.1428)) {
                let wave = 3.0 * libm::cos(phase) + libm::cos(2.0 * phase);
                waves.rise(time, 0.2 + 1e-3 * share * wave);
            }
            waves.press(time, 1.0 + 0.1 * share * libm::sin(phase));
            waves.run_up(time, 0.2 * share * libm::sin(phase));
        }
        let rows = waves.rows();
        assert_eq!(rows.len(), 3, "the fourth has not ended");
        for (number, row) in rows.iter().enumerate().skip(1) {
            let share = 1.0 + 0.1 * number as f64;
            assert!((row.from_s - 0.8 * number as f64).abs() < 1e-12);
            // The lowest is at cos θ = -3/4, where η = -17/8.
            let exact = [4e-3 * share, -2.125e-3 * share];
            for (found, exact) in row.surface_m.into_iter().zip(exact) {
                assert!((found / exact - 1.0).abs() < 2e-3, "{found} {exact}");
            }
            assert!((row.harmonics_m[0] / (3e-3 * share) - 1.0).abs() < 0.01);
            assert!((row.harmonics_m[1] / (1e-3 * share) - 1.0).abs() < 0.01);
            assert!(row.mean_m.abs() < 2e-5);
            assert!((row.force[0] - 1.0 - 0.1 * share).abs() < 1e-4);
            assert!((row.force[1] - 1.0 + 0.1 * share).abs() < 1e-4);
            assert!((row.runup_max - 0.2 * share).abs() < 1e-4);
        }
    }
}
