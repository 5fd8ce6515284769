//! The pressure equation with its solver.

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
    /// The unknown; at first its guess.
    pub change: Vec<f64>,
    /// For the search of connected parts: particles connected to a held pressure, and those whose
    /// neighbours are still to be visited.
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

    /// Holds a pressure in every connected part of the water. A full, closed vessel has no surface
    /// that does. There the first particle is held, at the pressure of the still level.
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
