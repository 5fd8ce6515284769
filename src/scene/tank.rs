//! From a seawall scene to particles at rest in a tank.

use super::numerics::{BoundaryChoice, GhostGravity, Numerics, Slip};
use super::seawall::{SeawallScene, WallChoice};
use crate::body::SpringWall;
use crate::boundary::{ImprovedShepard, InterpolatorChoice, TankLayout, tank_ghosts};
use crate::math::simd::SimdPath;
use crate::particles::Fluid;
use crate::scheme::wcsph::{Wcsph, WcsphOptions};
use crate::scheme::{Scheme, StateEquation};
use crate::theory::goring::GoringPiston;
use crate::theory::hydrostatics::{StillColumn, wall_force};

/// Number of the bed among the bodies.
pub const BED: usize = 0;
/// Number of the paddle.
pub const PADDLE: usize = 1;
/// Number of the seawall.
pub const WALL: usize = 2;

/// Walls rise to this many still water depths above the bed.
const WALL_HEIGHT: f64 = 4.0;
/// The bed reaches this many still water depths beyond the wall.
const BED_BEYOND: f64 = 12.0;

/// A wave tank, ready to run.
#[derive(Debug)]
pub struct Tank {
    /// The water and its walls, at rest.
    pub water: Box<dyn Scheme>,
    /// The paddle's law; none for still water.
    pub piston: Option<GoringPiston>,
    /// The wall's law; none for a fixed wall.
    pub wall: Option<SpringWall>,
    /// Hydrostatic force on the wall, N per metre of width.
    pub static_force: f64,
    /// F_th, N per metre of width.
    pub threshold: f64,
    /// When the run ends, seconds.
    pub end_time: f64,
    /// c0, m/s.
    pub sound_speed: f64,
    /// Particle spacing along the bed, metres.
    pub spacing: f64,
}

/// Whole columns and rows, and the spacings that make them fill the water exactly.
fn lattice(scene: &SeawallScene, numerics: &Numerics) -> (usize, usize, f64, f64) {
    let columns = (scene.tank_length_m / numerics.particle_spacing_m).round().max(1.0);
    let rows = (scene.still_water_depth_m / numerics.particle_spacing_m).round().max(1.0);
    let (dx, dy) = (scene.tank_length_m / columns, scene.still_water_depth_m / rows);
    (columns as usize, rows as usize, dx, dy)
}

impl SeawallScene {
    /// c0, m/s.
    pub fn sound_speed(&self, numerics: &Numerics) -> f64 {
        numerics.sound_speed_ratio * (self.gravity_m_per_s2 * self.still_water_depth_m).sqrt()
    }

    /// The paddle's law; none for still water.
    pub fn piston(&self) -> Option<GoringPiston> {
        (self.wave_height_ratio > 0.0).then(|| {
            GoringPiston::new(
                self.wave_height_ratio,
                self.still_water_depth_m,
                self.gravity_m_per_s2,
                self.paddle_ramp_fraction,
            )
        })
    }

    /// When the run ends, seconds.
    pub fn end_time(&self) -> f64 {
        let after_stroke =
            |piston: GoringPiston| piston.stroke_centre() + self.end_after_stroke_centre_s;
        self.end_time_s
            .or_else(|| self.piston().map(after_stroke))
            .unwrap_or(self.end_after_stroke_centre_s)
    }

    /// Time step, seconds: bounded by c0 Δt/Δx and by `time_step_s`.
    pub fn time_step(&self, numerics: &Numerics) -> f64 {
        let bound =
            numerics.courant_number * numerics.particle_spacing_m / self.sound_speed(numerics);
        numerics.time_step_s.map_or(bound, |step| step.min(bound))
    }

    /// Fluid particles.
    pub fn particles(&self, numerics: &Numerics) -> usize {
        let (columns, rows, ..) = lattice(self, numerics);
        columns * rows
    }

    /// Builds the tank: a lattice of particles in hydrostatic balance between ghost walls.
    pub fn build(&self, numerics: &Numerics, path: SimdPath) -> Tank {
        let (columns, rows, dx, dy) = lattice(self, numerics);
        let (depth, gravity) = (self.still_water_depth_m, self.gravity_m_per_s2);
        let sound_speed = self.sound_speed(numerics);
        let still = StillColumn::new(depth, self.water_density_kg_per_m3, gravity, sound_speed);
        let state = StateEquation {
            choice: numerics.state_equation,
            surface_density: still.surface_density,
            sound_speed,
        };
        let options = WcsphOptions {
            kernel: numerics.kernel,
            support_radius: numerics.support_radius_ratio * dx,
            spacing: dx,
            state,
            density: self.water_density_kg_per_m3,
            gravity,
            corrected_gradients: numerics.corrected_gradients,
            density_diffusion: numerics.density_diffusion,
            diffusion_coefficient: numerics.density_diffusion_coefficient,
            artificial_viscosity: numerics.artificial_viscosity,
            shifting: numerics.shifting,
            shifting_coefficient: numerics.shifting_coefficient,
        };
        let points = (0..columns).flat_map(|column| {
            (0..rows).map(move |row| {
                let (x, y) = ((column as f64 + 0.5) * dx, (row as f64 + 0.5) * dy);
                let density = still.density(y);
                [
                    x,
                    y,
                    state.density(sound_speed * sound_speed * (density - still.surface_density)),
                    density * dx * dy,
                ]
            })
        });
        let layout = TankLayout {
            length: self.tank_length_m,
            spacing_x: dx,
            spacing_y: dy,
            support_radius: options.support_radius,
            wall_height: WALL_HEIGHT * depth,
            // The same for a fixed wall, so that both share a trunk to the bit.
            bed_beyond_wall: BED_BEYOND * depth,
        };
        let ghosts = tank_ghosts(&layout, Wcsph::strip_width(dx));
        let BoundaryChoice::ImprovedShepard = numerics.boundary;
        let interpolator = InterpolatorChoice::ImprovedShepard(ImprovedShepard {
            lambda: numerics.shepard_lambda,
            sigma: numerics.shepard_sigma,
        });
        let rules = Wcsph::exchange_rules(
            &options,
            interpolator,
            numerics.ghost_gravity == GhostGravity::InSum,
            numerics.slip == Slip::No,
        );
        let static_force = wall_force(depth, self.water_density_kg_per_m3, gravity);
        let threshold = self.threshold_ratio * static_force;
        let wall = match (self.wall, self.seawall_mass_kg_per_m, self.spring_stiffness_n_per_m) {
            (WallChoice::Movable, Some(mass), Some(stiffness)) => {
                Some(SpringWall::at_rest(mass, stiffness, threshold, self.force_coupling))
            }
            _ => None,
        };
        Tank {
            water: Box::new(Wcsph::new(options, rules, Fluid::at_rest(points), ghosts, WALL, path)),
            piston: self.piston(),
            wall,
            static_force,
            threshold,
            end_time: self.end_time(),
            sound_speed,
            spacing: dx,
        }
    }
}
