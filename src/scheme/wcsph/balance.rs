//! A start that is at rest: pressures that balance the weight in the sums that the scheme forms.

use std::ops::Range;

use super::Wcsph;
use crate::body::BodyMotion;

/// Rounds of balancing: each takes off most of what the last has left.
const ROUNDS: u32 = 12;
/// Share of the imbalance that a round takes off: the pressure of a row also acts on the rows next to
/// it, as far as the kernel reaches.
const RELAXATION: f64 = 0.7;

impl Wcsph {
    /// Presses still water in level rows until no row is pushed up or down.
    ///
    /// Hydrostatic pressure balances gravity but for the kernel's width: rows under the surface are
    /// left with some percent of g, and the force on a wall would settle by 0.25 % of ρgh²/2 in the
    /// first tenths of a second where the depth has 12 rows. The imbalance ρa of each row, summed from
    /// the surface down, is what its pressure has too much. Of the particles with these numbers alone:
    /// column by column, `rows` to each.
    pub fn balance(&mut self, numbers: Range<usize>, rows: usize) {
        let mut trial = self.clone();
        let at_rest = vec![BodyMotion::default(); self.ghosts.bodies.len()];
        let columns = numbers.len() / rows;
        let number =
            |id: u32| (id as usize).checked_sub(numbers.start).filter(|k| *k < numbers.len());
        let thickness = self.options.spacing;
        let state = self.options.state;
        // Away from the walls, where the rows end.
        let middle = columns / 4..columns - columns / 4;
        let mut excess = vec![0.0; rows];
        for _ in 0..ROUNDS {
            trial.prepare(&at_rest, 1e-9);
            let mut pushed = vec![0.0; rows];
            for (k, id) in trial.fluid.id[..trial.fluid.len()].iter().enumerate() {
                let Some(id) = number(*id) else { continue };
                let (column, row) = (id / rows, id % rows);
                if middle.contains(&column) {
                    pushed[row] += trial.work.acceleration_y[k] / middle.len() as f64;
                }
            }
            let mut above = 0.0;
            for row in (0..rows).rev() {
                let own = RELAXATION * self.options.density * pushed[row] * thickness;
                excess[row] -= above + 0.5 * own;
                above += own;
            }
            for (k, id) in trial.fluid.id[..trial.fluid.len()].iter().enumerate() {
                let Some(own) = number(*id) else { continue };
                let pressure =
                    state.pressure(self.fluid.density[*id as usize]) + excess[own % rows];
                trial.fluid.density[k] = state.density(pressure);
            }
        }
        for (k, id) in trial.fluid.id[..trial.fluid.len()].iter().enumerate() {
            self.fluid.density[*id as usize] = trial.fluid.density[k];
        }
    }
}
