//! Turns a filling into a scheme's water between ghosts, ready to run.

use super::bed_lattice::BedLattice;
use super::contract::Walls;
use super::filling::{Filling, WALL_HEIGHT};
use super::frame::Frame;
use super::numerics::{Numerics, Scheme as SchemeChoice, Slip};
use super::packing::{Packing, Uneven};
use super::tank::Tank;
use crate::body::Place;
use crate::boundary::{CrestShape, Ghosts, TankLayout, box_ghosts, no_ghosts, tank_ghosts};
use crate::math::simd::SimdPath;
use crate::pairs::{Fluid, Strips};
use crate::scheme::isph::{Isph, IsphOptions};
use crate::scheme::wcsph::{Shifting, Wcsph, WcsphOptions};
use crate::scheme::{Scheme, StateEquation};
use crate::water::SHIFT_INTERIOR;

impl Filling {
    /// A tank with only this water between its walls.
    pub(super) fn tank(&self, frame: Frame, numerics: &Numerics, path: SimdPath) -> Tank {
        Tank::of(self.water(&frame, numerics, path), frame, numerics, self.lattice.spacing[0])
    }

    /// The water between its walls, ready to run.
    fn water(&self, frame: &Frame, numerics: &Numerics, path: SimdPath) -> Box<dyn Scheme> {
        let ghosts = self.ghosts(frame, numerics, self.crest);
        if numerics.scheme == SchemeChoice::Isph {
            return self.incompressible(frame, numerics, ghosts, path);
        }
        let [dx, _] = self.lattice.spacing;
        let state = frame.state_equation(numerics, self.surface_density);
        let options = WcsphOptions {
            kernel: numerics.kernel,
            support_radius: numerics.support_radius_ratio * dx,
            spacing: dx,
            state,
            density: frame.density,
            gravity: frame.gravity,
            still_depth: frame.depth,
            corrected_gradients: numerics.corrected_gradients,
            extrapolated_correction: numerics.extrapolated_correction,
            density_diffusion: numerics.density_diffusion,
            diffusion_coefficient: numerics.density_diffusion_coefficient,
            artificial_viscosity: numerics.artificial_viscosity,
            limited_viscosity: numerics.limited_viscosity,
            shifting: numerics.shifting,
            shifting_coefficient: numerics.shifting_coefficient,
            volume_feedback: numerics.volume_feedback,
            conservative_bed: numerics.conservative_bed,
            conservative_crest: numerics.conservative_crest,
            surface_relief: numerics.surface_relief && frame.gravity > 0.0,
            bulk_damping: numerics.bulk_damping,
            acoustic_substeps: numerics.acoustic_substeps,
            precision: numerics.precision,
            kinematic_viscosity: numerics.kinematic_viscosity_m2_per_s.unwrap_or(0.0),
            field: self.field,
        };
        let rules = Wcsph::exchange_rules(
            &options,
            numerics.interpolator(),
            numerics.ghost_gravity,
            numerics.slip == Slip::No,
        );
        let level = self.profile.is_none();
        let points = if self.lattice.upright() && level {
            self.points.clone()
        } else if self.crest.is_some() {
            // The extra rows above the surface need a wall, or they would push the water over its
            // crest.
            self.packed(frame, numerics, &self.ghosts(frame, numerics, None), &state)
        } else {
            self.packed(frame, numerics, &ghosts, &state)
        };
        let basin = self.basin.as_ref();
        let (first, behind) = (points.len(), basin.map_or(&[][..], |basin| &basin.points));
        let fluid = self.fluid(points.into_iter().chain(behind.iter().copied()));
        let all = fluid.len();
        let mut water = Wcsph::new(options, rules, fluid, ghosts, Place::Right.number(), path);
        if self.balanced && self.lattice.upright() && level && options.corrected_gradients {
            water.balance(0..first, self.lattice.rows);
        }
        if let Some(basin) = basin.filter(|_| options.corrected_gradients) {
            water.balance(first..all, basin.rows);
        }
        Box::new(water)
    }

    /// Moves the points to even places before a leaning wall, each with the density of its new
    /// height. Extra rows above the surface keep the uppermost rows from rising. They are removed
    /// afterwards.
    fn packed(
        &self,
        frame: &Frame,
        numerics: &Numerics,
        ghosts: &Ghosts,
        state: &StateEquation,
    ) -> Vec<[f64; 4]> {
        let [dx, dy] = self.lattice.spacing;
        let support_radius = numerics.support_radius_ratio * dx;
        let layers = (support_radius / dy).ceil() as usize;
        let even = |&[x, y, _, area]: &[f64; 4]| [x, y, area];
        let mut particles: Vec<[f64; 3]> = match &self.profile {
            None => {
                self.lattice.raised(2 * layers).points(|_, _| [1.0; 2]).iter().map(even).collect()
            }
            Some(profile) => {
                let above =
                    BedLattice { rows_above: 2 * layers, ..self.bed_lattice(profile, frame.depth) };
                above.points()
            }
        };
        let face = match &self.profile {
            None => Uneven::Wall(ghosts.bodies[Place::Right.number()].plane),
            Some(profile) => Uneven::Bed(profile),
        };
        let packing = Packing {
            kernel: numerics.kernel,
            support_radius,
            spacing: dx,
            face,
            ghosts,
            held_above: frame.depth + layers as f64 * dy,
        };
        packing.pack(&mut particles);
        let moved = |(&[_, y, density, mass], &[new_x, new_y, _]): (&[f64; 4], &[f64; 3])| {
            let pressure = state.pressure(density) - density * frame.gravity * (new_y - y);
            [new_x, new_y, state.density(pressure), mass]
        };
        self.points.iter().zip(&particles).map(moved).collect()
    }

    /// The same water and walls for incompressible SPH: ρ0 everywhere.
    fn incompressible(
        &self,
        frame: &Frame,
        numerics: &Numerics,
        ghosts: Ghosts,
        path: SimdPath,
    ) -> Box<dyn Scheme> {
        let [dx, _] = self.lattice.spacing;
        let own = numerics.incompressible();
        let viscous_speed = frame.viscous_speed();
        let support_radius = numerics.support_radius_ratio * dx;
        let options = IsphOptions {
            kernel: numerics.kernel,
            support_radius,
            spacing: dx,
            density: frame.density,
            gravity: frame.gravity,
            still_level: frame.depth,
            viscosity: numerics.kinematic_viscosity_m2_per_s.unwrap_or(0.0),
            compact_share: own.compact_share,
            acceleration: frame.acceleration(),
            viscous_speed,
            artificial_viscosity: numerics.artificial_viscosity,
            shifting_coefficient: match numerics.shifting {
                Shifting::None => 0.0,
                Shifting::Interior | Shifting::Deep => numerics.shifting_coefficient,
            },
            shifting_fades_in: numerics.shifting.fades_in().unwrap_or(SHIFT_INTERIOR),
            laplacian: own.laplacian,
            preconditioner: own.preconditioner,
            solver_tolerance: own.solver_tolerance,
            courant_number: own.flow_courant_number,
            volume_rate: numerics.volume_feedback * viscous_speed / support_radius,
        };
        let fluid = if self.walls == Walls::Tank {
            self.fluid(self.lattice.points(|_, _| [frame.density; 2]))
        } else {
            let even = |&[x, y, density, mass]: &[f64; 4]| {
                [x, y, frame.density, mass * frame.density / density]
            };
            self.fluid(self.points.iter().map(even))
        };
        Box::new(Isph::new(options, ghosts, fluid, Place::Right.number(), path))
    }

    /// The water as particles, from the filling's points or from points with the same places.
    fn fluid(&self, points: impl IntoIterator<Item = [f64; 4]>) -> Fluid {
        let mut fluid = Fluid::at_rest(points);
        for (k, &[vx, vy]) in self.velocities.iter().enumerate() {
            (fluid.vx[k], fluid.vy[k]) = (vx, vy);
        }
        fluid
    }

    /// The walls around the water. The right wall ends in this crest, or does not end.
    fn ghosts(&self, frame: &Frame, numerics: &Numerics, crest: Option<CrestShape>) -> Ghosts {
        let [dx, dy] = self.lattice.spacing;
        let layout = TankLayout {
            length: frame.length,
            spacing_x: dx,
            spacing_y: dy,
            support_radius: numerics.support_radius_ratio * dx,
            wall_height: WALL_HEIGHT * frame.depth,
            bed_beyond_wall: self.bed_beyond_wall,
            bed_before_paddle: self.bed_before_paddle,
            wall_angle_deg: self.wall_angle_deg,
            still_level: frame.depth,
            dry_bed: self.dry_bed,
            crest,
        };
        let strip_width = Strips::width(dx);
        match self.walls {
            Walls::Tank => tank_ghosts(&layout, self.profile.as_ref(), strip_width),
            Walls::Closed => box_ghosts(&layout, frame.depth, strip_width),
            Walls::None => no_ghosts(strip_width),
        }
    }
}
