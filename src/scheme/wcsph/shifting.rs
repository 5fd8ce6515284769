//! Particle shifting, away from walls and from the free surface.

use super::{WcsphOptions, Workspace};
use crate::boundary::Plane;
use crate::math::simd::{LANES, Lanes, Task};
use crate::pairs::{Fluid, all_lanes, lanes, store};
use crate::water::{SHIFT_FROM, SHIFT_FULL, SHIFT_LIMIT, any_nearer};

/// The speed of a shift is that by which the flow differs over so many support radii.
const ACROSS: f64 = 2.0;

/// Shifts particles towards an even spread, and takes their densities along.
///
/// The speed is 2R √(2E:E), E the strain rate without its trace: water that moves as one body or turns
/// is left alone. Where gradients are not corrected there is no E, and |u| stands for it, as in Lind et
/// al. 2012.
pub(super) struct Shift<'a> {
    pub fluid: &'a mut Fluid,
    pub work: &'a Workspace,
    pub options: &'a WcsphOptions,
    pub planes: &'a [Plane],
    /// As [`super::momentum::Momentum::strain`].
    pub strain: &'a [[f64; 2]],
    /// The time that the shift is for, seconds.
    pub dt: f64,
    /// 1/R, 1/m.
    pub inverse_radius: f64,
}

impl Task for Shift<'_> {
    /// The energy that goes, J/m.
    type Output = f64;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f64 {
        let Shift { fluid, work, options, planes, strain, dt, inverse_radius } = self;
        let strength = options.shifting_coefficient * options.smoothing_length() * dt;
        let (limit, reach) = (SHIFT_LIMIT * options.spacing, options.spacing);
        let slope = options.hydrostatic_slope();
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut gained = zero;
        for at in (0..fluid.padded_len()).step_by(LANES) {
            let [x, y, vx, vy] = all_lanes::<L, 4>([&fluid.x, &fluid.y, &fluid.vx, &fluid.vy], at);
            let inside = lanes::<L>(&work.completeness, at) - L::splat(SHIFT_FROM);
            let inside = inside.div(L::splat(SHIFT_FULL - SHIFT_FROM)).max(zero).min(one);
            let speed = if options.corrected_gradients {
                let (mut stretch, mut shear) = ([0.0; LANES], [0.0; LANES]);
                for lane in 0..LANES {
                    [stretch[lane], shear[lane]] = strain[at + lane];
                }
                // R √(2E:E) is twice √((2 stretch)² + shear²), as the pair pass has them.
                let (stretch, shear) = (L::load(&stretch) + L::load(&stretch), L::load(&shear));
                L::splat(2.0 * ACROSS) * stretch.mul_add(stretch, shear * shear).sqrt()
            } else {
                (vx * vx + vy * vy).sqrt()
            };
            let factor = L::splat(-strength) * speed * inside;
            let [dx, dy] = all_lanes::<L, 2>([&work.concentration_x, &work.concentration_y], at);
            let mut dx = (factor * dx).max(L::splat(-limit)).min(L::splat(limit));
            let mut dy = (factor * dy).max(L::splat(-limit)).min(L::splat(limit));
            if any_nearer(planes, [x, y], 1.5 * reach) {
                let (mut shift_x, mut shift_y) = (dx.to_array(), dy.to_array());
                for lane in 0..LANES {
                    let place = [fluid.x[at + lane], fluid.y[at + lane]];
                    let mut shift = [shift_x[lane], shift_y[lane]];
                    for plane in planes {
                        let distance = -plane.beyond(place);
                        if distance < 1.5 * reach {
                            let fade = (distance / reach - 0.5).clamp(0.0, 1.0);
                            shift = plane.with_across(shift, |across| across * fade);
                        }
                    }
                    [shift_x[lane], shift_y[lane]] = shift;
                }
                (dx, dy) = (L::load(&shift_x), L::load(&shift_y));
            }
            let [gradient_x, gradient_y] =
                all_lanes::<L, 2>([&work.gradient_x, &work.gradient_y], at);
            let rise = (dx * gradient_x + dy * gradient_y) * L::splat(inverse_radius)
                - L::splat(slope) * dy;
            let density = lanes::<L>(&fluid.density, at);
            let elastic = lanes::<L>(&work.pressure, at).div(density * density) * rise;
            gained += lanes::<L>(&fluid.mass, at) * (L::splat(options.gravity) * dy + elastic);
            store(&mut fluid.x, at, x + dx);
            store(&mut fluid.y, at, y + dy);
            store(&mut fluid.density, at, density + rise);
        }
        -gained.sum()
    }
}
