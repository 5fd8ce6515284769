//! Particles stay in front of the walls' faces.

use std::ops::Range;

use crate::body::BodyMotion;
use crate::boundary::Plane;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::{Fluid, lanes};

/// Puts particles that have slipped through a wall back onto its face, with its velocity.
pub(super) struct HoldInside<'a> {
    pub fluid: &'a mut Fluid,
    /// The particles, whole vectors.
    pub lanes: Range<usize>,
    pub planes: &'a [Plane],
    pub bodies: &'a [BodyMotion],
    /// How far in front of the face they are put, metres.
    pub skin: f64,
}

impl Task for HoldInside<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self) {
        let HoldInside { fluid, lanes: some, planes, bodies, skin } = self;
        for at in some.step_by(LANES) {
            let place = [lanes::<L>(&fluid.x, at), lanes(&fluid.y, at)];
            if any_nearer(planes, place, 0.0) {
                for k in at..fluid.len().min(at + LANES) {
                    hold(fluid, k, (planes, bodies), skin);
                }
            }
        }
    }
}

fn hold(fluid: &mut Fluid, k: usize, (planes, bodies): (&[Plane], &[BodyMotion]), skin: f64) {
    // In an acute corner one wall may push behind the other.
    for _ in 0..4 {
        let place = [fluid.x[k], fluid.y[k]];
        let crossed = planes.iter().zip(bodies).find(|(plane, _)| plane.beyond(place) > 0.0);
        let Some((plane, motion)) = crossed else { break };
        [fluid.x[k], fluid.y[k]] = plane.in_front(place, skin);
        let wall = motion.velocity * plane.normal[0];
        if fluid.vx[k] * plane.normal[0] + fluid.vy[k] * plane.normal[1] > wall {
            let velocity = [fluid.vx[k], fluid.vy[k]];
            [fluid.vx[k], fluid.vy[k]] = plane.with_across(velocity, |_| wall);
        }
    }
}

/// Whether one of eight places is nearer than `distance` to a wall's face, or behind it.
#[inline(always)]
pub(super) fn any_nearer<L: Lanes>(planes: &[Plane], [x, y]: [L; 2], distance: f64) -> bool {
    let mut near = false;
    for Plane { point, normal } in planes {
        let (across, up) = (x - L::splat(point[0]), y - L::splat(point[1]));
        let beyond = across * L::splat(normal[0]) + up * L::splat(normal[1]);
        near |= L::splat(-distance).any_less(beyond);
    }
    near
}
