//! Neighbour lists, and prediction of the positions for which they are made.

use super::Wcsph;
use crate::body::BodyMotion;
use crate::math::simd::dispatch;
use crate::pairs::{Extrapolate, PointSet};

impl Wcsph {
    /// Makes new lists if a pair may have come into reach unseen.
    pub(super) fn refresh_lists(&mut self, bodies: &[BodyMotion]) {
        let n = self.fluid.len();
        let offsets = || bodies.iter().map(|body| body.offset);
        self.look_ahead();
        if self.pairs.are_worn([&self.ahead[0][..n], &self.ahead[1][..n]], offsets()) {
            self.take_away();
            let carried = self.work.carried.all_mut();
            self.pairs.sort(&mut self.fluid, carried, &mut self.strain, offsets());
            self.look_ahead();
            self.list_neighbours();
        }
    }

    /// Predicts the particles' positions in the middle of the stretch that the coming full step
    /// stands for. So the held geometry is as much ahead of time at first as it lags at the end.
    fn look_ahead(&mut self) {
        let (fluid, work, lead) = (&self.fluid, &self.work, self.lead);
        // Velocities are those of half a step ago.
        let substeps = f64::from(self.options.acoustic_substeps);
        let half_square = if substeps > 1.0 {
            0.5 * lead * lead * (substeps + 1.0) / (substeps - 1.0)
        } else {
            0.0
        };
        let [ahead_x, ahead_y] = &mut self.ahead;
        for (ahead, places, velocities, accelerations) in [
            (ahead_x, &fluid.x, &fluid.vx, &work.carried.last_acceleration_x),
            (ahead_y, &fluid.y, &fluid.vy, &work.carried.last_acceleration_y),
        ] {
            let factors = [lead, half_square];
            dispatch(
                self.pairs.path,
                Extrapolate { ahead, places, velocities, accelerations, factors },
            );
        }
    }

    /// Lists neighbours at the reference places, in the present order.
    pub(super) fn list_neighbours(&mut self) {
        let (padded, ghosts) = (self.fluid.padded_len(), &self.ghosts);
        self.pairs.list(ghosts.bodies.iter().map(|body| PointSet {
            strips: &body.strips,
            x: &ghosts.x[body.ghosts.clone()],
            y: &ghosts.y[body.ghosts.clone()],
            offset: 0.0,
            first: (padded + body.ghosts.start) as u32,
            reach: 0.0,
            bounds: body.bounds,
        }));
        let (_, offsets) = self.pairs.reference();
        for (body, offset) in self.reference_bodies.iter_mut().zip(offsets) {
            body.offset = *offset;
        }
        let (bodies, reach) = (&self.reference_bodies, self.pairs.ghost_reach());
        self.exchange.rebuild(self.pairs.path, ghosts, bodies, self.pairs.sorted(), reach);
    }
}
