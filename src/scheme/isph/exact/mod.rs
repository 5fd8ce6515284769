//! The projection whose Laplacian is the divergence of the gradient that moves the water.

mod laplacian;
mod softness;
mod solve;

pub(super) use laplacian::ExactLaplacian;

/// What the products of the exact Laplacian need and leave, an entry per particle.
#[derive(Debug, Clone, Default)]
pub(super) struct Exact {
    /// ∇p of every particle.
    slope: Vec<[f64; 2]>,
    /// C: how far a particle gives way instead of taking a pressure.
    pub softness: Vec<f64>,
    /// κ^(-1/2), κ what takes the compact Laplacian to the size of the exact one.
    scale: Vec<f64>,
    scaled: Vec<f64>,
    compact: Vec<f64>,
    /// Divergence at mid-step that this step aims at, 1/s.
    pub aim: Vec<f64>,
}
