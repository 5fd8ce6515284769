//! The free surface: a level read through a kernel, corrected for the kernel's width.
//!
//! A level is the height at which a kernel is half full. If the surface is level, that is the
//! surface. Otherwise the kernel gives the mean of η over its width, weighted with w(|x|/R) along
//! the surface. Beside a wall the error is the slope times the kernel's first moment. Everywhere it
//! is the curvature times half its second moment. Slope and curvature come from a second reading
//! half a radius away. A crest is sharp, and a reading from farther away would give too small a
//! curvature.

use std::collections::VecDeque;

use super::window::RunningMean;
use crate::kernel::KernelChoice;
use crate::scheme::Scheme;

/// Distance of the second reading, over R.
pub(super) const APART: f64 = 0.5;
/// Bound of the water's slope at a wall: the acceleration at an instant may be noise.
const STEEPEST: f64 = 1.0;
/// The level's own acceleration is found over two stretches, each this many times the span of the
/// wall's.
const STRETCH: f64 = 2.0;
/// Number of levels over both stretches.
const KEPT: usize = 17;
/// Water that falls with the tip has at least this share of its weight.
const LIGHTEST: f64 = 0.3;

/// The moments of a kernel, for a curved surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lens {
    /// R, metres.
    radius: f64,
    /// ⟨|x|⟩/R.
    first: f64,
    /// ⟨x²⟩/R².
    second: f64,
    /// ⟨|x + R/2|⟩/R.
    aside: f64,
}

impl Lens {
    /// Of a kernel with this support radius, metres.
    pub(super) fn of((kernel, radius): (KernelChoice, f64)) -> Lens {
        let [first, second, aside] = kernel.line_moments();
        Lens { radius, first, second, aside }
    }

    /// Height from which a level is searched upwards beside a wall with the level `at_wall`, over a
    /// bed of this height; metres. Nearer to the bed half of the kernel is empty.
    pub(super) fn from(&self, at_wall: f64, bed: f64) -> f64 {
        (at_wall - 1.5 * self.radius).max(bed + 0.5 * self.radius)
    }

    /// The level of the surface at x, metres above the bed, from three readings.
    pub(super) fn level_in_water(&self, water: &mut dyn Scheme, x: f64, from: f64) -> f64 {
        let apart = APART * self.radius;
        let [left, here, right] = [x - apart, x, x + apart].map(|x| water.level_in_water(x, from));
        self.straightened([left, here, right])
    }

    /// The middle one of three levels, half a radius apart, corrected for the curvature.
    fn straightened(&self, [left, here, right]: [f64; 3]) -> f64 {
        here - 0.5 * self.second / (APART * APART) * (left + right - 2.0 * here)
    }

    /// The level at a wall. `at_wall` was read there, `inside` half a radius away. The surface
    /// rises from the wall with this slope. The wall mirrors the surface.
    fn at_wall(&self, [at_wall, inside]: [f64; 2], slope: f64) -> f64 {
        let rise = slope * self.radius;
        // ½ η'' R²
        let bend = (inside - at_wall - rise * (self.aside - self.first)) / (APART * APART);
        at_wall - self.first * rise - self.second * bend
    }
}

/// Follows the level at an upright wall.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct WallLevel {
    /// Both readings over still water, metres above the bed.
    at_rest: Option<[f64; 2]>,
    /// The wall's acceleration, m/s².
    acceleration: RunningMean,
    slope: f64,
    /// Times, s, and levels, m, at the distance `apart`, s.
    recent: VecDeque<(f64, f64)>,
    apart: f64,
}

impl WallLevel {
    /// The wall's acceleration is averaged over `span` seconds.
    pub(super) fn new(span: f64) -> WallLevel {
        WallLevel {
            at_rest: None,
            acceleration: RunningMean::new(span),
            slope: 0.0,
            recent: VecDeque::with_capacity(KEPT + 1),
            apart: 2.0 * STRETCH * span / (KEPT - 1) as f64,
        }
    }

    /// The acceleration of the level upwards, m/s², from three levels.
    fn rising(&self) -> f64 {
        let [Some(&(t0, y0)), Some(&(t1, y1)), Some(&(t2, y2))] =
            [0, KEPT / 2, KEPT - 1].map(|k| self.recent.get(k))
        else {
            return 0.0;
        };
        2.0 * ((y2 - y1) / (t2 - t1) - (y1 - y0) / (t1 - t0)) / (t2 - t0)
    }

    /// Takes the wall's acceleration, m/s², and the level read there, m. The surface is a line of
    /// equal pressure. Let the wall accelerate away from the water with a, and the water at it
    /// upwards with v'. Then the surface rises inwards with the slope a/(g + v').
    pub(super) fn feel(&mut self, time: f64, (acceleration, level): (f64, f64), gravity: f64) {
        if self.recent.back().is_none_or(|&(last, _)| time >= last + self.apart) {
            self.recent.push_back((time, level));
            if self.recent.len() > KEPT {
                self.recent.pop_front();
            }
        }
        if let Some((_, mean)) = self.acceleration.push(time, acceleration) {
            let weight = (gravity + self.rising()).max(LIGHTEST * gravity);
            self.slope = (mean / weight).clamp(-STEEPEST, STEEPEST);
        }
    }

    /// The level at the wall in still water, metres above the bed; 0 before the first reading.
    pub(super) fn at_rest(&self) -> f64 {
        self.at_rest.map_or(0.0, |[at_wall, _]| at_wall)
    }

    /// The level over still water, metres, from the reading at the wall and, at an upright wall,
    /// from that half a radius away.
    pub(super) fn over_rest(&mut self, lens: &Lens, at_wall: f64, inside: Option<f64>) -> f64 {
        let now = [at_wall, inside.unwrap_or(at_wall)];
        let at_rest = *self.at_rest.get_or_insert(now);
        if inside.is_none() {
            return at_wall - at_rest[0];
        }
        lens.at_wall([0, 1].map(|place| now[place] - at_rest[place]), self.slope)
    }

    /// The runup over a bed, from the runup as read and the level at the wall; all in metres. The
    /// still water's depth is `depth`. The bed ends at the height `toe`, and `crown` is its
    /// highest.
    ///
    /// If still water does not reach the wall, its edge on the slope is read too low, at rest and
    /// later. This is not so on top of the bed and at a wall there.
    pub(super) fn over_dry(
        &self,
        runup: f64,
        [at_wall, depth]: [f64; 2],
        [toe, crown]: [f64; 2],
    ) -> f64 {
        if self.at_rest() > toe {
            runup
        } else if at_wall < crown {
            runup.min((crown - depth).max(0.0))
        } else {
            at_wall - depth
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kernel's reading of η(x) at 0, or beside a wall at 0.
    fn read(kernel: KernelChoice, radius: f64, surface: impl Fn(f64) -> f64, wall: bool) -> f64 {
        let n = 4000;
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..n {
            let q = (f64::from(k) + 0.5) / f64::from(n);
            let w = kernel.shape_at(q);
            let x = q * radius;
            sum += w * if wall { surface(x) } else { 0.5 * (surface(x) + surface(-x)) };
            weights += w;
        }
        sum / weights
    }

    #[test]
    fn slope_and_bend_are_made_up_for() {
        let radius = 0.04;
        for kernel in KernelChoice::ALL {
            let lens = Lens::of((kernel, radius));
            let surface = |x: f64| 0.2 + 0.3 * x - 4.0 * x * x;
            let shifted = |by: f64| move |x: f64| surface(x + by);
            let [left, here, right] =
                [-0.5, 0.0, 0.5].map(|by| read(kernel, radius, shifted(by * radius), false));
            assert!((here - 0.2).abs() > 1e-4, "{kernel:?}");
            assert!((lens.straightened([left, here, right]) - 0.2).abs() < 1e-7, "{kernel:?}");
            let at_wall = read(kernel, radius, surface, true);
            let mirrored = |x: f64| surface((x + 0.5 * radius).abs());
            let inside = read(kernel, radius, mirrored, false);
            assert!((at_wall - 0.2).abs() > 1e-3, "{kernel:?}");
            assert!((lens.at_wall([at_wall, inside], 0.3) - 0.2).abs() < 1e-4, "{kernel:?}");
        }
    }

    #[test]
    fn the_slope_is_that_of_a_line_of_equal_pressure() {
        let mut level = WallLevel::new(0.01);
        for k in 0..30 {
            level.feel(0.001 * f64::from(k), (2.0, 0.2), 10.0);
        }
        assert!((level.slope - 0.2).abs() < 1e-12);
        let mut falling = WallLevel::new(0.01);
        for k in 0..60 {
            let time = 0.001 * f64::from(k);
            falling.feel(time, (2.0, 0.3 + 0.7 * time - 2.5 * time * time), 10.0);
        }
        assert!((falling.slope - 0.4).abs() < 1e-9, "{}", falling.slope);
        let lens = Lens { radius: 0.1, first: 0.25, second: 0.07, aside: 0.55 };
        level.over_rest(&lens, 0.2, Some(0.2));
        // The kernel reads a plane surface of that slope as its mean.
        let told = level.over_rest(&lens, 0.305, Some(0.311));
        assert!((told - 0.1).abs() < 1e-12, "{told}");
        assert_eq!(WallLevel::new(0.01).over_rest(&lens, 0.3, None), 0.0);
    }
}
