//! Particle shifting, away from walls and from the free surface.

use super::{Wcsph, WcsphOptions, Workspace};
use crate::boundary::{Plane, Profile};
use crate::pairs::{Double, Fluid, Here, Summed};
use crate::water::{SHIFT_LIMIT, any_nearer};

/// The speed of a shift is the difference of the flow's velocity over this many support radii.
const ACROSS: f64 = 2.0;

/// Shifts particles towards an even spread, and adjusts their densities to the new place.
///
/// The speed is 2R √(2E:E), where E is the strain rate without its trace. So water that moves or
/// turns as one body is not shifted. Without corrected gradients there is no E, and |u| is taken
/// instead, as in Lind et al. 2012.
struct Shift<'a> {
    mass: &'a [f64],
    velocity: [&'a [f64]; 2],
    work: &'a Workspace,
    options: &'a WcsphOptions,
    planes: &'a [Plane],
    /// The bed, where it is not level.
    bed: Option<&'a Profile>,
    /// As [`super::momentum::Momentum::strain`].
    strain: &'a [[f64; 2]],
    /// Completenesses of the support between which the shift fades in.
    fades_in: [f64; 2],
    /// The time for which particles are shifted, seconds.
    dt: f64,
    /// 1/R, 1/m.
    inverse_radius: f64,
}

impl Shift<'_> {
    /// The speed of the shift, m/s.
    #[inline(always)]
    fn speed<D: Double>(&self, here: Here) -> D {
        if self.options.corrected_gradients {
            // R √(2E:E) is twice √((2 stretch)² + shear²), in the quantities of the pair pass.
            let [stretch, shear] = here.both::<D>(self.strain);
            let stretch = stretch + stretch;
            D::splat(2.0 * ACROSS) * stretch.mul_add(stretch, shear * shear).sqrt()
        } else {
            let [vx, vy] = here.all::<D, 2>(self.velocity);
            (vx * vx + vy * vy).sqrt()
        }
    }

    /// The shift, metres.
    #[inline(always)]
    fn way<D: Double>(&self, here: Here, place: [D; 2]) -> [D; 2] {
        let Shift { work, options, planes, bed, dt, .. } = self;
        let strength = options.shifting_coefficient * options.smoothing_length() * dt;
        let (limit, reach) = (SHIFT_LIMIT * options.spacing, options.spacing);
        let [from, full] = self.fades_in;
        let inside = here.of::<D>(&work.completeness) - D::splat(from);
        let inside = inside.div(D::splat(full - from));
        let inside = inside.max(D::splat(0.0)).min(D::splat(1.0));
        let factor = D::splat(-strength) * self.speed::<D>(here) * inside;
        let [dx, dy] = here.all::<D, 2>([&work.concentration_x, &work.concentration_y]);
        let dx = (factor * dx).max(D::splat(-limit)).min(D::splat(limit));
        let dy = (factor * dy).max(D::splat(-limit)).min(D::splat(limit));
        let bed = bed.filter(|bed| {
            let [xs, ys] = D::to_arrays(place);
            bed.may_be_within([&xs, &ys], 1.5 * reach)
        });
        if bed.is_none() && !any_nearer(planes, place, 1.5 * reach) {
            return [dx, dy];
        }
        let ([xs, ys], first) = (D::to_arrays(place), here.numbers().start);
        here.change([dx, dy], |k, mut shift| {
            let place = [xs[k - first], ys[k - first]];
            let face = bed.and_then(|bed| bed.face_within(place, 1.5 * reach));
            for plane in planes.iter().chain(&face) {
                let distance = -plane.beyond(place);
                if distance < 1.5 * reach {
                    let fade = (distance / reach - 0.5).clamp(0.0, 1.0);
                    shift = plane.with_across(shift, |across| across * fade);
                }
            }
            shift
        })
    }
}

/// Rows of places and densities.
type Rows<'r> = [&'r mut [f64]; 3];

impl Summed<Rows<'_>> for Shift<'_> {
    /// Adds up the energy gained, J/m.
    #[inline(always)]
    fn at<D: Double>(&self, here: Here, [to_x, to_y, to_density]: &mut Rows<'_>) -> D {
        let (work, options) = (self.work, self.options);
        let [x, y] = [here.in_rows::<D>(to_x), here.in_rows(to_y)];
        let density = here.in_rows::<D>(to_density);
        let [dx, dy] = self.way(here, [x, y]);
        let [gradient_x, gradient_y] = here.all::<D, 2>([&work.gradient_x, &work.gradient_y]);
        let rise = (dx * gradient_x + dy * gradient_y) * D::splat(self.inverse_radius)
            - D::splat(options.hydrostatic_slope()) * dy;
        let rise = options.softer(density).map_or(rise, |softer| softer * rise);
        let elastic = here.of::<D>(&work.pressure).div(density * density) * rise;
        here.put(to_x, x + dx);
        here.put(to_y, y + dy);
        here.put(to_density, density + rise);
        here.of::<D>(self.mass) * (D::splat(options.gravity) * dy + elastic)
    }
}

impl Wcsph {
    /// Shifts the particles, if that is wanted, for the time since the last full step. Returns the
    /// energy that is lost.
    pub(super) fn shift(&mut self, fades_in: [f64; 2]) -> f64 {
        let n = self.fluid.padded_len();
        let Fluid { x, y, vx, vy, density, mass, .. } = &mut self.fluid;
        let shift = Shift {
            mass,
            velocity: [vx, vy],
            work: &self.work,
            options: &self.options,
            planes: &self.planes,
            bed: self.ghosts.outline(),
            strain: &self.strain,
            fades_in,
            dt: self.since_full,
            inverse_radius: self.scaling.inverse_radius,
        };
        let rows = [&mut x[..n], &mut y[..n], &mut density[..n]];
        -self.pairs.sum_each(rows, &shift)
    }
}
