//! Wetness of a face point where a level surface meets a wall of any angle.

use std::f64::consts::PI;

use super::plane::Plane;
use crate::kernel::KernelChoice;

/// Wetness of a body's face at and near the contact with a level surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Waterline {
    /// At the contact.
    pub contact: f64,
    wet_at: f64,
    dry_at: f64,
}

impl Waterline {
    /// Wet from 0.4 spacings below the contact and dry from 0.4 spacings above it, along the face.
    /// `spacing` and `support_radius` are in metres.
    pub(super) fn of(
        kernel: KernelChoice,
        spacing: f64,
        support_radius: f64,
        wall: Plane,
    ) -> Waterline {
        let half = 0.4 * spacing / support_radius;
        if wall.normal[0] == 0.0 || wall.normal[1] == 0.0 {
            return Waterline {
                contact: 0.5,
                wet_at: kernel.half_plane_fraction(half),
                dry_at: kernel.half_plane_fraction(-half),
            };
        }
        let angle = PI - corner_angle(wall);
        Waterline {
            contact: angle / PI,
            wet_at: wedge_fraction(kernel, half, angle),
            dry_at: wedge_fraction(kernel, -half, angle),
        }
    }

    /// The share of a ghost that counts behind a face point of this wetness.
    pub(super) fn wet_share(&self, wetness: f64) -> f64 {
        ((wetness - self.dry_at) / (self.wet_at - self.dry_at)).clamp(0.0, 1.0)
    }
}

/// Angle of the water between a wall and the bed, radians.
pub(super) fn corner_angle(wall: Plane) -> f64 {
    // The bed's normal is (0, -1).
    PI - libm::acos(-wall.normal[1])
}

/// Share of the half disc around a point of a straight face that lies inside a wedge, weighted with
/// the kernel. The wedge has the face as one side. Its vertex lies at the distance `d` along the
/// face, in support radii. It opens by `angle`, towards the point where d > 0.
///
/// At a right angle it is [`KernelChoice::half_plane_fraction`].
pub(super) fn wedge_fraction(kernel: KernelChoice, d: f64, angle: f64) -> f64 {
    const DIRECTIONS: usize = 720;
    const STEPS: usize = 400;
    if d < 0.0 {
        return 1.0 - wedge_fraction(kernel, -d, PI - angle);
    }
    // Mass of the kernel within a radius, as a table.
    let mut within = Vec::with_capacity(STEPS + 1);
    let mut sum = 0.0;
    within.push(0.0);
    for k in 0..STEPS {
        let q = (k as f64 + 0.5) / STEPS as f64;
        sum += kernel.shape_at(q) * q;
        within.push(sum);
    }
    let mass = |q: f64| {
        let place = (q * STEPS as f64).min(STEPS as f64);
        let k = (place as usize).min(STEPS - 1);
        let part = place - k as f64;
        within[k] + part * (within[k + 1] - within[k])
    };
    // Rays from the point, θ measured from the direction of the vertex.
    let rays = (0..DIRECTIONS).map(|k| PI * (k as f64 + 0.5) / DIRECTIONS as f64);
    let reach = |theta: f64| {
        // The other side is reached where d sin(angle) = r sin(π - angle - θ).
        let rate = libm::sin(PI - angle - theta);
        if theta < PI - angle { (d * libm::sin(angle) / rate).min(1.0) } else { 1.0 }
    };
    rays.map(|theta| mass(reach(theta))).sum::<f64>() / (DIRECTIONS as f64 * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_right_wedge_is_a_half_plane() {
        for kernel in KernelChoice::ALL {
            for d in [-0.9, -0.3, 0.0, 0.1, 0.5, 1.2] {
                let (a, b) = (wedge_fraction(kernel, d, PI / 2.0), kernel.half_plane_fraction(d));
                assert!((a - b).abs() < 2e-4, "{kernel:?} at {d}: {a} and {b}");
            }
        }
    }

    #[test]
    fn at_the_vertex_it_is_the_share_of_the_angle() {
        for degrees in [30.0_f64, 60.0, 120.0, 150.0] {
            let share = wedge_fraction(KernelChoice::WendlandC2, 0.0, degrees.to_radians());
            assert!((share - degrees / 180.0).abs() < 2e-3, "{share} at {degrees}");
            let far = wedge_fraction(KernelChoice::WendlandC2, 9.0, degrees.to_radians());
            assert!((far - 1.0).abs() < 1e-12);
        }
    }
}
