//! Fig. 3 of Liang et al. 2017: runup, and force, at fixed walls against the wave's height.

use super::{Drawn, Material};
use crate::report::error::ReportError;
use crate::report::plots::at_fixed_walls;

/// The report's own figure of fixed walls.
pub fn drawing(material: &Material) -> Result<Option<Drawn>, ReportError> {
    for study in material.studies {
        if let Some(figure) = at_fixed_walls(study.data).into_iter().next() {
            return Ok(Some(Drawn { drawing: figure.drawing, caption: figure.caption }));
        }
    }
    Ok(None)
}
