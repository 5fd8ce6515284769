//! Results of special scenes besides force, runup and probes: an observer for each kind.

mod cavity;
mod collapse;
mod drop;
mod patch;
mod standing_wave;
mod vortices;

use super::named_readings::Readings;
use crate::pairs::Fluid;
use crate::scene::{CaseConfig, Scene, Tank};

/// Follows a run and gives a few numbers at its end.
pub(super) trait Watch {
    /// Takes the force of the water on all walls along x over one step, N per metre of width.
    fn push(&mut self, _force: f64, _dt: f64) {}

    /// Takes a sample at the history's times.
    fn sample(&mut self, time: f64, fluid: &Fluid);

    /// Its memory of the run so far, as bytes.
    fn memory(&self) -> Vec<u8>;

    /// Restores that memory.
    fn recall(&mut self, memory: &[u8]) -> postcard::Result<()>;

    /// Adds its results at the end of the run.
    fn tell(&self, fluid: &Fluid, all: &mut Readings);
}

/// Stores the fields of an observer that change.
macro_rules! remembers {
    ($($field:ident),+) => {
        fn memory(&self) -> Vec<u8> {
            postcard::to_stdvec(&($(&self.$field,)+)).expect("numbers always serialise")
        }

        fn recall(&mut self, memory: &[u8]) -> postcard::Result<()> {
            ($(self.$field,)+) = postcard::from_bytes(memory)?;
            Ok(())
        }
    };
}
use remembers;

/// The observer of a scene; none if the measures of every run are enough.
pub(super) fn of(config: &CaseConfig, tank: &Tank) -> Option<Box<dyn Watch>> {
    let viscosity = config.numerics.kinematic_viscosity_m2_per_s.unwrap_or(0.0);
    let fluid = tank.water.fluid();
    Some(match &config.scene {
        Scene::DamBreak(scene) => {
            let (frame, length) = (tank.frame, scene.column_length_m);
            Box::new(collapse::Collapse::new(frame, length, tank.spacing, fluid))
        }
        Scene::StandingWave(scene) => {
            Box::new(standing_wave::Swing::new(scene.wave(), scene.surface_speed(), viscosity))
        }
        Scene::TaylorGreen(scene) => {
            Box::new(vortices::Vortices::new(scene.flow(), viscosity, fluid))
        }
        Scene::RotatingPatch(scene) => Box::new(patch::Patch::new(scene.patch(), fluid)),
        Scene::OscillatingDrop(scene) => Box::new(drop::Drop::new(scene.drop_at_start())),
        Scene::Seawall(_) | Scene::Hydrostatic(_) => return None,
    })
}

/// Share of a flow in the water's motion: Σ m u·w/Σ m w², with the flow w at the particles.
fn share_of(fluid: &Fluid, flow: impl Fn([f64; 2]) -> [f64; 2]) -> f64 {
    let (mut along, mut whole) = (0.0, 0.0);
    for k in 0..fluid.len() {
        let [u, v] = flow([fluid.x[k], fluid.y[k]]);
        along += fluid.mass[k] * (fluid.vx[k] * u + fluid.vy[k] * v);
        whole += fluid.mass[k] * (u * u + v * v);
    }
    along / whole
}

/// ½ Σ m u², J per metre of width.
fn kinetic_energy(fluid: &Fluid) -> f64 {
    let squares = (0..fluid.len())
        .map(|k| fluid.mass[k] * (fluid.vx[k] * fluid.vx[k] + fluid.vy[k] * fluid.vy[k]));
    0.5 * squares.sum::<f64>()
}

/// Mean time between zero crossings, by straight lines between samples; and the largest |value|
/// between each two of them, with its time. `None` before the second crossing.
fn half_swings(series: &[(f64, f64)]) -> Option<(f64, Vec<(f64, f64)>)> {
    let mut crossings = Vec::new();
    let mut peaks: Vec<(f64, f64)> = Vec::new();
    for pair in series.windows(2) {
        let [(t, a), (u, b)] = [pair[0], pair[1]];
        if (a > 0.0) != (b > 0.0) {
            crossings.push(t + (u - t) * a / (a - b));
            peaks.push((u, 0.0));
        }
    }
    let (first, last) = (crossings.first()?, crossings.last()?);
    if crossings.len() < 2 {
        return None;
    }
    let mean = (last - first) / (crossings.len() - 1) as f64;
    peaks.pop();
    for (peak, ends) in peaks.iter_mut().zip(crossings.windows(2)) {
        let inside = series.iter().filter(|(t, _)| *t > ends[0] && *t < ends[1]);
        *peak = inside
            .map(|&(t, v)| (t, v.abs()))
            .fold(*peak, |best, one| if one.1 > best.1 { one } else { best });
    }
    Some((mean, peaks))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_damped_swing_gives_its_period_and_its_peaks() {
        let series: Vec<(f64, f64)> = (0..1000)
            .map(|k| 0.01 * f64::from(k))
            .map(|t| (t, (-0.1 * t).exp() * (2.0 * t).cos()))
            .collect();
        let (half, peaks) = half_swings(&series).unwrap();
        assert!((half - std::f64::consts::FRAC_PI_2).abs() < 1e-4, "{half}");
        assert_eq!(peaks.len(), 5);
        for (time, value) in peaks {
            assert!((value - (-0.1 * time).exp()).abs() < 2e-3);
        }
        assert_eq!(half_swings(&series[..50]), None);
    }
}
