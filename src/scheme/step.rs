//! What goes into a step of a scheme and what comes out of it.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::body::BodyMotion;

/// Force of the water on a body, at the current places.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Along x, N per metre of width; for the responding body with its acceleration left out.
    pub force: f64,
    /// What the body's own acceleration takes off that force: F = `force` - `added_mass` a.
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

/// The step after this one: what will be given to the next
/// [`Scheme::prepare`](super::Scheme::prepare).
#[derive(Debug, Clone, Copy)]
pub struct NextStep<'a> {
    /// Motions at its start.
    pub bodies: &'a [BodyMotion],
    /// Its length, seconds, before a [`Scheme::step_limit`](super::Scheme::step_limit).
    pub dt: f64,
}

/// Powers (W) and works (J), per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dissipation {
    /// Power lost to artificial viscosity, where it was asked for.
    pub viscous_power: f64,
    /// Power lost to density diffusion, where it was asked for.
    pub diffusion_power: f64,
    /// Energy taken out over the step by all else: shifting, volume feedback, settling at the
    /// surface, and walls that hold water back. In incompressible water it includes the work of
    /// pressure where water meets.
    pub shifting_work: f64,
}

/// Water that was taken away, per metre of width.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Taken {
    /// Particles.
    pub particles: u32,
    /// Mass, kg.
    pub mass: f64,
    /// Its kinetic, potential and elastic energy, J.
    pub energy: f64,
}

/// How the pressure equation was solved over a run, and how incompressible the water stayed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SolverSummary {
    /// Iterations, of all solves of a step together.
    pub iterations_per_step: f64,
    /// Largest residual at the end of a solve, relative to its right-hand side.
    pub worst_residual: f64,
    /// Largest root mean square, over the interior, of Δt ∇·u.
    pub worst_divergence: f64,
    /// Largest |mean, over the interior, of Σ V W over its value on the lattice, less one|.
    pub worst_volume_drift: f64,
}

/// Phases of a step with the seconds spent in each.
#[derive(Debug, Clone)]
pub struct Phases<const N: usize>([(&'static str, f64); N]);

impl<const N: usize> Phases<N> {
    /// No time is spent yet.
    pub fn new(names: [&'static str; N]) -> Phases<N> {
        Phases(names.map(|name| (name, 0.0)))
    }

    /// Adds the time since `clock` to a phase, and resets `clock`.
    pub fn lap(&mut self, phase: &str, clock: &mut Instant) {
        let before = std::mem::replace(clock, Instant::now());
        if let Some((_, seconds)) = self.0.iter_mut().find(|(name, _)| *name == phase) {
            *seconds += (*clock - before).as_secs_f64();
        }
    }

    /// All phases.
    pub fn seconds_by_name(&self) -> Vec<(&'static str, f64)> {
        self.0.to_vec()
    }
}

/// Why a scheme cannot take the step.
#[expect(missing_docs, reason = "fields are called what they are")]
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The pressure equation was not solved. Residuals are relative to the right-hand side.
    #[error(
        "the pressure equation stands at a residual of {residual:.1e} after {iterations} iterations, bound {bound:.1e}"
    )]
    SolverDiverged { iterations: u32, residual: f64, bound: f64 },
}
