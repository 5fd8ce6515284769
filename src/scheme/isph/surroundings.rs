//! Neighbours, operators, surface and matrix at r*.

use super::Isph;
use super::images::{Mirrors, Point};
use super::state::Carried;
use super::surface::find_surface;
use crate::body::BodyMotion;

impl Isph {
    /// Lists the neighbours of all particles: the fluid at mid-step and its images in the walls, at
    /// the walls' positions there. All are sorted by place.
    pub(super) fn list(&mut self, bodies: &[BodyMotion], dt: f64) {
        let ahead = 0.5 * dt;
        let Carried { pressure, older_pressure, aim, response } = &mut self.carried;
        let fields = [pressure, older_pressure, aim, response];
        self.near.sort(&mut self.fluid, fields, ahead);
        let responds = self.responds;
        let offset = |(body, motion): (usize, &BodyMotion)| {
            let known = if body == responds { 0.0 } else { motion.acceleration };
            motion.offset + ahead * (motion.velocity + 0.5 * ahead * known)
        };
        self.face_offsets.clear();
        self.face_offsets.extend(bodies.iter().enumerate().map(offset));
        let faces = self.ghosts.bodies.iter().zip(&self.face_offsets);
        self.planes.clear();
        self.planes.extend(faces.map(|(body, &offset)| body.plane.moved(offset)));
        let mirrors = Mirrors {
            planes: &self.planes,
            bodies,
            responds,
            reach: self.options.support_radius,
            density: self.options.density,
            dt,
        };
        mirrors.points(&self.fluid, &mut self.loose, &mut self.growing);
        let of = |point: &Point| (point.place, point.volume, point.original);
        self.near.list(self.fluid.len(), &self.loose, &mut self.points, of);
    }

    /// Operators of all particles, and the surface.
    pub(super) fn find_operators(&mut self) {
        self.operators.find(&mut self.near, self.fluid.len());
        let around = (&self.near, &self.points[..]);
        self.operators.turn(around, &mut self.turned);
        find_surface(&mut self.operators, around, (self.options.spacing, &self.even));
    }

    /// The matrix of the pressure equation.
    pub(super) fn assemble(&mut self) {
        let found = (&self.near, &self.operators);
        self.system.assemble(self.options.laplacian, found, &self.even);
    }
}
