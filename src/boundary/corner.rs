//! Ghosts behind a corner of water.

use super::ghosts::{Reflection, Site};
use super::layout::{TankLayout, at};

/// Corners of water wider than this, radians, reflect like a wall with the mean normal.
const NEARLY_STRAIGHT: f64 = 2.65;

/// The wedge behind a corner of water, between the normals of its two faces. Angles in radians.
pub(super) struct Corner {
    pub vertex: [f64; 2],
    /// Direction of the wedge's middle.
    pub middle: f64,
    /// Between the normals.
    pub width: f64,
    /// Of the water.
    pub water: f64,
}

impl Corner {
    /// Rings around the vertex, cut into cells with a ghost at the centroid of each. The centroid
    /// is farther out than the middle of its ring, most of all in the innermost ring. In an obtuse
    /// corner ghosts mirror through the vertex. In an acute one the water is narrower than the
    /// wedge, so directions are narrowed to fit. In a nearly straight corner each ghost mirrors
    /// across its own direction, as at a wall.
    pub(super) fn sites(&self, layout: &TankLayout, face: u32) -> Vec<Site> {
        let Corner { vertex, middle, width, water } = *self;
        let narrowing = (water / width).min(1.0);
        let rings = (layout.support_radius / layout.spacing_x).ceil() as i64;
        let mut sites = Vec::new();
        for ring in 0..rings {
            let middle_radius = at(ring, layout.spacing_x);
            let count = (width * middle_radius / layout.spacing_y).round().max(1.0);
            let radius = centroid(ring, layout.spacing_x, 0.5 * width / count);
            for k in 0..count as i64 {
                let off = ((k as f64 + 0.5) / count - 0.5) * width;
                let towards = |angle: f64, radius: f64| {
                    let [x, y] = [libm::cos(angle), libm::sin(angle)];
                    [vertex[0] + radius * x, vertex[1] + radius * y]
                };
                let normal = [libm::cos(middle + off), libm::sin(middle + off)];
                let straight = water > NEARLY_STRAIGHT;
                sites.push(Site {
                    ghost: towards(middle + off, radius),
                    mirror: towards(middle + narrowing * off, -radius),
                    reflection: match straight {
                        true => Reflection::Plane { normal },
                        false => Reflection::Corner,
                    },
                    distance: radius,
                    face,
                    volume: width * middle_radius * layout.spacing_x / count,
                    twin: Site::ALONE,
                });
            }
        }
        sites
    }
}

/// Distance between the vertex and the centroid of a piece of a ring. The piece spans twice the
/// angle `half`.
fn centroid(ring: i64, thickness: f64, half: f64) -> f64 {
    let (inner, outer) = (ring as f64 * thickness, (ring + 1) as f64 * thickness);
    let mean = (outer * outer + outer * inner + inner * inner) / (1.5 * (outer + inner));
    mean * libm::sin(half) / half
}
