//! Bounds of a healthy run, from the scales of its scene.

use crate::scene::{FALLS_FREE, Tank};
use crate::simulation::energy::WaterEnergy;

/// A larger mean gap between the two readings of a force means voids at the wall.
pub const LASTING_GAP: f64 = 0.5;

/// Bounds of a healthy run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HealthBounds {
    /// m/s: twice the speed that Bernoulli's law gives for a fall from the highest conceivable
    /// runup. The front of a dam break is faster (Ritter 1892), and faster still as it shoots up a
    /// wall.
    pub speed: f64,
    /// Largest |ρ/ρ_s - 1|; scales with g h/c0².
    pub density_change: f64,
    /// ρ_s, kg/m³; zero where the water is incompressible.
    pub surface_density: f64,
    /// Share of particles that may leave the tank.
    pub lost_share: f64,
    /// Share of particles that may be clustered.
    pub clustered_share: f64,
    /// Mean gap between the momentum reaction and the face integral, relative to the larger of the
    /// force and the hydrostatic one.
    pub force_gap: f64,
    /// Energy that may come from nowhere: this share of the work done on the water ...
    pub energy_growth: f64,
    /// ... plus this, J per metre of width.
    pub energy_floor: f64,
}

impl HealthBounds {
    /// For a tank that starts with this energy.
    pub fn of(tank: &Tank, start: &WaterEnergy) -> HealthBounds {
        let (frame, head) = (tank.frame, tank.frame.speed_squared());
        // Compression scales with g h/c0². Where water hits a wall or a floor, it scales with the
        // water's speed over c0.
        let fall = (2.0 * head * (1.0 + 4.0 * tank.wave_height_ratio)).sqrt();
        let fall = fall.max(tank.other_speed);
        // Fronts that meet make jets of up to 2.7 times their speed.
        let jet = 2.0 * tank.front_speed;
        let speed = 2.0 * fall.max(jet);
        let splashes = tank.front_speed > 0.0;
        let falls_free = tank.wave_height_ratio > FALLS_FREE;
        HealthBounds {
            speed,
            density_change: 20.0 * head / (tank.sound_speed * tank.sound_speed)
                + 2.0 * jet.max(tank.other_speed) / tank.sound_speed,
            surface_density: tank
                .water
                .state_equation()
                .map_or(frame.density, |state| state.surface_density),
            lost_share: 0.02,
            clustered_share: 0.25,
            // A front that hits a wall splashes. Water that falls freely before a wall leaves
            // cavities at its face. In both cases the two readings of the force differ for a while.
            // The budget of a front has a larger gap.
            force_gap: if splashes || falls_free { 2.0 } else { LASTING_GAP },
            energy_growth: 0.25,
            energy_floor: if splashes { 0.05 } else { 0.01 } * start.potential.abs()
                + 0.25 * start.kinetic,
        }
    }
}
