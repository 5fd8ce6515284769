//! Neighbour lists: when they are worn, and how they are made.

use super::Wcsph;
use super::fields::Extrapolate;
use super::parts::cut;
use crate::body::{BodyMotion, MOST_BODIES};
use crate::math::simd::{LANES, dispatch};
use crate::neighbours::{PointSet, Reach, Strips, build_pair_list};
use crate::particles::reorder;

/// Margin of the fluid's lists, in particle spacings.
const FLUID_MARGIN: f64 = 0.4;
/// Margin of the lists that involve ghosts, in particle spacings.
pub(super) const GHOST_MARGIN: f64 = 1.5;

impl Wcsph {
    /// Makes new lists where a pair may have come into reach unseen.
    pub(super) fn refresh_lists(&mut self, bodies: &[BodyMotion]) {
        let spacing = self.options.spacing;
        let n = self.fluid.len();
        self.look_ahead();
        let worn = self.reference_x.is_empty() || {
            let reach =
                Reach { radius: self.options.support_radius, margin: FLUID_MARGIN * spacing };
            let (met, farthest) = self.drift.measure(
                [&self.ahead[0][..n], &self.ahead[1][..n]],
                [&self.reference_x, &self.reference_y],
                reach,
            );
            let moved = bodies
                .iter()
                .zip(&self.reference_offsets)
                .map(|(body, reference)| (body.offset - reference).abs())
                .fold(0.0, f64::max);
            let near = farthest + moved < GHOST_MARGIN * spacing;
            // So that NaN counts as worn.
            met || !near
        };
        if worn {
            self.list_rebuilds += 1;
            let width = Strips::width(spacing);
            let mut order = std::mem::take(&mut self.order);
            let (x, y, id) = (&self.fluid.x[..n], &self.fluid.y[..n], &self.fluid.id[..n]);
            self.strips.renew(x, y, id, width, &mut order);
            self.fluid.reorder(&order, &mut self.scratch);
            for field in self.work.carried_mut() {
                reorder(&mut field[..n], &order, &mut self.scratch);
            }
            for part in 0..2 {
                self.scratch.clear();
                self.scratch.extend(order.iter().map(|&from| self.strain[from as usize][part]));
                for (strain, value) in self.strain.iter_mut().zip(&self.scratch) {
                    strain[part] = *value;
                }
            }
            self.order = order;
            self.reference_x.clear();
            self.reference_x.extend_from_slice(&self.fluid.x[..n]);
            self.reference_y.clear();
            self.reference_y.extend_from_slice(&self.fluid.y[..n]);
            self.reference_offsets.clear();
            self.reference_offsets.extend(bodies.iter().map(|body| body.offset));
            self.look_ahead();
            self.list_neighbours();
        }
    }

    /// Where the particles will be in the middle of the stretch that the coming full step stands
    /// for: the geometry that it holds is then as much ahead of time as it will lag.
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
            (ahead_x, &fluid.x, &fluid.vx, &work.last_acceleration_x),
            (ahead_y, &fluid.y, &fluid.vy, &work.last_acceleration_y),
        ] {
            let factors = [lead, half_square];
            dispatch(self.path, Extrapolate { ahead, places, velocities, accelerations, factors });
        }
    }

    /// Lists neighbours at the reference places, in the present order.
    pub(super) fn list_neighbours(&mut self) {
        let (spacing, radius) = (self.options.spacing, self.options.support_radius);
        let n = self.fluid.len();
        let padded = self.fluid.padded_len();
        let water = PointSet {
            strips: &self.strips,
            x: &self.reference_x,
            y: &self.reference_y,
            offset: 0.0,
            first: 0,
            reach: radius + FLUID_MARGIN * spacing,
            bounds: PointSet::EVERYWHERE,
        };
        let width = Strips::width(spacing);
        self.drift.divide(&self.strips, width, &self.reference_y, radius);
        let bodies = &self.ghosts.bodies;
        let mut sets = [water; MOST_BODIES + 1];
        for ((set, body), offset) in sets[1..].iter_mut().zip(bodies).zip(&self.reference_offsets) {
            *set = PointSet {
                strips: &body.strips,
                x: &self.ghosts.x[body.ghosts.clone()],
                y: &self.ghosts.y[body.ghosts.clone()],
                offset: *offset,
                first: (padded + body.ghosts.start) as u32,
                reach: radius + GHOST_MARGIN * spacing,
                bounds: body.bounds,
            };
        }
        let sets = &sets[..=bodies.len()];
        let [lanes_x, lanes_y] = &mut self.lanes;
        for (lanes, places) in
            [(&mut *lanes_x, &self.reference_x), (&mut *lanes_y, &self.reference_y)]
        {
            lanes.clear();
            lanes.extend_from_slice(places);
            lanes.resize(padded, places[n - 1]);
        }
        cut(&mut self.parts, padded / LANES, &self.team);
        let (path, places) = (self.path, [&*lanes_x, &*lanes_y]);
        self.team.share(&mut self.parts, (), &|part, ()| {
            let lanes = part.lanes();
            let [x, y] = places.map(|places| &places[lanes.clone()]);
            build_pair_list(path, x, y, sets, &mut part.pairs);
            part.held.make_room(&part.pairs);
        });
        for (body, offset) in self.reference_bodies.iter_mut().zip(&self.reference_offsets) {
            body.offset = *offset;
        }
        self.exchange.rebuild(
            self.path,
            &self.ghosts,
            &self.reference_bodies,
            (&self.strips, &self.reference_x, &self.reference_y),
            radius + GHOST_MARGIN * spacing,
        );
        self.plan_turns();
    }
}
