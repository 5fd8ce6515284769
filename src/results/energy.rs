//! `energy.csv`: the energy budget of every case that went well, joules per metre of width.

use std::path::Path;

use super::error::SweepError;
use super::record::CaseRecord;
use super::{atomic_file, number};
use crate::simulation::EnergyBudget;

const HEADER: &str = "case_id,paddle_work,kinetic,potential,elastic,wall_kinetic,spring,\
    threshold_device,stops,viscous,density_diffusion,shifting,energy_gap_percent\n";

/// Writes the budgets of the finished cases, in grid order.
pub(super) fn write(directory: &Path, records: &[Option<CaseRecord>]) -> Result<(), SweepError> {
    let mut text = HEADER.to_owned();
    for record in records.iter().flatten() {
        let (Some(energy), Some(outcome)) = (&record.energy, &record.outcome) else { continue };
        text.push_str(&record.id.to_string());
        for value in terms(energy) {
            text.push(',');
            number::push(&mut text, value);
        }
        text.push(',');
        number::push(&mut text, outcome.energy_gap_percent);
        text.push('\n');
    }
    atomic_file::write(&directory.join("energy.csv"), text.as_bytes())
}

fn terms(energy: &EnergyBudget) -> [f64; 11] {
    [
        energy.paddle_work,
        energy.kinetic,
        energy.potential,
        energy.elastic,
        energy.wall_kinetic,
        energy.spring,
        energy.threshold_device,
        energy.stops,
        energy.viscous,
        energy.density_diffusion,
        energy.shifting,
    ]
}
