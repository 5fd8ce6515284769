//! Pressure and level of the water at a place, and voids at a wall, for any scheme.

use crate::body::{Motions, Place};
use crate::boundary::Plane;
use crate::scheme::Scheme;
use crate::water::level_up_to;

/// A gauge counts as wet from this far below the surface, in particle spacings, and as dry from
/// as far above it.
const WATERLINE: f64 = 0.4;
/// Discharge is found from the water within this many spacings of its section; nearer water weighs
/// more.
const SECTION: f64 = 3.0;
/// A wall whose unit normal rises or falls by less is upright.
const LEANS: f64 = 1e-9;
/// This many points of a face are looked up together.
const LOOKED_UP: usize = 16;

/// The water around a place, at an instant.
pub(super) struct Sounding<'a> {
    water: &'a dyn Scheme,
    bodies: &'a Motions,
    gravity: f64,
    spacing: f64,
    density: f64,
    near: &'a mut Near,
}

/// Fluid particles and ghosts in reach of a box: (x, y, volume, pressure, density).
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    water: Vec<[f64; 5]>,
    solid: Vec<[f64; 3]>,
}

impl<'a> Sounding<'a> {
    /// `spacing` is that of the particles, metres, `density` the water's, kg/m³. `near` is memory
    /// for the particles in reach.
    pub(super) fn new(
        water: &'a dyn Scheme,
        bodies: &'a Motions,
        (gravity, spacing, density): (f64, f64, f64),
        near: &'a mut Near,
    ) -> Sounding<'a> {
        Sounding { water, bodies, gravity, spacing, density, near }
    }

    /// The face of a body at its present place.
    pub(super) fn face(&self, place: Place) -> Plane {
        self.water.walls().bodies[place.number()].plane.moved(self.bodies[place].offset)
    }

    /// Water beyond an upright section, m², with the water that was taken away there. A particle is
    /// a square, and counts in part if it is on the section.
    pub(super) fn beyond(&self, x: f64) -> f64 {
        let fluid = self.water.fluid();
        let share = |k: usize| ((fluid.x[k] - x) / self.spacing + 0.5).clamp(0.0, 1.0);
        let mass: f64 = (0..fluid.len()).map(|k| fluid.mass[k] * share(k)).sum();
        (mass + self.water.taken().mass) / self.density
    }

    /// Discharge through an upright section, m²/s, positive towards the seawall.
    pub(super) fn discharge(&self, x: f64) -> f64 {
        let (fluid, reach) = (self.water.fluid(), SECTION * self.spacing);
        let near = |k: usize| (1.0 - (fluid.x[k] - x).abs() / reach).max(0.0) / reach;
        let momentum = (0..fluid.len()).map(|k| fluid.mass[k] * fluid.vx[k] * near(k));
        momentum.sum::<f64>() / self.density
    }

    /// Looks up all particles in reach of the points of a box.
    fn look(&mut self, [left, right]: [f64; 2], [bottom, top]: [f64; 2]) {
        let (_, radius) = self.water.kernel();
        let close = |x: f64, y: f64| {
            x > left - radius && x < right + radius && y > bottom - radius && y < top + radius
        };
        let fluid = self.water.fluid();
        let pressure = self.water.pressures();
        let ends = [Place::Left, Place::Right].map(|place| self.face(place).point[0]);
        let Near { water, solid } = &mut *self.near;
        water.clear();
        solid.clear();
        let wet = (0..fluid.len()).filter(|&k| close(fluid.x[k], fluid.y[k]));
        water.extend(wet.map(|k| {
            let volume = fluid.mass[k] / fluid.density[k];
            [fluid.x[k], fluid.y[k], volume, pressure[k], self.density]
        }));
        let ghosts = self.water.walls();
        let ends = [ends[0], if ghosts.end_on_slope() { f64::INFINITY } else { ends[1] }];
        for (number, (body, motion)) in ghosts.bodies.iter().zip(self.bodies.iter()).enumerate() {
            for g in body.ghosts.clone() {
                let (x, y) = (ghosts.x[g] + motion.offset, ghosts.y[g]);
                if close(x, y) {
                    // A bed that goes on beneath a wall counts once: as the wall's corner block.
                    let own = if number == Place::Bed.number() {
                        share_between(ends, x, self.spacing)
                    } else {
                        1.0
                    };
                    solid.push([x, y, own * ghosts.volume[g]]);
                }
            }
        }
    }

    /// Share and pressure of the water at a place that was looked up. The share of the kernel is
    /// relative to the part without walls. The pressure is Σ W V [p + ρg(y_j - y)] / Σ W V.
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let near = &*self.near;
        let (kernel, radius) = self.water.kernel();
        let weight = |x_j: f64, y_j: f64, volume: f64| {
            let q = (x_j - x).hypot(y_j - y) / radius;
            if q < 1.0 { volume * kernel.shape_at(q) } else { 0.0 }
        };
        let (mut wet, mut sum) = (0.0, 0.0);
        for &[x_j, y_j, volume, pressure, density] in &near.water {
            let w = weight(x_j, y_j, volume);
            wet += w;
            sum += w * (pressure + density * self.gravity * (y_j - y));
        }
        let solid: f64 = near.solid.iter().map(|&[x, y, volume]| weight(x, y, volume)).sum();
        let factor = kernel.normalisation() / (radius * radius);
        let share = wet * factor / (1.0 - solid * factor).max(0.05);
        (share, if wet > 0.0 { sum / wet } else { 0.0 })
    }

    /// Pressure at a place, averaged over a disc of this diameter in the direction `along`; 0 where
    /// it is dry. `along` points up a wall. A level surface meets the wall at an angle. The share
    /// of water at the contact is that of this angle.
    pub(super) fn pressure(&mut self, [x, y]: [f64; 2], along: [f64; 2], diameter: f64) -> f64 {
        let radius = 0.5 * diameter;
        self.look([x - radius, x + radius], [y - radius, y + radius]);
        if self.near.water.is_empty() {
            return 0.0;
        }
        let waterline = self.waterline(along);
        let count = (2.0 * diameter / self.spacing).ceil().max(1.0) as u32;
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..count {
            let t = (2.0 * f64::from(k) + 1.0) / f64::from(count) - 1.0;
            // The disc's width at this height.
            let chord = (1.0 - t * t).sqrt();
            let place = [x + along[0] * t * radius, y + along[1] * t * radius];
            sum += chord * self.wet_pressure(place, waterline);
            weights += chord;
        }
        sum / weights
    }

    /// Pressures at points along a face, as [`Sounding::pressure`] gives them one by one.
    pub(super) fn pressures(&mut self, points: &[[f64; 2]], along: [f64; 2]) -> Vec<f64> {
        let waterline = self.waterline(along);
        let mut all = Vec::with_capacity(points.len());
        for group in points.chunks(LOOKED_UP) {
            let range = |axis: usize| {
                let places = group.iter().map(|point| point[axis]);
                [
                    places.clone().fold(f64::INFINITY, f64::min),
                    places.fold(-f64::INFINITY, f64::max),
                ]
            };
            self.look(range(0), range(1));
            all.extend(group.iter().map(|&point| self.wet_pressure(point, waterline)));
        }
        all
    }

    /// The shares of water above which a place on a face is wet, and below which it is dry.
    fn waterline(&self, along: [f64; 2]) -> [f64; 2] {
        let (kernel, support) = self.water.kernel();
        let half = WATERLINE * self.spacing / support;
        let contact = libm::acos(along[0]) / std::f64::consts::PI;
        let fade = kernel.half_plane_fraction(half) - 0.5;
        [contact + fade, (contact - fade).max(0.0)]
    }

    /// The pressure at a place that was looked up, times its wet share.
    fn wet_pressure(&self, [x, y]: [f64; 2], [wet_at, dry_at]: [f64; 2]) -> f64 {
        let (share, pressure) = self.at(x, y);
        pressure * ((share - dry_at) / (wet_at - dry_at)).clamp(0.0, 1.0)
    }

    /// Level of the water at x, metres over the paddle's foot: upwards from the ground, where the
    /// water's share falls to 1/2. It is the ground where that is dry. Under a wall that leans over
    /// the water it is at most the wall's face.
    pub(super) fn level(&mut self, x: f64, highest: f64) -> f64 {
        let [ground, highest] = self.open_at(x, highest);
        self.look([x, x], [ground, highest]);
        level_up_to(|y| self.at(x, y).0, [ground, highest], self.spacing)
    }

    /// The heights at x between which water may be. They end at the face of a wall that leans.
    fn open_at(&self, x: f64, highest: f64) -> [f64; 2] {
        let ground = self.water.walls().ground(x);
        let Plane { point, normal } = self.face(Place::Right);
        let face = point[1] - (x - point[0]) * normal[0] / normal[1];
        if normal[1] < -LEANS {
            [ground.max(face), highest]
        } else if normal[1] > LEANS {
            [ground, face.clamp(ground, highest.max(ground))]
        } else {
            [ground, highest]
        }
    }

    /// The largest share of the kernel that is empty at a wall, relative to the part without walls.
    /// It is taken from the toe up to a support radius below the highest contact of water. At the
    /// contact half of the kernel or more is water.
    pub(super) fn void(&mut self, ([toe, foot], up): ([f64; 2], [f64; 2]), highest: f64) -> f64 {
        let (_, support) = self.water.kernel();
        let highest = highest - foot;
        let top = toe + up[0] * highest / up[1];
        self.look([toe.min(top), toe.max(top)], [foot, foot + highest]);
        let step = 0.5 * self.spacing;
        let share = |k: u32| {
            let way = f64::from(k) * step;
            self.at(toe + up[0] * way, foot + up[1] * way).0
        };
        let all = 0..(highest / (step * up[1])) as u32;
        let wet = all.rev().find(|&k| share(k) >= 0.5).unwrap_or(0);
        let covered = wet.saturating_sub((support / step).ceil() as u32);
        (0..covered).map(|k| 1.0 - share(k)).fold(0.0, f64::max)
    }
}

/// The share of a column of this width around x that lies between two walls. Whole columns count as
/// whole despite rounding of their ends.
fn share_between([left, right]: [f64; 2], x: f64, width: f64) -> f64 {
    let inside = (right.min(x + 0.5 * width) - left.max(x - 0.5 * width)) / width;
    if (inside - inside.round()).abs() < 1e-9 { inside.round().max(0.0) } else { inside.max(0.0) }
}

#[cfg(test)]
mod tests;
