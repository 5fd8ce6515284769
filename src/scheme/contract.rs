//! What a run asks of a scheme, and what it hands over.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};

use super::StateEquation;
use super::isph::IsphState;
use super::wcsph::WcsphState;
use crate::body::BodyMotion;
use crate::boundary::Ghosts;
use crate::kernel::KernelChoice;
use crate::math::team::Team;
use crate::pairs::Fluid;
use crate::theory::central_field::CentralField;

/// Force of the water on a body, at the current places.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Along x, N per metre of width; for the responding body with its acceleration left out.
    pub force: f64,
    /// What its own acceleration takes off that force: F = `force` - `added_mass` a.
    pub added_mass: f64,
}

/// Motion of the bodies over the second half of a step.
#[derive(Debug, Clone, Copy)]
pub struct StepWalls<'a> {
    /// Offset at the start of the step and mean velocity over it.
    pub bodies: &'a [BodyMotion],
    /// Acceleration of the responding body.
    pub acceleration: f64,
    /// What comes after.
    pub next: NextStep<'a>,
}

/// The step after this one: what the next [`Scheme::prepare`] will be told.
#[derive(Debug, Clone, Copy)]
pub struct NextStep<'a> {
    /// Motions at its start.
    pub bodies: &'a [BodyMotion],
    /// Its length, seconds, before a [`Scheme::step_limit`].
    pub dt: f64,
}

/// Powers (W) and works (J), per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dissipation {
    /// Power lost to artificial viscosity, where it was asked for.
    pub viscous_power: f64,
    /// Power lost to density diffusion, where it was asked for.
    pub diffusion_power: f64,
    /// Energy taken out by shifting over the step.
    pub shifting_work: f64,
}

/// How the pressure equation was solved over a run, and how incompressible the water stayed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SolverSummary {
    /// Iterations, of all solves of a step together.
    pub iterations_per_step: f64,
    /// Largest residual that a solve was left with, over its right-hand side.
    pub worst_residual: f64,
    /// Largest root mean square, over the interior, of Δt ∇·u.
    pub worst_divergence: f64,
    /// Largest |mean, over the interior, of Σ V W over its value on the lattice, less one|.
    pub worst_volume_drift: f64,
}

/// Why a scheme cannot take the step.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The pressure equation was not solved.
    #[error(
        "the pressure equation stands at a residual of {residual:.1e} after {iterations} iterations, bound {bound:.1e}"
    )]
    SolverDiverged {
        /// Iterations done.
        iterations: u32,
        /// Residual over the right-hand side.
        residual: f64,
        /// What it should have come down to.
        bound: f64,
    },
}

/// What a scheme must keep to go on later, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum SchemeState {
    /// δ-SPH.
    Wcsph(Box<WcsphState>),
    /// Incompressible SPH.
    Isph(Box<IsphState>),
}

/// Equations of motion of the water between bodies, a step cut in two: [`Scheme::prepare`] finds
/// the forces at the old places, the caller settles the motion of walls, [`Scheme::finish`] moves
/// the water.
pub trait Scheme: Debug + Send {
    /// The water.
    fn fluid(&self) -> &Fluid;

    /// The bodies' faces and ghosts.
    fn walls(&self) -> &Ghosts;

    /// Smoothing kernel and its support radius, metres.
    fn kernel(&self) -> (KernelChoice, f64);

    /// Pressures of the particles at the last [`Scheme::prepare`], Pa.
    fn pressures(&self) -> &[f64];

    /// The state equation; none where the water is incompressible.
    fn state_equation(&self) -> Option<&StateEquation>;

    /// The force towards a centre that it lies in, if any.
    fn field(&self) -> Option<CentralField> {
        None
    }

    /// Elastic energy of the water, J per metre of width, as far as it can do work.
    fn elastic_energy(&self) -> f64 {
        0.0
    }

    /// Longest step that the water as it is allows, seconds.
    fn step_limit(&self) -> f64 {
        f64::INFINITY
    }

    /// Takes on threads to share each step's work from the first step on. The answer is the same,
    /// bit for bit; a scheme that cannot share its work leaves them alone.
    fn take_on(&mut self, _team: &Team) {}

    /// First half of a step of `dt` seconds. `bodies` are the motions at this instant; the
    /// acceleration of the responding body is not used.
    ///
    /// # Errors
    /// The step cannot be taken.
    fn prepare(&mut self, bodies: &[BodyMotion], dt: f64) -> Result<(), StepError>;

    /// Finds how force and water respond to the responding body's acceleration; asked for after
    /// [`Scheme::prepare`] in those steps in which that body may move.
    ///
    /// # Errors
    /// The response cannot be found.
    fn respond(&mut self, _dt: f64) -> Result<(), StepError> {
        Ok(())
    }

    /// Whether a step's forces are those at its start and its velocities go from the middle of the step
    /// before to its own: kick and drift. Otherwise forces are the mean over the step.
    fn kicks(&self) -> bool {
        true
    }
    /// Force on a body and its added mass, from the last [`Scheme::prepare`].
    fn load(&self, body: usize) -> Load;

    /// Second half of the step, and what can be done of the next: this step's loads, pressures and
    /// levels are to be read before. With `sample` all powers are summed.
    fn finish(&mut self, dt: f64, walls: &StepWalls<'_>, sample: bool) -> Dissipation;

    /// Level of the water at an upright body, metres above the bed.
    fn level_at(&self, body: usize) -> f64;

    /// Level of the free surface at x, metres above the bed, looked for upwards from `from`.
    fn level_in_water(&mut self, x: f64, from: f64) -> f64;

    /// Force on a body by integrating the interpolated pressure over its face, N per metre.
    fn face_force(&mut self, body: usize, motion: &BodyMotion) -> f64;

    /// How many times neighbours have been listed anew, where lists outlast a step.
    fn list_rebuilds(&self) -> u64 {
        0
    }

    /// Whether the state ahead of the coming step can be kept; within a few steps it can.
    fn can_be_kept(&self) -> bool {
        true
    }

    /// What must be kept.
    fn state(&self) -> SchemeState;

    /// Goes back to a state of the same scheme.
    fn restore(&mut self, state: SchemeState);

    /// Pair interactions evaluated so far.
    fn pair_evaluations(&self) -> u64;

    /// How many times a ghost was filled with what a simpler interpolation than the chosen one
    /// gave; none where the scheme's walls take no interpolation.
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
