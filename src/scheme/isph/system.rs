//! The pressure equation with what solves it.

use crate::math::sparse::{Csr, Krylov, Preconditioner, PreconditionerChoice};
use crate::pairs::Blocks;

/// A matrix, its preconditioner and the fields of a solve.
#[derive(Debug)]
pub(super) struct System {
    pub matrix: Csr,
    pub preconditioner: Preconditioner,
    pub krylov: Krylov,
    pub blocks: Blocks,
    pub right: Vec<f64>,
    /// What is solved for, the guess before that.
    pub change: Vec<f64>,
    /// Who is connected to a particle whose pressure is held, and who is still to be asked for
    /// others.
    pub reached: Vec<bool>,
    pub open: Vec<u32>,
    /// L s of the particles, for Schwaiger's Laplacian.
    pub tilts: Vec<[f64; 2]>,
}

impl System {
    pub fn new(choice: PreconditionerChoice) -> System {
        System {
            matrix: Csr::default(),
            preconditioner: Preconditioner::new(choice),
            krylov: Krylov::default(),
            blocks: Blocks::default(),
            right: Vec::new(),
            change: Vec::new(),
            reached: Vec::new(),
            open: Vec::new(),
            tilts: Vec::new(),
        }
    }

    /// Every connected part of the water needs a particle whose pressure is held. A full, closed vessel has
    /// none. There the first particle is held, at the pressure of the still level.
    pub(super) fn hold_components(&mut self, grip: &[f64]) {
        let System { matrix, reached, open, .. } = self;
        reached.clear();
        reached.extend(grip.iter().map(|&grip| grip > 0.0));
        open.clear();
        open.extend((0..grip.len() as u32).filter(|&i| reached[i as usize]));
        for next in 0..grip.len() {
            while let Some(i) = open.pop() {
                for &j in matrix.row(i as usize).0 {
                    if !std::mem::replace(&mut reached[j as usize], true) {
                        open.push(j);
                    }
                }
            }
            if !reached[next] {
                let pin = matrix.diagonal[next].max(f64::MIN_POSITIVE);
                matrix.diagonal[next] += pin;
                reached[next] = true;
                open.push(next as u32);
            }
        }
    }
}
