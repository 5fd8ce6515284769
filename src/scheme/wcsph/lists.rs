//! Neighbour lists: when they are worn, and how they are made.

use super::Wcsph;
use super::separation::Slopes;
use crate::body::BodyMotion;
use crate::neighbours::{PointSet, Strips, build_pair_list};

/// Margin of the fluid's lists, in particle spacings.
const FLUID_MARGIN: f64 = 0.4;
/// Margin of the lists that involve ghosts, in particle spacings.
pub(super) const GHOST_MARGIN: f64 = 1.0;
/// A strip holds this many columns of particles: eight particles then form a square.
const STRIP_COLUMNS: f64 = 2.83;

impl Wcsph {
    /// Width of the strips of the neighbour search, metres.
    pub fn strip_width(spacing: f64) -> f64 {
        STRIP_COLUMNS * spacing
    }

    /// Makes new lists where a pair may have come into reach unseen.
    pub(super) fn refresh_lists(&mut self, bodies: &[BodyMotion]) {
        let spacing = self.options.spacing;
        let n = self.fluid.len();
        self.look_ahead();
        let worn = self.reference_x.is_empty() || {
            let reach = ((self.options.support_radius + FLUID_MARGIN * spacing)
                / Wcsph::strip_width(spacing))
            .ceil() as usize;
            let (relative, farthest) = self.drift.measure(
                &self.strips,
                [&self.ahead[0][..n], &self.ahead[1][..n]],
                [&self.reference_x, &self.reference_y],
                reach,
            );
            let moved = bodies
                .iter()
                .zip(&self.reference_offsets)
                .map(|(body, reference)| (body.offset - reference).abs())
                .fold(0.0, f64::max);
            // Written so that NaN counts as worn.
            !(relative < FLUID_MARGIN * spacing && farthest + moved < GHOST_MARGIN * spacing)
        };
        if worn {
            let width = Wcsph::strip_width(spacing);
            let (_, order) =
                Strips::sort(&self.fluid.x[..n], &self.fluid.y[..n], &self.fluid.id[..n], width);
            self.fluid.reorder(&order, &mut self.scratch);
            for field in self.work.carried_mut() {
                self.scratch.clear();
                self.scratch.extend(order.iter().map(|&from| field[from as usize]));
                field[..n].copy_from_slice(&self.scratch);
            }
            let strain: Vec<[f64; 2]> =
                order.iter().map(|&from| self.strain[from as usize]).collect();
            self.strain[..n].copy_from_slice(&strain);
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
        for k in 0..fluid.padded_len() {
            ahead_x[k] =
                fluid.x[k] + lead * fluid.vx[k] + half_square * work.last_acceleration_x[k];
            ahead_y[k] =
                fluid.y[k] + lead * fluid.vy[k] + half_square * work.last_acceleration_y[k];
        }
    }

    /// Lists neighbours at the reference places, in the present order.
    pub(super) fn list_neighbours(&mut self) {
        let (spacing, radius) = (self.options.spacing, self.options.support_radius);
        let n = self.fluid.len();
        let padded = self.fluid.padded_len();
        let width = Wcsph::strip_width(spacing);
        self.strips = Strips::of_sorted(&self.reference_x, &self.reference_y, width);
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
        let mut sets = vec![PointSet {
            strips: &self.strips,
            x: &self.reference_x,
            y: &self.reference_y,
            offset: 0.0,
            first: 0,
            reach: radius + FLUID_MARGIN * spacing,
            bounds: everywhere,
        }];
        for (body, offset) in self.ghosts.bodies.iter().zip(&self.reference_offsets) {
            sets.push(PointSet {
                strips: &body.strips,
                x: &self.ghosts.x[body.ghosts.clone()],
                y: &self.ghosts.y[body.ghosts.clone()],
                offset: *offset,
                first: (padded + body.ghosts.start) as u32,
                reach: radius + GHOST_MARGIN * spacing,
                bounds: body.bounds,
            });
        }
        let mut lanes_x = self.reference_x.clone();
        let mut lanes_y = self.reference_y.clone();
        lanes_x.resize(padded, lanes_x[n - 1]);
        lanes_y.resize(padded, lanes_y[n - 1]);
        build_pair_list(self.path, &lanes_x, &lanes_y, &sets, &mut self.pairs);
        self.slopes.resize(self.pairs.len(), Slopes::default());
        let bodies: Vec<BodyMotion> = self
            .reference_offsets
            .iter()
            .map(|&offset| BodyMotion { offset, ..BodyMotion::default() })
            .collect();
        self.exchange.rebuild(
            self.path,
            &self.ghosts,
            &bodies,
            (&self.strips, &self.reference_x, &self.reference_y),
            radius + GHOST_MARGIN * spacing,
        );
    }
}
