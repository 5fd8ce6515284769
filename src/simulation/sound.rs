//! The force of the water's compression on an upright wall.
//!
//! The divergence of the equation of motion is ∇²p = -ρ tr(∇u)² - ρ D(∇·u)/Dt. In incompressible
//! water the last term is zero. In weakly compressible water it is D²ρ/Dt². Multiply by the
//! potential φ of a wall that starts to move ([`wall_potential`]), and integrate over the water. By
//! Green's theorem the last term adds this to the force:
//! ```text
//! ΔF = -∫ φ D²ρ/Dt² dV = -(d/dt Σ V φ Dρ/Dt - Σ V Dφ/Dt Dρ/Dt)
//! ```
//! At the largest force of a steep wave it is some percent of the force, in proportion to 1/c0². φ
//! is that of level water. Its depth is the mean depth of the water within φ's own reach.

use serde::{Deserialize, Serialize};

use crate::body::BodyMotion;
use crate::scene::{Scene, SeawallScene, Tank};
use crate::scheme::Scheme;
use crate::theory::wall_potential::{tabulate, wall_potential};

/// The first mode of φ falls by a factor of e over this distance from the wall, over the depth: 2/π.
const REACH: f64 = std::f64::consts::FRAC_2_PI;
/// Below this force, over ρgh²/2, sound does not matter.
const QUIET: f64 = 1.1;
/// φ is cut off at this distance from the wall, over the depth.
const FARTHEST: f64 = 3.0;

/// The mean of both sums over the steps from one full step to the next.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Compression {
    /// The middle of these steps, s.
    pub time: f64,
    /// Σ V φ Dρ/Dt over ρgh²/2, s.
    pub rate: f64,
    /// Σ V Dφ/Dt Dρ/Dt over ρgh²/2.
    pub carried: f64,
    /// Depth of the water within φ's reach, m.
    pub depth: f64,
}

/// Sums over the water before a wall, from one full step to the next.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Sound {
    /// Time of the last step, s, and the depth of the water then, m.
    last: Option<(f64, f64)>,
    /// Sums of time, rate, carried and depth over `steps` steps.
    sums: [f64; 4],
    steps: u32,
}

impl Sound {
    /// For an upright wall over a flat bed that waves hit, in compressible water.
    pub(super) fn of(scene: &Scene, tank: &Tank) -> Option<Sound> {
        let plain = scene.seawall().is_some_and(SeawallScene::is_upright_over_level_bed);
        (plain && tank.water.density_rates().is_some()).then(|| {
            tabulate();
            Sound::default()
        })
    }

    /// Listens in a step in which the water presses the wall with `force`, if that is large enough.
    /// Both forces are in N per metre of width. See `listen`.
    pub(super) fn hear(
        &mut self,
        water: &dyn Scheme,
        now: (f64, f64),
        wall: (f64, BodyMotion),
        (force, static_force): (f64, f64),
    ) -> Option<Compression> {
        if force > QUIET * static_force {
            return self.listen(water, now, wall, static_force);
        }
        self.miss()
    }

    /// Records that the sound is not known now.
    pub(super) fn miss(&mut self) -> Option<Compression> {
        *self = Sound::default();
        None
    }

    /// Takes a step's readings at `time`, s. The wall's face at rest is at `face`, m, and the
    /// water's level there is `level`, m. At the end of a turn of steps it returns their mean, over
    /// `scale`, N/m.
    fn listen(
        &mut self,
        water: &dyn Scheme,
        (time, level): (f64, f64),
        (face, wall): (f64, BodyMotion),
        scale: f64,
    ) -> Option<Compression> {
        let rates = water.density_rates()?;
        let turn = self.take_turn(water.can_be_kept(), scale);
        let (earlier, before) = self.last.unwrap_or((time, level));
        let before = before.max(f64::MIN_POSITIVE);
        let face = face + wall.offset;
        let end = end(water);
        let depth = mean_depth(water, face, REACH * before);
        let rising = self.last.map_or(0.0, |_| (depth - before) / (time - earlier));
        self.last = Some((time, depth));
        let fluid = water.fluid();
        let (mut rate, mut carried) = (0.0, 0.0);
        for (k, density_rate) in rates.iter().enumerate().take(fluid.len()) {
            let (xi, eta) = ((face - fluid.x[k]) / depth, fluid.y[k] / depth);
            if xi > FARTHEST || fluid.x[k] > end {
                continue;
            }
            let [value, along, up] = wall_potential(xi, eta);
            let growth = fluid.mass[k] / fluid.density[k] * density_rate;
            rate += growth * value * depth;
            let moved = along * (wall.velocity - fluid.vx[k]) + up * fluid.vy[k];
            carried += growth * (moved + (value - xi * along - eta * up) * rising);
        }
        for (sum, part) in self.sums.iter_mut().zip([time, rate, carried, depth]) {
            *sum += part;
        }
        self.steps += 1;
        turn
    }

    /// The mean of the steps since the last full one, if the coming step is a full one.
    fn take_turn(&mut self, full: bool, scale: f64) -> Option<Compression> {
        if !full {
            return None;
        }
        let steps = f64::from(std::mem::take(&mut self.steps));
        let [time, rate, carried, depth] = std::mem::take(&mut self.sums).map(|sum| sum / steps);
        let told = Compression { time, rate: rate / scale, carried: carried / scale, depth };
        (steps > 0.0).then_some(told)
    }
}

/// The largest x of water that counts, m. Water kept behind a wall does not act on it.
fn end(water: &dyn Scheme) -> f64 {
    let crest = water.walls().crest.as_ref().filter(|crest| crest.end.is_some());
    crest.map_or(f64::INFINITY, |crest| crest.ends[1])
}

/// The mean depth of the water up to this distance from the wall, m.
fn mean_depth(water: &dyn Scheme, face: f64, width: f64) -> f64 {
    let (fluid, end) = (water.fluid(), end(water));
    let near = (0..fluid.len()).filter(|&k| fluid.x[k] > face - width && fluid.x[k] <= end);
    near.map(|k| fluid.mass[k] / fluid.density[k]).sum::<f64>() / width
}
