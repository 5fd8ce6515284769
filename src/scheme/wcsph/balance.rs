//! A start at rest: pressures that balance the weight in the sums of the scheme.

use std::ops::Range;

use super::Wcsph;
use crate::body::BodyMotion;

/// Rounds of balancing. Each removes most of the remaining imbalance.
const ROUNDS: u32 = 12;
/// Share of the imbalance that a round removes. It is below 1, because the pressure of a row also
/// acts on the rows within the kernel's reach.
const RELAXATION: f64 = 0.7;

impl Wcsph {
    /// Presses still water in level rows until no row is pushed up or down. Only particles with
    /// these numbers take part: column by column, `rows` to each.
    ///
    /// Hydrostatic pressure balances gravity except for the effect of the kernel's width. Rows
    /// under the surface are left with some percent of g. Without this, the force on a wall would
    /// settle by 0.25 % of ρgh²/2 in the first tenths of a second where the depth has 12 rows. The
    /// excess pressure of a row is the imbalance ρa, summed from the surface down.
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
