//! Water that has come to rest, for the next case that starts with the same water.
//!
//! The relaxation of water does not depend on the wave that follows. So in a process only the first
//! case with some water computes it. Later cases with the same water start from its state, with the
//! same bits.

use std::sync::{Mutex, PoisonError};

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::run::Run;
use crate::boundary::Ghosts;
use crate::math::simd::SimdPath;
use crate::scheme::SchemeState;

/// States are kept up to this many bytes in all.
const ROOM: usize = 32 << 20;

/// The states of this process, the latest first.
static KEPT: Mutex<Vec<Rested>> = Mutex::new(Vec::new());

/// Identifies water before its relaxation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Key([u8; 32]);

/// Water at rest.
#[derive(Debug, Clone)]
struct Rested {
    key: Key,
    /// The state of the water, as bytes.
    state: Vec<u8>,
    steps: u64,
}

impl Key {
    /// For a run before its start: all that decides how its water comes to rest.
    pub fn of(run: &Run, path: SimdPath) -> Key {
        let Ghosts { x, y, target_x, target_y, volume, .. } = run.tank.water.walls();
        let mut hash = Sha256::new();
        let mut take = |bytes: Vec<u8>| {
            hash.update(bytes.len().to_le_bytes());
            hash.update(bytes);
        };
        take(serde_json::to_vec(&run.config.before_wave()).expect("a configuration serialises"));
        take(bytes(&run.tank.water.state()));
        take(bytes(&[x, y, target_x, target_y, volume]));
        take(bytes(&(run.time_step, format!("{path:?}"))));
        Key(hash.finalize().into())
    }
}

/// The water at rest with this key, and the number of its steps.
pub(super) fn recall(key: &Key) -> Option<(SchemeState, u64)> {
    let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    let rested = kept.iter().find(|rested| rested.key == *key)?;
    Some((postcard::from_bytes(&rested.state).ok()?, rested.steps))
}

/// Keeps water that took this many steps to come to rest. If room is short, the oldest is dropped.
pub(super) fn keep(key: Key, state: &SchemeState, steps: u64) {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    kept.retain(|rested| rested.key != key);
    kept.insert(0, Rested { key, state: bytes(state), steps });
    let mut room = ROOM;
    kept.retain(|rested| {
        let fits = rested.state.len() <= room;
        room = room.saturating_sub(rested.state.len());
        fits
    });
}

fn bytes(of: &impl Serialize) -> Vec<u8> {
    postcard::to_stdvec(of).expect("a state always serialises")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::team::Team;
    use crate::scene::CaseConfig;
    use crate::simulation::{CaseResult, Unwatched, run_case};

    fn shore(wave: f64, more: &str, numerics: &str) -> CaseConfig {
        let scene = format!(
            "wave_height_ratio = {wave}\nend_after_stroke_centre_s = 0.5\ntank_length_m = 2\n\
             bed = [[0, 0], [1.4, 0], [2, 0.3]]\n{more}"
        );
        let numerics = format!("particle_spacing_m = 0.04\nboundary = \"normalized\"\n{numerics}");
        CaseConfig::of(&scene, &numerics)
    }

    fn key(config: &CaseConfig) -> Key {
        let path = SimdPath::widest();
        Key::of(&Run::start(config, path, &Team::default()), path)
    }

    fn result(config: &CaseConfig) -> CaseResult {
        run_case(config, None, SimdPath::widest(), &Unwatched).unwrap()
    }

    #[test]
    fn what_comes_before_the_wave_tells_waters_apart() {
        let one = key(&shore(0.2, "", ""));
        for (wave, more) in [
            (0.15, ""),
            (0.2, "wave_gauge_m = 0.5"),
            (0.2, "end_time_s = 3"),
            (0.2, "runup_thickness_m = 0.04"),
        ] {
            assert_eq!(key(&shore(wave, more, "")), one, "{wave} {more}");
        }
        for (more, numerics) in [
            ("gravity_m_per_s2 = 9.8", ""),
            ("", "relaxation_time_s = 1"),
            ("", "artificial_viscosity = 0.05"),
            ("", "courant_number = 0.5"),
            ("absorption = true", ""),
        ] {
            assert_ne!(key(&shore(0.2, more, numerics)), one, "{more} {numerics}");
        }
    }

    #[test]
    fn another_wave_goes_on_from_water_at_rest_to_the_same_bits() {
        let (first, second) = (shore(0.25, "", ""), shore(0.3, "", ""));
        let (whole, key) = (result(&second), key(&first));
        // The second case has stored its water, which it must not find again.
        KEPT.lock().unwrap().retain(|rested| rested.key != key);
        result(&first);
        let (state, steps) = recall(&key).expect("kept");
        let again = result(&second);
        assert_eq!((again.history, again.energy), (whole.history, whole.energy));
        // The stored state is used: with one more step in it, the run has one more step.
        keep(key, &state, steps + 1);
        assert_eq!(result(&second).outcome.steps, whole.outcome.steps + 1);
        keep(key, &state, steps);
    }
}
