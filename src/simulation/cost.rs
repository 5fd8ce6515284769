//! The cost of a case, and the resources of a run.

use serde::{Deserialize, Serialize};

use crate::math::simd::SimdPath;
use crate::math::team::Team;
use crate::scene::CaseConfig;

/// The resources that a run may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Resources {
    /// Instruction set of the hot loops.
    pub simd: SimdPath,
    /// Threads that may share the work of a step; a small case uses fewer. The answer is the same
    /// for any number, bit for bit.
    pub threads: usize,
}

impl From<SimdPath> for Resources {
    /// A single thread.
    fn from(simd: SimdPath) -> Resources {
        Resources { simd, threads: 1 }
    }
}

impl Resources {
    /// The threads for which a case has enough work.
    pub(super) fn team(self, config: &CaseConfig) -> Team {
        let most = cost(config).particles / PARTICLES_PER_THREAD;
        Team::of(self.threads.min(most as usize))
    }
}

/// With fewer particles each, threads would wait longer than they gain.
const PARTICLES_PER_THREAD: u64 = 2000;

/// The cost of a case, estimated before it runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Fluid particles.
    pub particles: u64,
    /// Steps from start to end, including those in which the water comes to rest.
    pub steps: u64,
    /// Share of the steps before the wall can move (0 where the scene does not branch).
    pub trunk_share: f64,
    /// Peak memory of a run, bytes.
    pub memory_bytes: u64,
}

/// Estimates a case's cost.
pub fn cost(config: &CaseConfig) -> Cost {
    let (scene, frame) = (&config.scene, config.scene.frame());
    let particles = scene.particles(&config.numerics) as u64;
    let end = frame.end_time;
    let start = scene.start_s();
    let relaxation = config.numerics.relaxation_time_s;
    let steps = ((end - start + relaxation) / frame.time_step(&config.numerics)).ceil() as u64;
    // The crest starts at the stroke's centre. The front reaches the wall when the crest is about
    // 0.6 of the way. This guess only has to rank cases.
    let onset = scene.seawall().map_or(0.0, |scene| {
        let celerity = (frame.gravity * frame.depth * (1.0 + scene.wave_height_ratio)).sqrt();
        let centre = scene.paddle().and_then(|paddle| paddle.stroke_centre());
        centre.map_or(0.0, |centre| centre + 0.6 * frame.length / celerity)
    });
    let rested = if relaxation > 0.0 { 250 * particles } else { 0 };
    let ghosts = scene.seawall().map_or(0.0, |scene| scene.wall_ghosts(&config.numerics));
    Cost {
        particles,
        steps,
        trunk_share: ((onset + relaxation) / (end + relaxation)).clamp(0.0, 1.0),
        memory_bytes: 8_000_000 + 1_500 * particles + rested + 1_000 * ghosts as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A crest 300 m wide once took 174 MB where 15 MB were estimated.
    #[test]
    fn ghosts_of_wide_crests_take_memory() {
        let memory = |behind: &str| {
            let scene = format!("crest_freeboard_m = 0.05\nbehind = {behind}");
            let config = CaseConfig::of(&scene, "particle_spacing_m = 0.01");
            cost(&config).memory_bytes / 1_000_000
        };
        assert_eq!(memory("\"outflow\"\ncrest_width_m = 0.3"), 15);
        assert_eq!(memory("\"outflow\"\ncrest_width_m = 300"), 165);
        let floor = "\"floor\"\ncrest_width_m = 0.3\nfloor_length_m = 100";
        assert_eq!(memory(floor), 65);
    }
}
