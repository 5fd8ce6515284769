//! The results of one case: the scalars of `summary.csv` and the sampled histories.

use serde::{Deserialize, Serialize};

use super::health::HealthMargins;
use super::named_readings::{NamedReading, ProbeTable};
use super::waves::WaveRow;

/// A maximum and the time at which it was reached.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Maximum {
    /// The largest value, non-dimensional.
    pub value: f64,
    /// When, in seconds since the paddle's start.
    pub time_s: f64,
}

impl Maximum {
    /// Raises a maximum to a larger value at a time, seconds.
    pub(super) fn raise(maximum: &mut Option<Maximum>, value: f64, time_s: f64) {
        if maximum.is_none_or(|m| value > m.value) {
            *maximum = Some(Maximum { value, time_s });
        }
    }
}

/// Non-dimensional results of a finished case: F* = F/(ρ g h²/2), R* = runup/h, X* = X/h.
///
/// `None` if the scene has no such quantity: a fixed wall has no displacement, still water has no
/// wave height, a wave that never loads the wall has no first impact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Height over still water of the crest at the wave gauge, over h.
    pub measured_wave_height_ratio: Option<f64>,
    /// Largest F*, of the centred running mean over 0.07 √(h/g).
    pub force_max: Maximum,
    /// Largest R*.
    pub runup_max: Maximum,
    /// Largest X*.
    pub displacement_max: Option<Maximum>,
    /// Largest F* (running mean) over the first impact.
    pub first_force_max: Option<Maximum>,
    /// Largest R* over the first impact.
    pub first_runup_max: Option<Maximum>,
    /// Largest X* over the first impact.
    pub first_displacement_max: Option<Maximum>,
    /// F* of the first peak: the running maximum when F* - 1 has first dropped 10 % below it.
    pub first_force_peak: Option<f64>,
    /// R* of the first peak, likewise.
    pub first_runup_peak: Option<f64>,
    /// Largest F* of any single step in which the sound of a stop cannot be heard.
    pub force_max_raw: f64,
    /// The water's own force on the wall at rest, over ρgh²/2. The `force` columns are corrected by
    /// its difference from 1.
    #[serde(default)]
    pub force_at_rest: f64,
    /// F* at the end of the run.
    pub force_end: f64,
    /// R* at the end of the run.
    pub runup_end: f64,
    /// X* at the end of the run.
    pub displacement_end: Option<f64>,
    /// First time that F > F_threshold lasted 0.02 s.
    pub onset_time_s: Option<f64>,
    /// Goring's T/2: the instant at which the paddle passes the middle of its stroke.
    pub stroke_centre_s: Option<f64>,
    /// Whether the wall was still moving outwards at the end, so that its maximum is a lower bound.
    pub displacement_truncated: Option<bool>,
    /// How often the wall came back onto its stop.
    pub stops: Option<u32>,
    /// Strongest impulse of the water on the wall at a stop, over ½ρgh² √(h/g). It is negative,
    /// because the water goes on when the wall stops. Zero if the wall never stopped.
    #[serde(default)]
    pub stop_impulse: Option<Maximum>,
    /// Largest moment about the wall's foot (running mean), over ρgh³/6.
    #[serde(default)]
    pub moment_max: Option<Maximum>,
    /// The same for the first impact.
    #[serde(default)]
    pub first_moment_max: Option<Maximum>,
    /// ∫ (F* - 1) dt of the running mean over the first impact, over √(h/g).
    #[serde(default)]
    pub first_impulse: Option<f64>,
    /// Seconds from 10 to 90 % of the first impact's largest F* - 1.
    #[serde(default)]
    pub rise_time_s: Option<f64>,
    /// Largest gap between the momentum reaction and the face integral, percent of the force.
    pub force_gap_percent: f64,
    /// That gap, signed, at `force_max`: of the means over 0.14 √(h/g), less the gap at rest.
    #[serde(default)]
    pub force_max_gap_percent: f64,
    /// Residual of the energy budget, percent of the largest paddle work so far. If the paddle does
    /// no work, it is percent of the water's initial energy scale.
    pub energy_gap_percent: f64,
    /// Particles that left the tank.
    pub particles_lost: u32,
    /// Water that went over the wall's crest; none without a crest.
    #[serde(default)]
    pub overtopped: Option<Overtopped>,
    /// How close the run came to its health bounds.
    #[serde(default)]
    pub health: HealthMargins,
    /// Why a quoted number is doubtful; `None` if none is.
    #[serde(default, deserialize_with = "super::doubt_reasons::read")]
    pub doubtful_reason: Option<String>,
    /// What happened, if a first attempt failed and smaller time steps helped.
    #[serde(default)]
    pub recovered: Option<String>,
    /// Steps taken, the trunk's included.
    pub steps: u64,
    /// Fluid particles.
    pub particles: u32,
    /// Pair interactions evaluated, the trunk's included.
    pub pair_evaluations: u64,
    /// How many times a ghost was filled by a simpler interpolation than the chosen one, the
    /// trunk's included.
    #[serde(default)]
    pub boundary_fallbacks: u64,
}

/// One line of `histories/<case_id>.csv`: the first step at or after a sampling time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HistoryRow {
    /// The step's own time, seconds.
    pub time_s: f64,
    /// F*, unfiltered.
    pub force: f64,
    /// R*.
    pub runup: f64,
    /// X*.
    pub displacement: f64,
    /// Velocity of the wall, m/s, positive away from the water.
    pub wall_velocity_m_per_s: f64,
}

/// The largest pressures at one height of the wall, of running means.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EnvelopeRow {
    /// Over the bed of the tank, metres.
    pub height_m: f64,
    /// Of the whole run, Pa.
    pub pressure_max_pa: f64,
    /// Of the first impact, Pa; `None` where there was none.
    pub first_pressure_max_pa: Option<f64>,
}

/// The energy budget of a run, joules per metre of width, each term summed on its own.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBudget {
    /// Work done on the water by the paddle.
    pub paddle_work: f64,
    /// Change of the water's kinetic energy.
    pub kinetic: f64,
    /// Change of the water's potential energy.
    pub potential: f64,
    /// Change of the water's elastic (compression) energy.
    pub elastic: f64,
    /// ½ m V² of the wall at the end.
    pub wall_kinetic: f64,
    /// ½ k X² of the spring at the end.
    pub spring: f64,
    /// ∫ [F - s·max(F - F_th, 0)] V dt: energy that the threshold device (and a coupling s ≠ 1)
    /// absorbs.
    pub threshold_device: f64,
    /// Kinetic energy lost when the wall hits its stop.
    pub stops: f64,
    /// Dissipated by artificial viscosity.
    pub viscous: f64,
    /// Dissipated by density diffusion.
    pub density_diffusion: f64,
    /// Taken out by particle shifting, by the volume's correction, and by the pressure of
    /// incompressible water where it meets.
    pub shifting: f64,
    /// Energy of water that went over a crest and was taken away.
    #[serde(default)]
    pub outflow: f64,
}

/// Water that went over a crest, per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Overtopped {
    /// Water behind the crest's back at the end, m².
    pub volume_m2: f64,
    /// Largest discharge at the crest's back, m²/s.
    pub discharge_max_m2_per_s: f64,
    /// Thickest water on the crest, m.
    pub thickness_max_m: f64,
    /// Fastest water on the crest, m/s; none if it was too thin to have one.
    pub speed_max_m_per_s: Option<f64>,
}

/// Time that a run spent in a phase, for display: never part of an identity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PhaseShare {
    /// Name of the phase.
    pub phase: String,
    /// Seconds spent in it.
    pub seconds: f64,
}

/// All results of a finished case, as the sweep takes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CaseResult {
    /// The scalars of the summary.
    pub outcome: Outcome,
    /// Histories, every 0.005 s by default.
    pub history: Vec<HistoryRow>,
    /// Largest pressures up the wall, as far as it got wet.
    pub envelope: Vec<EnvelopeRow>,
    /// Each whole period of regular waves.
    pub waves: Vec<WaveRow>,
    /// Gauges, where the scene has any.
    pub probes: Option<ProbeTable>,
    /// Other results of the scene: of its probes, of a collapsing column.
    pub readings: Vec<NamedReading>,
    /// The energy budget.
    pub energy: EnergyBudget,
    /// The time of each phase.
    pub phases: Vec<PhaseShare>,
    /// How many times neighbours were listed again.
    pub list_rebuilds: u64,
}

/// A finished trunk: the state at the last step before the force first exceeds the threshold, or at
/// the end if it never does. [`super::run_case`] branches from it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrunkResult {
    /// Opaque bytes of the checkpoint.
    pub checkpoint: Vec<u8>,
    /// Simulated time reached, seconds.
    pub time_s: f64,
    /// Steps taken.
    pub steps: u64,
}
