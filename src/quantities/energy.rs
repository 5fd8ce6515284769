//! The terms of the energy budget in `energy.csv`, in their order. The first is what the paddle
//! gives, the others are what became of it.

use super::{Quantity, Unit, quantities};
use crate::simulation::EnergyBudget;

/// How a term is read.
pub type Read = fn(&EnergyBudget) -> f64;

/// So many terms were there from the first version on; `energy.csv` has the gap behind them.
pub const FIRST_VERSION: usize = 11;

const fn term(name: &'static str, read: Read) -> Quantity<Read> {
    Quantity::new(name, "", Unit::JoulesPerMetre, read)
}

quantities! { Read;
    /// done on the water by the paddle
    PADDLE_WORK = term("paddle_work_j_per_m", |budget| budget.paddle_work);
    /// change of the water's kinetic energy
    KINETIC = term("kinetic_j_per_m", |budget| budget.kinetic);
    /// change of the water's potential energy
    POTENTIAL = term("potential_j_per_m", |budget| budget.potential);
    /// change of the water's elastic energy, by compression
    ELASTIC = term("elastic_j_per_m", |budget| budget.elastic);
    /// kinetic energy of the wall at the end
    WALL_KINETIC = term("wall_kinetic_j_per_m", |budget| budget.wall_kinetic);
    /// energy of the spring at the end
    SPRING = term("spring_j_per_m", |budget| budget.spring);
    /// absorbed by the threshold of the wall's law of motion, and by a coupling other than 1
    THRESHOLD_DEVICE = term("threshold_device_j_per_m", |budget| budget.threshold_device);
    /// lost where the wall hits its stop
    STOPS = term("stops_j_per_m", |budget| budget.stops);
    /// lost to artificial viscosity
    VISCOUS = term("viscous_j_per_m", |budget| budget.viscous);
    /// lost to density diffusion
    DENSITY_DIFFUSION = term("density_diffusion_j_per_m", |budget| budget.density_diffusion);
    /// taken out by particle shifting, volume feedback, settling at the surface, walls that hold water back, and the
    /// pressure of incompressible water that meets
    SHIFTING = term("shifting_j_per_m", |budget| budget.shifting);
    // Directories of the first version end here.
    /// energy of the water that went over a crest and was taken away, as it had it there; behind the gap
    OUTFLOW = term("outflow_j_per_m", |budget| budget.outflow);
}
