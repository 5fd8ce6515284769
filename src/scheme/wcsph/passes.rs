//! The pair loops, in the variant that a run needs.

use super::acoustic::Acoustic;
use super::continuity::Continuity;
use super::diffusion::with_diffusion;
use super::laminar::Laminar;
use super::momentum::Momentum;
use super::support::Support;
use super::{DensityDiffusion, Shifting, Wcsph, Workspace};
use crate::pairs::{Flow, Neighbours, Precision, Records, round};

impl Wcsph {
    /// Pressure forces of an acoustic step, and the loads.
    pub(super) fn acoustic_pass(&mut self) {
        let mut found = self.work.acceleration_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let acoustic = Acoustic {
            fluid: &self.fluid,
            work: &self.work,
            factors: &self.numbers,
            corrected: self.options.corrected_gradients,
            bodies: self.ghosts.bodies.len(),
            gravity: self.options.gravity,
        };
        self.pairs.held_pass(rows, &acoustic);
        put_back(self.work.acceleration_mut(), found);
        for (load, held) in self.work.loads.iter_mut().zip(&self.work.held_loads) {
            load[0] = *held;
        }
        self.work.add_loads(self.pairs.tallies());
        self.hand_back();
    }

    /// Returns to the water its share of the bed's pushes along its face.
    fn hand_back(&mut self) {
        let Workspace { acceleration_x, acceleration_y, .. } = &mut self.work;
        let accelerations = [&mut acceleration_x[..], acceleration_y];
        self.exchange.hand_back(self.pairs.path, &self.fluid.mass, accelerations);
    }

    /// The accelerations and all else from the pairs of a full step of `dt` seconds. Returns the
    /// power of artificial viscosity.
    pub(super) fn momentum_pass(&mut self, dt: f64) -> f64 {
        self.work.loads.fill([0.0; 2]);
        self.work.held_loads.fill(0.0);
        if self.options.precision == Precision::F32 {
            let of_water = (&*self.strain, &*self.diffused, self.options.density);
            round(self.pairs.path, &self.records, of_water, &mut self.singles);
        }
        let renormalised = self.options.density_diffusion.reads().slants;
        let viscous = self.options.artificial_viscosity > 0.0;
        match (self.options.corrected_gradients, viscous, renormalised) {
            (true, true, true) => self.momentum::<true, true, true>(dt),
            (true, true, false) => self.momentum::<true, true, false>(dt),
            (true, false, true) => self.momentum::<true, false, true>(dt),
            (true, false, false) => self.momentum::<true, false, false>(dt),
            (false, true, true) => self.momentum::<false, true, true>(dt),
            (false, true, false) => self.momentum::<false, true, false>(dt),
            (false, false, true) => self.momentum::<false, false, true>(dt),
            (false, false, false) => self.momentum::<false, false, false>(dt),
        }
        self.work.add_loads(self.pairs.tallies());
        self.hand_back();
        self.pairs.power()
    }

    fn momentum<const CORRECTED: bool, const VISCOUS: bool, const GRADIENTS: bool>(
        &mut self,
        dt: f64,
    ) {
        let options = &self.options;
        let mut found = self.work.found_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let neighbours = Neighbours {
            kernel: options.kernel,
            places: [&self.work.scaled_x, &self.work.scaled_y],
            records: match options.precision {
                Precision::F64 => Records::Double(&self.records),
                Precision::F32 => Records::Single(&self.singles),
            },
            bodies: self.ghosts.bodies.len(),
        };
        let momentum = Momentum::<CORRECTED, VISCOUS, GRADIENTS> {
            fluid: &self.fluid,
            work: &self.work,
            diffused: &self.diffused,
            strain: &self.strain,
            responses: self.exchange.responses(),
            responds: self.responds,
            support: Support {
                wanted: CORRECTED || GRADIENTS || options.shifting != Shifting::None,
                corrected: CORRECTED,
                support_radius: self.scaling.support_radius,
                first_row: options.first_row_share(),
            },
            viscosity: options.artificial_viscosity
                * options.smoothing_length()
                * options.state.sound_speed
                * options.density
                * self.scaling.inverse_radius,
            limited_viscosity: options.limited_viscosity,
            density: options.density,
            gravity: options.gravity,
            steps: f64::from(options.acoustic_substeps),
            half_step: 0.5 * dt,
        };
        self.pairs.full_pass(&neighbours, rows, &momentum);
        put_back(self.work.found_mut(), found);
    }

    /// Physical viscosity in a step of `dt` seconds; returns its power.
    pub(super) fn laminar_pass(&mut self, dt: f64) -> f64 {
        let options = &self.options;
        let mut found = self.work.acceleration_mut().map(std::mem::take);
        let rows = found.each_mut().map(Vec::as_mut_slice);
        let laminar = Laminar {
            fluid: &self.fluid,
            work: &self.work,
            records: &self.records,
            bodies: self.ghosts.bodies.len(),
            viscosity: 8.0
                * options.kinematic_viscosity
                * options.density
                * self.scaling.inverse_radius,
            steps: f64::from(options.acoustic_substeps),
            half_step: 0.5 * dt,
        };
        self.pairs.held_pass(rows, &laminar);
        put_back(self.work.acceleration_mut(), found);
        self.work.add_loads(self.pairs.tallies());
        self.pairs.power()
    }

    /// The sums that the continuity pass of this step needs.
    pub(super) fn flow(&self) -> Flow {
        let corrected = self.options.corrected_gradients;
        Flow {
            corrected,
            strained: corrected && self.substep + 1 == self.options.acoustic_substeps,
            diffusing: self.options.density_diffusion != DensityDiffusion::None,
            sharing: self.substep == 0,
        }
    }

    /// Rates of change of density over a step of `dt` seconds. Returns the power of diffusion, if
    /// that was asked for.
    pub(super) fn continuity_pass(&mut self, dt: f64, sample: bool) -> f64 {
        let (options, flow) = (&self.options, self.flow());
        let mut rate = std::mem::take(&mut self.work.carried.density_rate);
        let mut shares = std::mem::take(&mut self.work.shares);
        let mut turning = std::mem::take(&mut self.work.carried.turning);
        let rows = (&mut *self.strain, [&mut *rate, &mut *shares, &mut *turning]);
        with_diffusion!(options.density_diffusion, &self.work, &self.slants, formulation => {
            let continuity = Continuity {
                fluid: &self.fluid,
                work: &self.work,
                flow,
                factors: &self.numbers,
                diffused: &self.diffused,
                formulation,
                diffusion: options.diffusion_coefficient
                    * options.smoothing_length()
                    * options.state.sound_speed
                    * self.scaling.inverse_radius,
                bodies: self.ghosts.bodies.len(),
                gives: &self.exchange.gives().collect::<Vec<_>>(),
                of_bed: &self.bed_numbers,
                support_radius: self.scaling.support_radius,
                first_row: options.first_row_share(),
                dt,
                sample,
            };
            self.pairs.held_pass(rows, &continuity);
        });
        (self.work.carried.density_rate, self.work.shares, self.work.carried.turning) =
            (rate, shares, turning);
        self.pairs.power()
    }
}

/// Puts fields back where they were taken from.
fn put_back<const N: usize>(fields: [&mut Vec<f64>; N], found: [Vec<f64>; N]) {
    for (field, found) in fields.into_iter().zip(found) {
        *field = found;
    }
}
