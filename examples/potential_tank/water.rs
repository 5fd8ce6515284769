//! The water at one instant: its flow and what follows from it (fully nonlinear potential theory).
//!
//! Φ = φ_p + φ with φ_p = V_p (x - x_p) + (V_w - V_p)/(2L) ((x - x_p)² - y²), harmonic, which takes
//! the velocities V_p of the paddle at x_p and V_w of the wall at x_w = x_p + L. So φ has still walls
//! and bed in the stretched place Z = (z - x_p)/L, at every time: its rate at fixed Z has, too.

use std::f64::consts::PI;

use super::conjugate::Conjugate;
use super::gmres::NotConverged;
use super::grid::{Parity, slope};
use super::law::{DENSITY, DEPTH, GRAVITY, LENGTH};

/// The surface's nodes from the paddle to the wall.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Metres.
    pub x: Vec<f64>,
    /// Metres above the bed.
    pub y: Vec<f64>,
    /// Φ, m²/s.
    pub potential: Vec<f64>,
}

/// Motion of the paddle and of the wall, without the wall's acceleration.
#[derive(Debug, Clone, Copy)]
pub struct Faces {
    /// Velocity (m/s) and acceleration (m/s²) of the paddle.
    pub paddle: [f64; 2],
    /// Velocity of the wall, m/s.
    pub wall: f64,
}

/// First guesses of the conjugates: the last ones found.
#[derive(Debug, Clone)]
pub struct Guess {
    flow: Vec<f64>,
    rate: Vec<f64>,
    unit: Vec<f64>,
}

impl Guess {
    /// Zeros.
    pub fn new(count: usize) -> Guess {
        let zeros = vec![0.0; count];
        Guess { flow: zeros.clone(), rate: zeros.clone(), unit: zeros }
    }
}

/// Forces on a face: F = `still` - `added_mass` a_w, N per metre of width. The moment about the foot
/// goes the same way, N.
#[derive(Debug, Clone, Copy, Default)]
pub struct Force {
    /// Where the wall does not accelerate.
    pub still: f64,
    /// Kg per metre of width.
    pub added_mass: f64,
    /// The moment where the wall does not accelerate.
    pub still_moment: f64,
    /// Its part for the acceleration, kg.
    pub added_moment: f64,
}

impl Force {
    /// The force and the moment at this acceleration of the wall, m/s².
    pub fn at(&self, acceleration: f64) -> [f64; 2] {
        [
            self.still - self.added_mass * acceleration,
            self.still_moment - self.added_moment * acceleration,
        ]
    }
}

/// The flow under a surface.
pub struct Flow<'a> {
    surface: &'a Surface,
    faces: Faces,
    conjugate: Conjugate,
    /// dφ/dj and dψ/dj, φ and ψ.
    remainder: [Vec<f64>; 2],
    along: [Vec<f64>; 2],
    /// dx/dj and dy/dj.
    pub slope: [Vec<f64>; 2],
    /// Velocity at the nodes, m/s.
    pub velocity: [Vec<f64>; 2],
    length: f64,
}

impl<'a> Flow<'a> {
    /// # Errors
    /// Where Laplace's equation could not be solved.
    pub fn new(
        surface: &'a Surface,
        faces: Faces,
        guess: &mut Guess,
    ) -> Result<Flow<'a>, NotConverged> {
        let Surface { x, y, potential } = surface;
        let (count, start) = (x.len(), x[0]);
        let length = x[count - 1] - start;
        let scaled = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| v / length).collect() };
        let slopes = [slope(x, Parity::Odd), slope(y, Parity::Even)];
        let across: Vec<f64> = x.iter().map(|x| (x - start) / length).collect();
        let conjugate =
            Conjugate::new(&across, &scaled(y), &scaled(&slopes[0]), &scaled(&slopes[1]));
        let (paddle, stretch) = (faces.paddle[0], (faces.wall - faces.paddle[0]) / length);
        let remainder: Vec<f64> = (0..count)
            .map(|j| potential[j] - particular(paddle, stretch, x[j] - start, y[j]))
            .collect();
        let along = slope(&remainder, Parity::Even);
        conjugate.solve(&remainder, &along, &mut guess.flow)?;
        let stream = guess.flow.clone();
        let stream_along = slope(&stream, Parity::Odd);
        let mut velocity = [vec![0.0; count], vec![0.0; count]];
        for j in 0..count {
            let (xj, yj) = (slopes[0][j], slopes[1][j]);
            let over = 1.0 / (xj * xj + yj * yj);
            let u = (along[j] * xj + stream_along[j] * yj) * over;
            let v = (along[j] * yj - stream_along[j] * xj) * over;
            velocity[0][j] = u + paddle + stretch * (x[j] - start);
            velocity[1][j] = v - stretch * y[j];
        }
        let (remainder, along) = ([remainder, stream], [along, stream_along]);
        Ok(Flow { surface, faces, conjugate, remainder, along, slope: slopes, velocity, length })
    }

    /// (V_w - V_p)/L, 1/s.
    fn stretch(&self) -> f64 {
        (self.faces.wall - self.faces.paddle[0]) / self.length
    }

    /// ∂φ_p/∂t at a fixed place without the wall's acceleration; `x` is measured from the paddle.
    fn particular_rate(&self, x: f64, y: f64) -> f64 {
        let ([paddle, acceleration], stretch) = (self.faces.paddle, self.stretch());
        let bend = -acceleration / (2.0 * self.length) - 0.5 * stretch * stretch;
        acceleration * x - paddle * paddle + bend * (x * x - y * y) - stretch * x * paddle
    }

    /// Forces on the paddle and on the wall. `quadrature` holds places and weights over 0 to 1.
    /// The rate of φ at fixed Z is found like φ itself, its values at the surface by p = 0.
    ///
    /// # Errors
    /// Where Laplace's equation could not be solved.
    pub fn forces(
        &self,
        guess: &mut Guess,
        movable: bool,
        quadrature: &[(f64, f64)],
    ) -> Result<[Force; 2], NotConverged> {
        let Surface { x, y, .. } = self.surface;
        let (count, length, stretch) = (x.len(), self.length, self.stretch());
        let paddle = self.faces.paddle[0];
        let mut rate = vec![0.0; count];
        let mut unit = vec![0.0; count]; // the same, per acceleration of the wall
        for j in 0..count {
            let (at, up) = (x[j] - x[0], y[j]);
            let (u, v) = (self.velocity[0][j], self.velocity[1][j]);
            let carried = paddle + stretch * at;
            let drift = carried * (u - carried) + stretch * up * (v + stretch * up);
            rate[j] = drift
                - self.particular_rate(at, up)
                - 0.5 * (u * u + v * v)
                - GRAVITY * (up - DEPTH);
            unit[j] = -(at * at - up * up) / (2.0 * length);
        }
        let solve = |values: &[f64], stream: &mut [f64]| {
            self.conjugate.solve(values, &slope(values, Parity::Even), stream)
        };
        solve(&rate, &mut guess.rate)?;
        if movable {
            solve(&unit, &mut guess.unit)?;
        }
        let flow = self.conjugate.rate(&self.along[0], &self.along[1]);
        let mut forces = [Force::default(); 2];
        for (face, force) in forces.iter_mut().enumerate() {
            let top = y[face * (count - 1)];
            let (sign, at) = ([1.0, -1.0][face], [0.0, length][face]);
            let speed = [paddle, self.faces.wall][face];
            for &(place, weight) in quadrature {
                let up = place * top;
                let angle = PI * up / length;
                let [gradient, rate, unit] = self.conjugate.at_axis(
                    sign * angle.cosh(),
                    [(&flow[0], &flow[1]), (&rate, &guess.rate), (&unit, &guess.unit)],
                );
                let rise = sign * gradient * PI / length * angle.sinh();
                let v = rise - stretch * up;
                let head = self.particular_rate(at, up) + rate - stretch * up * rise
                    + 0.5 * (speed * speed + v * v)
                    + GRAVITY * (up - DEPTH);
                let weight = DENSITY * weight * top;
                let added = weight * (unit + (at * at - up * up) / (2.0 * length));
                force.still -= weight * head;
                force.still_moment -= weight * head * up;
                if movable {
                    force.added_mass += added;
                    force.added_moment += added * up;
                }
            }
        }
        Ok(forces)
    }

    /// Kinetic and potential energy over that of still water, J per metre of width:
    /// ρ/2 ∮ Φ dΨ + ρ g/2 ∫ y² dx.
    pub fn energy(&self, quadrature: &[(f64, f64)]) -> f64 {
        let Surface { x, y, potential } = self.surface;
        let count = x.len();
        let mut sum = 0.0;
        for j in 0..count {
            let weight = if j == 0 || j == count - 1 { 0.5 } else { 1.0 };
            let (xj, yj) = (self.slope[0][j], self.slope[1][j]);
            let outflow = self.velocity[1][j] * xj - self.velocity[0][j] * yj;
            sum += weight * (potential[j] * outflow + GRAVITY * y[j] * y[j] * xj);
        }
        for (face, speed) in [-self.faces.paddle[0], self.faces.wall].into_iter().enumerate() {
            let (top, at) = (y[face * (count - 1)], [0.0, self.length][face]);
            for &(place, weight) in quadrature {
                let up = place * top;
                let zeta = [1.0, -1.0][face] * (PI * up / self.length).cosh();
                let values = (&self.remainder[0][..], &self.remainder[1][..]);
                let [value] = self.conjugate.at_axis(zeta, [values]);
                let total = value + particular(self.faces.paddle[0], self.stretch(), at, up);
                sum += weight * top * speed * total;
            }
        }
        0.5 * DENSITY * (sum - GRAVITY * DEPTH * DEPTH * LENGTH)
    }

    /// ∫ y dx, m².
    pub fn volume(&self) -> f64 {
        let (y, count) = (&self.surface.y, self.surface.y.len());
        let inner: f64 = (1..count - 1).map(|j| y[j] * self.slope[0][j]).sum();
        inner + 0.5 * (y[0] * self.slope[0][0] + y[count - 1] * self.slope[0][count - 1])
    }
}

/// φ_p at a place measured from the paddle; `stretch` is (V_w - V_p)/L.
pub fn particular(paddle: f64, stretch: f64, x: f64, y: f64) -> f64 {
    paddle * x + 0.5 * stretch * (x * x - y * y)
}

/// Places and weights of Gauss and Legendre's quadrature over 0 to 1.
pub fn quadrature(count: usize) -> Vec<(f64, f64)> {
    let legendre = |z: f64| {
        let (mut last, mut value) = (1.0, z);
        for n in 1..count {
            let n = n as f64;
            (last, value) = (value, ((2.0 * n + 1.0) * z * value - n * last) / (n + 1.0));
        }
        (value, count as f64 * (z * value - last) / (z * z - 1.0))
    };
    let rule = |k: usize| {
        let mut z = (PI * (k as f64 + 0.75) / (count as f64 + 0.5)).cos();
        for _ in 0..50 {
            let (value, slope) = legendre(z);
            z -= value / slope;
        }
        let slope = legendre(z).1;
        (0.5 * (1.0 + z), 1.0 / ((1.0 - z * z) * slope * slope))
    };
    (0..count).map(rule).collect()
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grading;
    use super::*;

    fn still(count: usize) -> Surface {
        let grading = Grading { paddle: 0.1, wall: 0.15, floor: 0.02 };
        let x = grading.places(count, LENGTH);
        Surface { y: vec![DEPTH; count], potential: vec![0.0; count], x }
    }

    #[test]
    fn still_water_weighs_on_its_walls_and_adds_the_known_mass() {
        let surface = still(129);
        let mut guess = Guess::new(129);
        let faces = Faces { paddle: [0.0; 2], wall: 0.0 };
        let flow = Flow::new(&surface, faces, &mut guess).unwrap();
        let [_, wall] = flow.forces(&mut guess, true, &quadrature(32)).unwrap();
        assert!((wall.still - 0.5 * DENSITY * GRAVITY * DEPTH * DEPTH).abs() < 1e-9);
        // Σ 16/(π³ (2n-1)³) = 14 ζ(3)/π³ = 0.5428 (Westergaard 1933), here in a long tank.
        let exact = 0.542_755_5 * DENSITY * DEPTH * DEPTH;
        assert!((wall.added_mass / exact - 1.0).abs() < 1e-5, "{}", wall.added_mass / exact);
        assert!((flow.volume() - LENGTH * DEPTH).abs() < 1e-12);
    }

    /// Water between walls that both move at V is in uniform flow: no forces but the weight.
    #[test]
    fn a_tank_on_wheels_is_uniform_flow() {
        let mut surface = still(65);
        surface.potential = surface.x.iter().map(|x| 0.3 * x).collect();
        let mut guess = Guess::new(65);
        let faces = Faces { paddle: [0.3, 0.0], wall: 0.3 };
        let flow = Flow::new(&surface, faces, &mut guess).unwrap();
        assert!(flow.velocity[0].iter().all(|u| (u - 0.3).abs() < 1e-12));
        assert!(flow.velocity[1].iter().all(|v| v.abs() < 1e-12));
        let energy = flow.energy(&quadrature(32));
        assert!((energy - 0.5 * DENSITY * 0.09 * DEPTH * LENGTH).abs() < 1e-9);
        for force in flow.forces(&mut guess, false, &quadrature(32)).unwrap() {
            let head = force.still / DENSITY;
            assert!((head - 0.5 * GRAVITY * DEPTH * DEPTH).abs() < 1e-9, "{head}");
        }
    }
}
