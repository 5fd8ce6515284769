//! One run of the tank: Runge-Kutta steps of water and wall, the stop, the readings.

use seawall::body::{GoringPaddle, PaddleLaw};
use seawall::math::root::bisected;

use super::gmres::NotConverged;
use super::grid::Grading;
use super::law::{DENSITY, DEPTH, GRAVITY, LENGTH, STATIC_FORCE, Spring};
use super::motion;
use super::readings::{Readings, Sample};
use super::settings::Settings;
use super::water::{Faces, Flow, Guess, Surface, quadrature};

/// Readings are taken at the multiples of this, seconds, and in between.
pub const CHUNK: f64 = 0.005;
/// The run ends so long after the stroke's centre, seconds.
const AFTER_CENTRE: f64 = 3.0;
/// Points on each face.
const FACE_POINTS: usize = 32;
/// Smallest share of the usual step.
const MOST_HALVINGS: i32 = 6;
/// A run has failed once its energy is off by this share of the wave's.
const ENERGY_BOUND: f64 = 2e-3;

/// Everything that changes with time.
#[derive(Debug, Clone)]
struct State {
    surface: Surface,
    /// X (m) and V (m/s) of the wall.
    wall: [f64; 2],
    /// Work done on the water, J per metre of width.
    work: f64,
}

/// What drives a state at one instant.
struct Rates {
    surface: Surface,
    wall: [f64; 2],
    work: f64,
    /// Kg per metre of width.
    added_mass: f64,
    /// Fastest relative stretching of the surface, 1/s.
    stretching: f64,
}

/// A run at some time.
#[derive(Clone)]
pub struct Tank {
    settings: Settings,
    paddle: GoringPaddle,
    spring: Option<Spring>,
    spacings: Vec<f64>,
    rule: Vec<(f64, f64)>,
    state: State,
    guess: Guess,
    time: f64,
    steps: u64,
    /// Energy of a solitary wave, J per metre of width: 8/√27 ρ g (H h)^{3/2}.
    wave_energy: f64,
    /// What was read so far.
    pub readings: Readings,
}

/// Why a run could not go on.
#[derive(Debug, Clone, PartialEq)]
pub struct Stopped {
    /// In plain words.
    pub reason: String,
    /// Seconds.
    pub time: f64,
}

impl State {
    /// This state and `dt` times the rates.
    fn moved(&self, rates: &Rates, dt: f64) -> State {
        let add = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + dt * b).collect();
        let (from, by) = (&self.surface, &rates.surface);
        State {
            surface: Surface {
                x: add(&from.x, &by.x),
                y: add(&from.y, &by.y),
                potential: add(&from.potential, &by.potential),
            },
            wall: [self.wall[0] + dt * rates.wall[0], self.wall[1] + dt * rates.wall[1]],
            work: self.work + dt * rates.work,
        }
    }
}

impl Tank {
    /// Water at rest before the first stroke, with a fixed wall.
    pub fn new(wave_height_ratio: f64, settings: Settings) -> Tank {
        let Settings { nodes, paddle, wall, floor, .. } = settings;
        let grading = Grading { paddle, wall, floor };
        let surface = Surface {
            x: grading.places(nodes, LENGTH),
            y: vec![DEPTH; nodes],
            potential: vec![0.0; nodes],
        };
        Tank {
            settings,
            paddle: GoringPaddle::new(wave_height_ratio, DEPTH, GRAVITY, 0.05),
            spring: None,
            spacings: grading.spacings(nodes),
            rule: quadrature(FACE_POINTS),
            state: State { surface, wall: [0.0; 2], work: 0.0 },
            guess: Guess::new(nodes),
            time: 0.0,
            steps: 0,
            wave_energy: 8.0 / 27.0_f64.sqrt()
                * DENSITY
                * GRAVITY
                * DEPTH.powi(3)
                * wave_height_ratio.powf(1.5),
            readings: Readings::new(),
        }
    }

    /// Lets the wall go.
    pub fn mount(&mut self, spring: Spring) {
        self.spring = Some(spring);
        self.readings.movable = true;
    }

    /// Seconds since the paddle's start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// When the run ends, seconds.
    pub fn end(&self) -> f64 {
        self.paddle.stroke_centre().unwrap_or(0.0) + AFTER_CENTRE
    }

    /// Runs on to the end, or until `enough`.
    ///
    /// # Errors
    /// Where the surface has broken.
    pub fn run(&mut self, enough: impl Fn(&Tank) -> bool) -> Result<(), Stopped> {
        let stopped =
            |tank: &Tank, reason: &str| Err(Stopped { reason: reason.to_owned(), time: tank.time });
        loop {
            let ended = self.time >= self.end() - 1e-9;
            match self.step(ended) {
                Err(NotConverged) => return stopped(self, "surface too sharp"),
                Ok(None) => return stopped(self, "surface moves too fast"),
                Ok(Some(_)) => {}
            }
            if self.readings.energy_error > ENERGY_BOUND {
                return stopped(self, "surface broke, energy is lost");
            }
            if ended {
                self.readings.settle();
            }
            if ended || enough(self) {
                return Ok(());
            }
        }
    }

    /// One step, with readings at its start; only these where `last`. `None`: no step is short enough.
    fn step(&mut self, last: bool) -> Result<Option<()>, NotConverged> {
        let on_stop = self.state.wall == [0.0; 2];
        let first = self.rates(&self.state.clone(), self.time, on_stop, true)?;
        if last {
            return Ok(Some(()));
        }
        let Some(dt) = self.step_length(&first) else { return Ok(None) };
        let mut dt = dt;
        let (mut next, added_mass) = self.attempt(&first, dt, on_stop)?;
        let mut stops = false;
        if self.spring.is_some() && next.wall[0] < 0.0 {
            // Meet the stop at the end of a shorter step.
            let from = self.state.wall;
            let mut share = crossing(from, next.wall, dt);
            for _ in 0..2 {
                let trial = self.attempt(&first, dt * share, on_stop)?.0;
                if trial.wall[1] < 0.0 {
                    share = (share - trial.wall[0] / (trial.wall[1] * dt)).clamp(0.0, 1.0);
                }
            }
            dt *= share;
            next = self.attempt(&first, dt, on_stop)?.0;
            stops = true;
        }
        self.time += dt;
        self.steps += 1;
        self.state = next;
        if stops {
            // Φ at the surface stays: the water's energy falls by that of the added mass.
            let speed = self.state.wall[1];
            self.readings.stop(added_mass * speed);
            self.state.work -= 0.5 * added_mass * speed * speed;
            self.state.wall = [0.0; 2];
        }
        let wall_at = LENGTH + self.state.wall[0];
        let paddle = self.paddle.motion(self.time);
        let surface = &mut self.state.surface;
        let end = surface.x.len() - 1;
        (surface.x[0], surface.x[end]) = (paddle.offset, wall_at);
        let speeds = [paddle.velocity, self.state.wall[1]];
        motion::smooth(surface, speeds, self.settings.smoothing);
        Ok(Some(()))
    }

    /// The usual step, halved as often as the surface or the wall asks for.
    fn step_length(&self, rates: &Rates) -> Option<f64> {
        let mut frequency = rates.stretching / self.settings.stretch;
        if let Some(spring) = self.spring {
            let mass = spring.mass + rates.added_mass;
            frequency = frequency.max((spring.stiffness / mass).sqrt() / self.settings.phase);
        }
        let usual = self.settings.step;
        let halvings = (frequency * usual).max(1.0).log2().ceil() as i32;
        if halvings > MOST_HALVINGS {
            return None;
        }
        let chunk = (self.time / CHUNK + 1e-6).floor() + 1.0;
        let left = (chunk * CHUNK).min(self.end()) - self.time;
        let dt = usual / 2.0_f64.powi(halvings);
        Some(left / (left / dt - 1e-6).ceil().max(1.0))
    }

    /// A Runge-Kutta step of fourth order; also the added mass at its end.
    fn attempt(
        &mut self,
        first: &Rates,
        dt: f64,
        on_stop: bool,
    ) -> Result<(State, f64), NotConverged> {
        let (from, time) = (self.state.clone(), self.time);
        let second = self.rates(&from.moved(first, 0.5 * dt), time + 0.5 * dt, on_stop, false)?;
        let third = self.rates(&from.moved(&second, 0.5 * dt), time + 0.5 * dt, on_stop, false)?;
        let fourth = self.rates(&from.moved(&third, dt), time + dt, on_stop, false)?;
        let next = from
            .moved(first, dt / 6.0)
            .moved(&second, dt / 3.0)
            .moved(&third, dt / 3.0)
            .moved(&fourth, dt / 6.0);
        Ok((next, fourth.added_mass))
    }

    /// Rates of a state at a time; takes readings there where `read`.
    fn rates(
        &mut self,
        state: &State,
        time: f64,
        on_stop: bool,
        read: bool,
    ) -> Result<Rates, NotConverged> {
        let motion = self.paddle.motion(time);
        let faces = Faces { paddle: [motion.velocity, motion.acceleration], wall: state.wall[1] };
        let mut surface = state.surface.clone();
        let end = surface.x.len() - 1;
        (surface.x[0], surface.x[end]) = (motion.offset, LENGTH + state.wall[0]);
        let flow = Flow::new(&surface, faces, &mut self.guess)?;
        let [paddle, wall] = flow.forces(&mut self.guess, self.spring.is_some(), &self.rule)?;
        let acceleration = self.spring.map_or(0.0, |spring| {
            spring.acceleration(state.wall[0], on_stop, wall.still, wall.added_mass)
        });
        let [pushed, [force, moment]] = [paddle, wall].map(|face| face.at(acceleration));
        let work = pushed[0] * motion.velocity - force * state.wall[1];
        if read {
            let energy = flow.energy(&self.rule) - state.work;
            let volume = flow.volume() / (LENGTH * DEPTH) - 1.0;
            self.readings.conserved(volume, energy / self.wave_energy);
            let (runup, rise) = (surface.y[end] / DEPTH - 1.0, flow.velocity[1][end] / DEPTH);
            let stops = self.readings.stops;
            let moment = moment / (STATIC_FORCE * DEPTH / 3.0);
            let values = [force / STATIC_FORCE, runup, state.wall[0] / DEPTH, moment];
            let rates = [rise, state.wall[1] / DEPTH];
            let sample = Sample { time, values, rates, stops };
            if self.readings.energy_error <= ENERGY_BOUND {
                self.readings.take(sample, &surface);
            }
        }
        let (moving, stretching) = motion::rates(&flow, &surface, faces, &self.spacings);
        Ok(Rates {
            surface: moving,
            wall: [state.wall[1], acceleration],
            work,
            added_mass: wall.added_mass,
            stretching,
        })
    }
}

/// Where the cubic through two states' places and speeds first crosses zero, as a share of `dt`.
fn crossing(from: [f64; 2], to: [f64; 2], dt: f64) -> f64 {
    let at = |s: f64| {
        let (p, q) = (1.0 - s, s);
        p * p * (1.0 + 2.0 * q) * from[0]
            + q * q * (1.0 + 2.0 * p) * to[0]
            + p * q * dt * (p * from[1] - q * to[1])
    };
    bisected([0.0, 1.0], |s| at(s) < 0.0)[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn settings(nodes: usize, step: f64) -> Settings {
        Settings {
            nodes,
            step,
            paddle: 0.1,
            wall: 0.2,
            floor: 0.03,
            smoothing: 0.05,
            phase: 0.25,
            stretch: 0.15,
        }
    }

    /// ω² = g k tanh(k h), and force and moment are those of linear theory.
    #[test]
    fn a_low_standing_wave_has_its_frequency() {
        let mut tank = Tank::new(1e-9, settings(97, 0.00125)); // a paddle as good as still
        let (wavenumber, height) = (4.0 * PI / LENGTH, 1e-6);
        let Surface { x, y, .. } = &mut tank.state.surface;
        for (x, y) in x.iter().zip(y.iter_mut()) {
            *y += height * (wavenumber * x).cos();
        }
        let depths = wavenumber * DEPTH;
        let frequency = (GRAVITY * wavenumber * depths.tanh()).sqrt();
        // Its pressure goes as cosh(k y) up the wall: force and moment on it by linear theory.
        let unit = DENSITY * GRAVITY * height / wavenumber;
        let tilt = DEPTH * depths.tanh() - (1.0 - 1.0 / depths.cosh()) / wavenumber;
        let still = [STATIC_FORCE, STATIC_FORCE * DEPTH / 3.0];
        while tank.time < 2.0 * PI / frequency {
            tank.step(false).unwrap().unwrap();
            for place in [0, 96] {
                let lift = (tank.state.surface.y[place] - DEPTH) / height;
                let exact = (frequency * tank.time).cos();
                assert!((lift - exact).abs() < 1e-4, "{lift} {exact}");
            }
            let (surface, faces) =
                (tank.state.surface.clone(), Faces { paddle: [0.0; 2], wall: 0.0 });
            let flow = Flow::new(&surface, faces, &mut tank.guess).unwrap();
            let [_, wall] = flow.forces(&mut tank.guess, false, &tank.rule).unwrap();
            for (k, amplitude) in [unit * depths.tanh(), unit * tilt].into_iter().enumerate() {
                let share = (wall.at(0.0)[k] - still[k]) / amplitude;
                let exact = (frequency * tank.time).cos();
                assert!((share - exact).abs() < 1e-3, "{k}: {share} {exact}");
            }
        }
        assert!(tank.readings.volume_error < 1e-12);
    }

    /// Two values of `results/validation/tank_reference.csv`, computed by another program.
    #[test]
    fn a_solitary_wave_climbs_a_fixed_wall_as_the_reference_says() {
        let mut tank = Tank::new(0.3, settings(81, 0.0025));
        tank.run(|tank| tank.time > 2.7).unwrap();
        tank.readings.settle();
        let measures = &tank.readings.measures;
        assert!((tank.readings.crest() - 0.300_619).abs() < 5e-4);
        assert!((measures.first_force.unwrap().value - 2.265_87).abs() < 5e-4);
        assert!((measures.first_runup.unwrap().value - 0.653_936).abs() < 5e-4);
        assert!(tank.readings.energy_error < 5e-4 && tank.readings.volume_error < 1e-5);
    }

    /// The stop's blow included.
    #[test]
    fn a_wall_comes_back_onto_its_stop_and_energy_is_accounted_for() {
        let mut tank = Tank::new(0.4, settings(81, 0.0025));
        tank.run(|tank| tank.readings.force() > 1.05).unwrap();
        tank.mount(Spring { mass: 50.0, stiffness: 1e4 });
        tank.run(|tank| tank.readings.stops > 0).unwrap();
        tank.run(|tank| tank.readings.history.len() % 8 == 0).unwrap();
        assert!(tank.readings.stop_impulse < -1e-3);
        assert!(tank.readings.energy_error < 1e-3, "{}", tank.readings.energy_error);
    }

    #[test]
    fn the_crossing_of_a_parabola_is_found() {
        let at = |t: f64| [0.1 - 0.3 * t - 0.4 * t * t, -0.3 - 0.8 * t];
        let exact = (-0.3 + (0.09_f64 + 0.16).sqrt()) / 0.8;
        assert!((crossing(at(0.0), at(0.5), 0.5) * 0.5 - exact).abs() < 1e-12);
    }
}
