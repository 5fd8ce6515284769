//! How ghosts get their values, with the parameters of the numerics.

use super::numerics::Numerics;
use crate::boundary::{
    BoundaryChoice, Dummy, ImprovedShepard, InterpolatorChoice, MlsLinear, MlsQuadratic,
    Normalized, Sfdi,
};

impl Numerics {
    /// The boundary interpolator with its parameters.
    pub fn interpolator(&self) -> InterpolatorChoice {
        let amplification_limit = self.amplification_limit;
        match self.boundary {
            BoundaryChoice::ImprovedShepard => {
                InterpolatorChoice::ImprovedShepard(ImprovedShepard {
                    lambda: self.shepard_lambda,
                    sigma: self.shepard_sigma,
                })
            }
            BoundaryChoice::Normalized => InterpolatorChoice::Normalized(Normalized),
            BoundaryChoice::Sfdi => {
                InterpolatorChoice::Sfdi(Sfdi { matrix: self.sfdi_matrix, amplification_limit })
            }
            BoundaryChoice::MlsLinear => {
                InterpolatorChoice::MlsLinear(MlsLinear { amplification_limit })
            }
            BoundaryChoice::MlsQuadratic => {
                InterpolatorChoice::MlsQuadratic(MlsQuadratic { amplification_limit })
            }
            BoundaryChoice::Dummy => InterpolatorChoice::Dummy(Dummy),
        }
    }
}
