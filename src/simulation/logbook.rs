//! All records of a run so far.

use serde::{Deserialize, Serialize};

use super::absorption::Absorption;
use super::blows::Acoustics;
use super::energy::{Ledger, WaterEnergy};
use super::face_gaps::FaceGaps;
use super::found_energy::Found;
use super::gauge::CrestGauge;
use super::health::HealthState;
use super::looks::Looks;
use super::measures::{MEAN_SPAN, Measures};
use super::named_readings::ProbeTable;
use super::outcome::HistoryRow;
use super::overtopping::Overtopping;
use super::probes;
use super::settling::Liveliness;
use super::sound::Sound;
use super::surface::WallLevel;
use super::waves::Waves;
use crate::body::Place;
use crate::scene::{CaseConfig, Frame, Tank};

/// Memory is reserved for at most this many samples.
const MOST_ROOM: usize = 100_000;
/// The least number of looks at the wall's face between two checks of the energy.
const LOOK_EVERY: usize = 4;

/// The records of a run. A branch starts with those of its trunk.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Logbook {
    pub(super) measures: Measures,
    /// The effect of the water's compression on the force, if it can be found.
    pub(super) sound: Option<Sound>,
    pub(super) gauge: CrestGauge,
    pub(super) ledger: Ledger,
    pub(super) history: Vec<HistoryRow>,
    /// The first force on the wall, N per metre of width.
    pub(super) force_at_rest: Option<f64>,
    /// The first force on the wall less that on the paddle, over ρgh²/2.
    pub(super) lopsided: Option<f64>,
    /// The level of the water at the wall.
    pub(super) level: WallLevel,
    /// Largest difference between the force and the pressure on the wall's face, percent of the force.
    pub(super) worst_gap: f64,
    /// That difference at every sample.
    pub(super) face_gaps: FaceGaps,
    /// Energy that came from nowhere, at every check.
    pub(super) found: Found,
    pub(super) health: HealthState,
    pub(super) liveliness: Liveliness,
    pub(super) probes: Option<ProbeTable>,
    /// Water that goes over the wall, if it has a crest.
    pub(super) overtopping: Option<Overtopping>,
    /// The paddle's response to waves that come back, if it absorbs them.
    pub(super) absorption: Option<Absorption>,
}

impl Logbook {
    /// An empty logbook for water that starts with this energy.
    pub fn open(config: &CaseConfig, tank: &Tank, start: WaterEnergy) -> Logbook {
        let frame = tank.frame;
        let crest = tank.water.walls().crest.as_ref();
        let span = MEAN_SPAN * frame.unit_time();
        let acoustics = Acoustics {
            depth: frame.depth,
            depth_at_wall: config.scene.force_depth_m(),
            gravity: frame.acceleration(),
            sound_speed: tank.water.state_equation().map(|_| tank.sound_speed),
        };
        let sound = Sound::of(&config.scene, tank);
        let turn = f64::from(config.numerics.acoustic_substeps) * frame.time_step(&config.numerics);
        let mut measures = Measures::new(
            [tank.threshold_ratio, tank.impact_ratio],
            acoustics,
            sound.as_ref().map(|_| turn),
            points_on_wall(tank),
        );
        let period = tank.paddle.as_ref().and_then(|paddle| paddle.period());
        measures.waves = period.map(Waves::of);
        Logbook {
            measures,
            sound,
            gauge: CrestGauge::default(),
            ledger: Ledger::open(start, tank.start_time),
            history: Vec::new(),
            force_at_rest: None,
            lopsided: None,
            level: WallLevel::new(span),
            worst_gap: 0.0,
            face_gaps: FaceGaps::new(frame.unit_time()),
            found: Found::default(),
            health: HealthState::default(),
            liveliness: Liveliness::default(),
            probes: probes::table(config),
            absorption: tank.absorbs.then(|| Absorption::new(span, tank)),
            overtopping: crest.map(|_| Overtopping::open(tank.water.fluid())),
        }
    }

    /// Reserves memory for all samples and looks, within limits, so that none allocates on its own.
    pub fn make_room(&mut self, frame: &Frame) {
        let count = |interval: f64| ((frame.end_time / interval) as usize).saturating_add(2);
        let all = count(frame.history_interval);
        let more = all.saturating_sub(self.history.len()).min(MOST_ROOM);
        let looks = count(Looks::interval(frame.intervals()));
        let looks = looks.saturating_sub(self.face_gaps.len()).min(MOST_ROOM);
        self.history.reserve_exact(more);
        self.gauge.make_room();
        self.face_gaps.make_room(looks);
        self.found.make_room(looks / LOOK_EVERY + 1);
        if let Some(table) = &mut self.probes {
            table.time_s.reserve_exact(more);
            table.values.reserve_exact(more * table.columns.len());
        }
    }
}

/// Points at which the pressure on the wall is read.
fn points_on_wall(tank: &Tank) -> usize {
    tank.water.walls().up(Place::Right.number()).len()
}
