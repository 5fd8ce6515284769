//! Removes water that has gone over a crest.

use super::{Carried, Wcsph, Workspace};
use crate::pairs::{Factors, Record, gather};

impl Wcsph {
    /// Removes water that has gone over the crest, and records it. Lists must be made again after
    /// that, so this is done with them.
    pub(super) fn take_away(&mut self) {
        let Some(crest) = &self.ghosts.crest else { return };
        let gone = |k: usize| crest.is_gone([self.fluid.x[k], self.fluid.y[k]]);
        let all = 0..self.fluid.len();
        if !all.clone().any(gone) {
            return;
        }
        let mut taken = self.taken;
        for k in all.clone().filter(|&k| gone(k)) {
            let (fluid, mass) = (&self.fluid, self.fluid.mass[k]);
            let square = fluid.vx[k] * fluid.vx[k] + fluid.vy[k] * fluid.vy[k];
            taken.particles += 1;
            taken.mass += mass;
            taken.energy += 0.5 * mass * square
                + mass * self.options.gravity * fluid.y[k]
                + self.elastic_energy_of(k);
        }
        let kept: Vec<u32> = all.filter(|&k| !gone(k)).map(|k| k as u32).collect();
        self.taken = taken;
        self.fluid.keep(&kept);
        let padded = self.fluid.padded_len();
        for field in self.work.carried.all_mut() {
            *field = gather(field, &kept);
            field.resize(padded, 0.0);
        }
        self.strain = gather(&self.strain, &kept);
        self.strain.resize(padded, [0.0; 2]);
        self.make_room();
    }

    /// Makes room for all arrays at the start and if the number of particles has changed. Data carried
    /// from step to step stay.
    pub(super) fn make_room(&mut self) {
        let (padded, ghosts) = (self.fluid.padded_len(), self.ghosts.len());
        if self.records.len() == padded + ghosts {
            return;
        }
        let new = Workspace::new(padded, self.ghosts.bodies.len());
        let old = std::mem::replace(&mut self.work, new);
        if old.carried != Carried::default() {
            self.work.carried = old.carried;
        }
        self.diffused = vec![0.0; padded];
        self.ahead = [vec![0.0; padded], vec![0.0; padded]];
        self.records = vec![Record::default(); padded + ghosts];
        self.numbers = vec![Factors::default(); padded + ghosts];
        if self.options.density_diffusion.reads().slants {
            self.slants = vec![Factors::default(); padded];
        }
    }
}
