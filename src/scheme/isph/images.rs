//! Dummies: mirror images of the water behind straight walls.
//!
//! A dummy (Koshizuka & Oka 1996) is here the image of a fluid particle, found again every step.
//! Its velocity is mirrored: 2 u_w - u across the wall. Its pressure is that of its original, plus
//! the wall's Neumann condition ∂p/∂n = ρ (g - a_w)·n times their distance. So every row of the
//! pressure equation has a full support at a wall. The matrix stays symmetric, because j's image is
//! as far from i as i's image is from j.

use crate::body::BodyMotion;
use crate::boundary::Plane;
use crate::math::team::Growing;
use crate::pairs::Fluid;

/// What the walls add to an image, for known accelerations and per unit of an unknown one.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct WallTerms {
    /// Velocity at the start of the step less that of the reflected original, m/s.
    pub start_velocity: [f64; 2],
    /// The same at the end of the step ...
    pub velocity: [f64; 2],
    /// ... and per unit acceleration of the responding body, s.
    pub velocity_response: [f64; 2],
    /// Dynamic pressure less the original's, Pa ...
    pub pressure: f64,
    /// ... and per unit acceleration, Pa/(m/s²).
    pub pressure_response: f64,
}

pub(super) const NO_BODY: u8 = u8::MAX;

/// A particle or an image of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub place: [f64; 2],
    /// m².
    pub volume: f64,
    /// The fluid particle itself, or the original of an image.
    pub original: u32,
    /// Body of an image; `NO_BODY` for the fluid.
    pub body: u8,
    /// Reflection T of the original, by rows; the identity for the fluid.
    pub turn: [f64; 4],
    /// What the walls add.
    pub walls: WallTerms,
}

impl Point {
    /// T u for a vector of the original.
    #[inline(always)]
    pub fn turned(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d] = self.turn;
        [a * u + b * v, c * u + d * v]
    }

    /// T C Tᵀ for a symmetric C of the original, both by components xx, xy, yy.
    pub fn turned_tensor(&self, [xx, xy, yy]: [f64; 3]) -> [f64; 3] {
        let [a, b, c, d] = self.turn;
        let (p, q) = (a * xx + b * xy, a * xy + b * yy);
        let (r, s) = (c * xx + d * xy, c * xy + d * yy);
        [p * a + q * b, p * c + q * d, r * c + s * d]
    }
}

/// H T with H = I - 2 n nᵀ.
fn reflected([nx, ny]: [f64; 2], [a, b, c, d]: [f64; 4]) -> [f64; 4] {
    let (p, q) = (2.0 * (nx * a + ny * c), 2.0 * (nx * b + ny * d));
    [a - nx * p, b - nx * q, c - ny * p, d - ny * q]
}

/// H u + 2 n n·w: a velocity mirrored in a wall that moves at w along x.
fn mirrored([nx, ny]: [f64; 2], [u, v]: [f64; 2], w: f64) -> [f64; 2] {
    let across = 2.0 * ((w - u) * nx - v * ny);
    [u + across * nx, v + across * ny]
}

/// The walls in which the water is mirrored, at r*.
pub(super) struct Mirrors<'a> {
    pub planes: &'a [Plane],
    pub bodies: &'a [BodyMotion],
    /// The body whose acceleration is still unknown.
    pub responds: usize,
    /// Points closer than this to a wall have an image in it, metres.
    pub reach: f64,
    /// ρ0, kg/m³.
    pub density: f64,
    /// The time step, seconds.
    pub dt: f64,
}

impl Mirrors<'_> {
    /// The fluid at r* = r + ½ u Δt, and its images. Gravity's own g Δt² of Eq. 8 is left out, so
    /// that still water stays exactly where it is.
    pub fn points(&self, fluid: &Fluid, points: &mut Vec<Point>, growing: &mut Growing<Point>) {
        let ahead = 0.5 * self.dt;
        points.clear();
        points.extend((0..fluid.len()).map(|k| Point {
            place: [fluid.x[k] + ahead * fluid.vx[k], fluid.y[k] + ahead * fluid.vy[k]],
            volume: fluid.mass[k] / self.density,
            original: k as u32,
            body: NO_BODY,
            turn: [1.0, 0.0, 0.0, 1.0],
            walls: WallTerms::default(),
        }));
        for number in 0..self.planes.len() {
            growing.grow(points, |&point| self.image(number, point));
        }
        self.fill_corners(fluid.len(), points);
    }

    /// The image of a point in a wall, if it is needed.
    fn image(&self, number: usize, point: Point) -> Option<Point> {
        let &Mirrors { planes, reach, .. } = self;
        let plane = &planes[number];
        let [nx, ny] = plane.normal;
        // Here images of images fill right corners; `corner.rs` fills others. From 120° on there is
        // no room for them. There each wall's images end at the bisector behind the corner.
        let obtuse = |other: usize| {
            let [mx, my] = planes[other].normal;
            other != number && mx * nx + my * ny > 1e-9
        };
        let distance = -plane.beyond(point.place);
        if distance >= reach
            || distance <= -reach
            || (point.body != NO_BODY && self.askew(point.body as usize, number))
        {
            return None;
        }
        let image = self.mirrored_in(number, point);
        let beyond = plane.beyond(image.place);
        let other_is_nearer = |q: usize| obtuse(q) && planes[q].beyond(image.place) > beyond;
        (!(0..planes.len()).any(other_is_nearer)).then_some(image)
    }

    /// The image of a point in a wall.
    pub(super) fn mirrored_in(&self, number: usize, point: Point) -> Point {
        let &Mirrors { planes, bodies, density, dt, .. } = self;
        let (plane, motion) = (&planes[number], &bodies[number]);
        let responds = number == self.responds;
        let known = if responds { 0.0 } else { motion.acceleration };
        let [nx, ny] = plane.normal;
        let distance = -plane.beyond(point.place);
        let place = [point.place[0] + 2.0 * distance * nx, point.place[1] + 2.0 * distance * ny];
        let (speed, gain) = (motion.velocity + dt * known, if responds { dt } else { 0.0 });
        let spring = -2.0 * density * distance * nx;
        let old = point.walls;
        Point {
            place,
            body: number as u8,
            turn: reflected(plane.normal, point.turn),
            walls: WallTerms {
                start_velocity: mirrored(plane.normal, old.start_velocity, motion.velocity),
                velocity: mirrored(plane.normal, old.velocity, speed),
                velocity_response: mirrored(plane.normal, old.velocity_response, gain),
                pressure: old.pressure + spring * known,
                pressure_response: old.pressure_response + if responds { spring } else { 0.0 },
            },
            ..point
        }
    }
}
