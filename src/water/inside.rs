//! Particles stay in front of the walls' faces.

use crate::body::BodyMotion;
use crate::boundary::{Ghosts, Plane, Profile};
use crate::pairs::{Double, Eight, Here, Summed};

/// A particle a spacing behind both walls of a corner of 30° takes some fifty pushes.
const MOST_PUSHES: usize = 64;

/// Distance before the face at which particles are put, spacings.
const SKIN: f64 = 1e-3;

/// Puts particles that have slipped through a wall back onto its face, with its velocity.
pub struct HoldInside<'a> {
    all: usize,
    planes: &'a [Plane],
    /// The bed, where it is not level.
    bed: Option<&'a Profile>,
    bodies: &'a [BodyMotion],
    spacing: f64,
    mass: &'a [f64],
    gravity: f64,
}

impl<'a> HoldInside<'a> {
    /// For this many particles, with their masses, kg/m, their spacing, m, and gravity, m/s². The
    /// walls are these ghosts, with their faces at the end of the step and their motions.
    pub fn of(
        (all, mass): (usize, &'a [f64]),
        [spacing, gravity]: [f64; 2],
        (ghosts, planes, bodies): (&'a Ghosts, &'a [Plane], &'a [BodyMotion]),
    ) -> HoldInside<'a> {
        HoldInside { all, planes, bed: ghosts.outline(), bodies, spacing, mass, gravity }
    }
}

/// Rows of places and of velocities.
type Rows<'r> = [[&'r mut [f64]; 2]; 2];

impl Summed<Rows<'_>> for HoldInside<'_> {
    /// Adds up the kinetic and potential energy gained, J/m.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, [[x, y], [vx, vy]]: &mut Rows<'_>) -> D {
        let mut gained: Eight = Default::default();
        let near = any_nearer(self.planes, [here.in_rows::<D>(x), here.in_rows(y)], 0.0);
        let places: [&[f64]; 2] = [here.eight_in_rows(x), here.eight_in_rows(y)];
        let bed = self.bed.filter(|bed| bed.may_be_within(places, 0.0));
        if near || bed.is_some() {
            let skin = SKIN * self.spacing;
            let places = here.eight_in_rows(x).iter_mut().zip(here.eight_in_rows(y));
            let velocities = here.eight_in_rows(vx).iter_mut().zip(here.eight_in_rows(vy));
            let particles = here.numbers().zip(places.zip(velocities)).zip(&mut gained);
            let particles = particles.take_while(|((k, _), _)| *k < self.all);
            for ((k, ((x, y), (vx, vy))), gained) in particles {
                let [mut place, mut velocity] = [[*x, *y], [*vx, *vy]];
                if let Some(bed) = bed {
                    hold_above(&mut place, &mut velocity, bed, skin);
                }
                if near {
                    hold(&mut place, &mut velocity, (self.planes, self.bodies), skin);
                }
                let faster = square(velocity) - square([*vx, *vy]);
                *gained = self.mass[k] * (0.5 * faster + self.gravity * (place[1] - *y));
                ([*x, *y], [*vx, *vy]) = (place, velocity);
            }
        }
        D::load(&gained)
    }
}

fn square([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

/// Puts a particle back that has slipped through an uneven bed, which is at rest.
fn hold_above(place: &mut [f64; 2], velocity: &mut [f64; 2], bed: &Profile, skin: f64) {
    if place[1] >= bed.height(place[0]) {
        return;
    }
    let (face, _) = bed.nearest(*place);
    *place = face.in_front(*place, skin);
    if velocity[0] * face.normal[0] + velocity[1] * face.normal[1] > 0.0 {
        *velocity = face.with_across(*velocity, |_| 0.0);
    }
}

fn hold(
    place: &mut [f64; 2],
    velocity: &mut [f64; 2],
    (planes, bodies): (&[Plane], &[BodyMotion]),
    skin: f64,
) {
    // In an acute corner one wall may push a particle behind the other, and that one back. It gets
    // nearer to the corner each time.
    for _ in 0..MOST_PUSHES {
        let crossed = planes.iter().zip(bodies).find(|(plane, _)| plane.beyond(*place) > 0.0);
        let Some((plane, motion)) = crossed else { break };
        *place = plane.in_front(*place, skin);
        let wall = motion.velocity * plane.normal[0];
        if velocity[0] * plane.normal[0] + velocity[1] * plane.normal[1] > wall {
            *velocity = plane.with_across(*velocity, |_| wall);
        }
    }
}

/// Whether one of eight places is nearer than `distance` to a wall's face, or behind it.
#[inline(always)]
pub fn any_nearer<D: Double>(planes: &[Plane], [x, y]: [D; 2], distance: f64) -> bool {
    let mut near = false;
    for Plane { point, normal } in planes {
        let (across, up) = (x - D::splat(point[0]), y - D::splat(point[1]));
        let beyond = across * D::splat(normal[0]) + up * D::splat(normal[1]);
        near |= D::splat(-distance).any_less(beyond);
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::SimdPath;
    use crate::pairs::{Fluid, sum_in_turn};

    /// Holds particles at rest between a bed and a wall that moves at `speed` and leans over the
    /// water by an angle. Returns the particles, the faces, and the energy gained per mass.
    fn held(places: &[[f64; 2]], angle: f64, speed: f64) -> (Fluid, [Plane; 2], f64) {
        let bed = Plane { point: [0.0; 2], normal: [0.0, -1.0] };
        let wall = Plane { point: [1.0, 0.0], normal: [angle.sin(), angle.cos()] };
        let mut fluid = Fluid::at_rest(places.iter().map(|[x, y]| [*x, *y, 1000.0, 1.0]));
        let moving = BodyMotion { velocity: speed, ..BodyMotion::default() };
        let planes = [bed, wall];
        let bodies = &[BodyMotion::default(), moving];
        let (all, spacing) = (fluid.len(), 1.0);
        let Fluid { x, y, vx, vy, mass, .. } = &mut fluid;
        let gravity = 9.81;
        let hold = HoldInside { all, planes: &planes, bed: None, bodies, spacing, mass, gravity };
        let rows = [[x, y], [vx, vy]].map(|pair| pair.map(Vec::as_mut_slice));
        let gained = sum_in_turn(SimdPath::widest(), all, rows, &hold);
        let mass = fluid.mass[0];
        (fluid, planes, gained / mass)
    }

    /// The wall of an acute corner pushes particles behind the bed. A single visit of each wall in
    /// turn has then already passed the bed.
    #[test]
    fn a_particle_in_an_acute_corner_ends_in_front_of_both_walls() {
        for degrees in [30.0_f64, 45.0, 60.0, 90.0, 120.0] {
            let places = [[1.01, 0.005], [0.99, -0.01], [1.02, 0.002], [0.5, 0.1], [1.05, -0.03]];
            let (fluid, planes, _) = held(&places, degrees.to_radians(), 0.0);
            for k in 0..places.len() {
                let beyond = planes.map(|plane| plane.beyond([fluid.x[k], fluid.y[k]]));
                assert!(beyond.iter().all(|&b| b <= 0.0), "{degrees}: {k} at {beyond:?}");
            }
            assert_eq!([fluid.x[3], fluid.y[3]], places[3]);
        }
    }

    #[test]
    fn a_wall_takes_what_it_meets_along() {
        let places = [[1.01, 0.5], [0.9, 0.5], [0.5, -0.1]];
        let (fluid, _, gained) = held(&places, std::f64::consts::FRAC_PI_2, -0.2);
        assert!((fluid.x[0] - 0.999).abs() < 1e-12 && (fluid.vx[0] + 0.2).abs() < 1e-12);
        assert_eq!([fluid.x[1], fluid.vx[1]], [0.9, 0.0]);
        // The particle that the bed lifts gains potential energy.
        assert!((gained - (0.5 * 0.2 * 0.2 + 9.81 * 0.101)).abs() < 1e-12, "{gained} J/kg");
    }
}
