//! The pressure equation as a matrix.

use super::Isph;
use super::images::NO_BODY;
use super::options::Laplacian;

/// Share of the diagonal that is added so that no part of the water is without hold.
const HOLD: f64 = 1e-8;
/// Volume errors count only where the support is at least this complete.
const INSIDE: f64 = 0.9;
/// Largest part of a right-hand side's weight that a poor support may take off.
const FULLEST: f64 = 3.0;

impl Isph {
    /// Rows of V_i times 2 Σ F (p_i - p_j) + grip (p_i - held) = -(ρ/Δt) ∇·u / κ_i + 2 Σ F jump, for
    /// the dynamic pressure (Liang et al. 2017, Eqs. 4 and 11).
    ///
    /// κ_i = ½ tr (Σ F ΔΔᵀ)⁻¹ is Schwaiger's (2008) normalisation of a support that is cut off;
    /// it stands on the right so that the matrix stays symmetric. With [`Laplacian::Schwaiger`] F
    /// becomes F (1 - s·L Δ), which takes 2 s·∇p off: zero on linear fields in any arrangement.
    /// Gravity has no divergence and appears only where the surface holds the pressure.
    pub(super) fn assemble(&mut self) {
        let n = self.fluid.len();
        let options = self.options;
        self.matrix.clear();
        self.at_walls.clear();
        self.slot.clear();
        self.slot.resize(n, u32::MAX);
        let exact = options.laplacian == Laplacian::Exact;
        let (least, narrow) = self.narrow;
        for i in 0..n {
            let operators = &self.operators;
            let start = self.matrix.columns.len();
            let volume = self.fluid.mass[i] / options.density;
            let corrected = options.laplacian == Laplacian::Schwaiger && operators.grip[i] == 0.0;
            let [sx, sy] = operators.sway[i];
            let [cx, cxy, cy] = operators.correction[i];
            let tilt = if corrected { [sx * cx + sy * cxy, sx * cxy + sy * cy] } else { [0.0; 2] };
            let place = self.loose[i].place;
            let (mut diagonal, mut at_wall) = (0.0, false);
            let range = self.list_starts[i] as usize..self.list_starts[i + 1] as usize;
            for neighbour in &self.list[range] {
                let point = neighbour.point as usize;
                let j = self.points.original[point] as usize;
                at_wall |= self.points.body[point] != NO_BODY;
                let mut weight = 2.0 * volume * neighbour.weight;
                if exact {
                    if volume * neighbour.weight < least {
                        continue;
                    }
                    weight *= narrow;
                }
                if corrected {
                    let dx = self.points.x[point] - place[0];
                    let dy = self.points.y[point] - place[1];
                    weight *= 1.0 - tilt[0] * dx - tilt[1] * dy;
                }
                if j == i {
                    continue;
                }
                diagonal += weight;
                let at = self.slot[j] as usize;
                if self.slot[j] != u32::MAX && at >= start {
                    self.matrix.values[at] -= weight;
                } else {
                    self.slot[j] = self.matrix.columns.len() as u32;
                    self.matrix.columns.push(j as u32);
                    self.matrix.values.push(-weight);
                }
            }
            if at_wall {
                self.at_walls.push(i as u32);
            }
            self.matrix.starts.push(self.matrix.columns.len() as u32);
            self.matrix.diagonal.push(diagonal + volume * operators.grip[i]);
        }
        if exact {
            // Parts that nothing holds stay solvable.
            self.matrix.diagonal.iter_mut().for_each(|diagonal| *diagonal *= 1.0 + HOLD);
        } else {
            self.hold_components();
        }
    }

    /// The right-hand side -V (ρ/Δt) ∇·u / κ for the divergence at hand; with `relax` volume errors
    /// are taken back as well.
    pub(super) fn right_hand_side(&mut self, dt: f64, relax: bool) {
        let options = self.options;
        let operators = &self.operators;
        self.right.clear();
        for i in 0..self.fluid.len() {
            let volume = self.fluid.mass[i] / options.density;
            let [xx, xy, yy] = operators.moment[i];
            let determinant = xx * yy - xy * xy;
            let kappa = if determinant > 0.0 && operators.completeness[i] > 0.25 {
                (0.5 * (xx + yy) / determinant).clamp(1.0 / FULLEST, FULLEST)
            } else {
                FULLEST
            };
            let mut divergence = operators.divergence[i];
            if relax && operators.completeness[i] > INSIDE && operators.grip[i] == 0.0 {
                let error = operators.coverage[i] - self.full_coverage;
                divergence -= options.volume_relaxation * error / dt;
            }
            self.right.push(-volume * options.density * divergence / (dt * kappa));
        }
    }

    /// Every connected part of the water needs a particle whose pressure is held; where a part has
    /// none (a full, closed vessel) its first one is, at the pressure of the still level.
    fn hold_components(&mut self) {
        let n = self.fluid.len();
        let mut reached: Vec<bool> = self.operators.grip.iter().map(|&grip| grip > 0.0).collect();
        let mut open: Vec<u32> = (0..n as u32).filter(|&i| reached[i as usize]).collect();
        let mut next = 0;
        loop {
            while let Some(i) = open.pop() {
                for &j in self.matrix.row(i as usize).0 {
                    if !reached[j as usize] {
                        reached[j as usize] = true;
                        open.push(j);
                    }
                }
            }
            while next < n && reached[next] {
                next += 1;
            }
            if next == n {
                return;
            }
            let pin = self.matrix.diagonal[next].max(f64::MIN_POSITIVE);
            self.matrix.diagonal[next] += pin;
            reached[next] = true;
            open.push(next as u32);
        }
    }
}
