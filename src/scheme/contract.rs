//! What a run asks of a scheme, and what it hands over.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};

use super::StateEquation;
use super::isph::IsphState;
use super::step::{Dissipation, Load, SolverSummary, StepError, StepWalls, Taken};
use super::wcsph::WcsphState;
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::math::team::Team;
use crate::pairs::Fluid;
use crate::theory::central_field::CentralField;

/// What a scheme must keep to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SchemeState {
    /// δ-SPH.
    Wcsph(Box<WcsphState>),
    /// Incompressible SPH.
    Isph(Box<IsphState>),
}

/// The equations of motion of the water between bodies. A step is in two halves.
/// [`Scheme::prepare`] finds the forces at the old positions. The caller then finds the motion of
/// the walls. [`Scheme::finish`] moves the water.
pub trait Scheme: Debug + Send {
    /// The water.
    fn fluid(&self) -> &Fluid;

    /// The bodies' faces and ghosts.
    fn walls(&self) -> &Ghosts;

    /// Smoothing kernel and its support radius, metres.
    fn kernel(&self) -> (KernelChoice, f64);

    /// Pressures of the particles, Pa, from the last [`Scheme::prepare`], or from
    /// [`Scheme::settle`] once that was called.
    fn pressures(&self) -> &[f64];

    /// Rates of change of the particles' densities in the last step, kg/m³/s; none where the water is
    /// incompressible.
    fn density_rates(&self) -> Option<&[f64]> {
        None
    }

    /// The state equation; none where the water is incompressible.
    fn state_equation(&self) -> Option<&StateEquation>;

    /// The central force field in which the water lies, if any.
    fn field(&self) -> Option<CentralField> {
        None
    }

    /// Elastic energy of the water that can do work, J per metre of width.
    fn elastic_energy(&self) -> f64 {
        0.0
    }

    /// The water that has left over a crest.
    fn taken(&self) -> Taken {
        Taken::default()
    }

    /// The longest step that the present state of the water allows, seconds.
    fn step_limit(&self) -> f64 {
        f64::INFINITY
    }

    /// Hands over threads that share the work of each step, from the first step on. The answer is
    /// the same, bit for bit. A scheme that cannot share its work does not use them.
    fn take_on(&mut self, _team: &Team) {}

    /// First half of a step of `dt` seconds. `bodies` are the motions at the start of the step. The
    /// acceleration of the responding body is not used.
    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError>;

    /// Finds how force and water respond to the responding body's acceleration. It is called after
    /// [`Scheme::prepare`], in steps in which that body may move.
    fn respond(&mut self, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }

    /// Takes the responding body's acceleration once it is known. Pressures that are read from then
    /// on include its effect. [`Scheme::finish`] is given the same acceleration.
    fn settle(&mut self, _acceleration: f64) {}

    /// Whether a step is kick and drift: its forces are those at its start, and velocities are
    /// those of mid-steps. Otherwise forces are the mean over the step.
    fn kicks(&self) -> bool {
        true
    }
    /// Force on a body and its added mass, from the last [`Scheme::prepare`].
    fn load(&self, body: usize) -> Load;

    /// Second half of the step, and whatever can already be done of the next step. So loads,
    /// pressures and levels of this step must be read before. With `sample` all powers are summed.
    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation;

    /// Level of the water at an upright body, metres above the bed.
    fn level_at(&self, body: usize) -> f64;

    /// Level of the free surface at x, metres above the bed. The search goes upwards from `from`.
    /// Upright walls mirror the water.
    fn level_in_water(&mut self, x: f64, from: f64) -> f64;

    /// Force on a body by integrating the interpolated pressure over its face, N per metre.
    fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64;

    /// The water's pressure at each point of a body's face, Pa; 0 where the point is dry. Cheap
    /// enough for every step.
    fn face_pressures(&mut self, body: usize, motion: &BodyMotion, pressures: &mut Vec<f64>);

    /// How many times neighbours have been listed again, where lists outlast a step.
    fn list_rebuilds(&self) -> u64 {
        0
    }

    /// Whether the state before the coming step can be stored. If not, it can within a few steps.
    fn can_be_kept(&self) -> bool {
        true
    }

    /// Multiplies the velocities by this share, between two full steps.
    fn slow_down(&mut self, _share: f64) {}

    /// What must be kept.
    fn state(&self) -> SchemeState;

    /// Goes back to a state of the same scheme.
    fn restore(&mut self, state: SchemeState);

    /// Pair interactions evaluated so far.
    fn pair_evaluations(&self) -> u64;

    /// How many times a ghost was filled by a simpler interpolation than the chosen one. Zero where
    /// the scheme's walls use no interpolation.
    fn boundary_fallbacks(&self) -> u64 {
        0
    }

    /// Phases of a step with the seconds spent in each.
    fn phases(&self) -> Vec<(&'static str, f64)>;

    /// How the pressure equation was solved; none where there is no such equation.
    fn solver(&self) -> Option<SolverSummary> {
        None
    }
}
