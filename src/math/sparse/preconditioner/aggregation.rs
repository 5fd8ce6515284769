//! Multigrid by plain aggregation.

use crate::math::simd::SimdPath;
use crate::math::sparse::Csr;

/// A level is solved directly from this many unknowns down.
const COARSEST: usize = 120;
/// A neighbour joins an aggregate if its entry is at least this share of the row's largest.
const STRONG: f64 = 0.25;
/// Coarse corrections of plain aggregation are too short; they are stretched by this factor
/// (Braess 1995).
const STRETCH: f64 = 1.6;

/// Aggregates of aggregates: one symmetric Gauss-Seidel sweep down and one up on every level,
/// dense factors on the coarsest.
#[derive(Debug, Clone, Default)]
pub struct Hierarchy {
    levels: Vec<Level>,
    /// How many of them are in use; the others keep their memory.
    depth: usize,
    dense: Vec<f64>,
    dense_size: usize,
}

#[derive(Debug, Clone, Default)]
struct Level {
    /// Aggregate of each unknown of the finer level.
    aggregate: Vec<u32>,
    /// The coarse matrix.
    matrix: Csr,
    right: Vec<f64>,
    solution: Vec<f64>,
    /// Scratch of the coarsening.
    seeded: Vec<u32>,
    starts: Vec<u32>,
    members: Vec<u32>,
    next: Vec<u32>,
    slot: Vec<u32>,
}

impl Hierarchy {
    /// Builds all levels for a matrix.
    pub fn prepare(&mut self, a: &Csr) {
        let mut depth = 0;
        loop {
            let done = {
                let fine = if depth == 0 { a } else { &self.levels[depth - 1].matrix };
                fine.len() <= COARSEST || depth >= 12
            };
            if done {
                break;
            }
            if self.levels.len() <= depth {
                self.levels.push(Level::default());
            }
            let (finer, rest) = self.levels.split_at_mut(depth);
            let fine = if depth == 0 { a } else { &finer[depth - 1].matrix };
            rest[0].coarsen(fine);
            let stuck = rest[0].matrix.len() * 10 > fine.len() * 9;
            depth += 1;
            if stuck {
                break;
            }
        }
        self.depth = depth;
        let last = self.levels[..depth].last().map_or(a, |level| &level.matrix);
        self.dense_size = if last.len() <= 4 * COARSEST { last.len() } else { 0 };
        factorise(last, &mut self.dense, self.dense_size);
    }

    /// One V-cycle from zero.
    pub fn apply(&mut self, _path: SimdPath, a: &Csr, r: &[f64], z: &mut [f64]) {
        cycle(a, &mut self.levels[..self.depth], (&self.dense, self.dense_size), r, z);
    }
}

fn cycle(a: &Csr, levels: &mut [Level], dense: (&[f64], usize), r: &[f64], z: &mut [f64]) {
    let Some((level, coarser)) = levels.split_first_mut() else {
        if dense.1 == r.len() {
            substitute(dense.0, r, z);
        } else {
            sweep_down(a, r, z);
            sweep_up(a, r, z);
        }
        return;
    };
    sweep_down(a, r, z);
    level.right.fill(0.0);
    for row in 0..a.len() {
        // After a downward sweep from zero the residual is minus the upper triangle's share.
        let (columns, values) = a.row(row);
        let mut image = a.diagonal[row] * z[row];
        for (&c, v) in columns.iter().zip(values) {
            image += v * z[c as usize];
        }
        level.right[level.aggregate[row] as usize] += r[row] - image;
    }
    let mut right = std::mem::take(&mut level.right);
    let mut solution = std::mem::take(&mut level.solution);
    cycle(&level.matrix, coarser, dense, &right, &mut solution);
    for (z, &to) in z.iter_mut().zip(&level.aggregate) {
        *z += STRETCH * solution[to as usize];
    }
    std::mem::swap(&mut level.right, &mut right);
    std::mem::swap(&mut level.solution, &mut solution);
    sweep_up(a, r, z);
}

/// Forward Gauss-Seidel from zero.
fn sweep_down(a: &Csr, r: &[f64], z: &mut [f64]) {
    z.fill(0.0);
    for row in 0..a.len() {
        let (columns, values) = a.row(row);
        let mut sum = r[row];
        for (&c, v) in columns.iter().zip(values) {
            sum -= v * z[c as usize];
        }
        z[row] = sum / a.diagonal[row];
    }
}

/// Backward Gauss-Seidel.
fn sweep_up(a: &Csr, r: &[f64], z: &mut [f64]) {
    for row in (0..a.len()).rev() {
        let (columns, values) = a.row(row);
        let mut sum = r[row];
        for (&c, v) in columns.iter().zip(values) {
            sum -= v * z[c as usize];
        }
        z[row] = sum / a.diagonal[row];
    }
}

impl Level {
    fn coarsen(&mut self, fine: &Csr) {
        const NONE: u32 = u32::MAX;
        let n = fine.len();
        self.aggregate.clear();
        self.aggregate.resize(n, NONE);
        let strongest = |row: usize| fine.row(row).1.iter().copied().fold(0.0, f64::min);
        let mut count = 0_u32;
        // Seeds take all free strong neighbours.
        for row in 0..n {
            if self.aggregate[row] != NONE {
                continue;
            }
            let bound = STRONG * strongest(row);
            let (columns, values) = fine.row(row);
            let mut near = columns.iter().zip(values).filter(|&(_, &v)| v <= bound && v < 0.0);
            if near.clone().any(|(&c, _)| self.aggregate[c as usize] != NONE) {
                continue;
            }
            self.aggregate[row] = count;
            near.by_ref().for_each(|(&c, _)| self.aggregate[c as usize] = count);
            count += 1;
        }
        // The rest join the neighbour they hang on to most.
        let mut seeded = std::mem::take(&mut self.seeded);
        seeded.clone_from(&self.aggregate);
        for row in 0..n {
            if seeded[row] != NONE {
                continue;
            }
            let (columns, values) = fine.row(row);
            let best = columns
                .iter()
                .zip(values)
                .filter(|&(&c, _)| seeded[c as usize] != NONE)
                .min_by(|a, b| a.1.total_cmp(b.1));
            self.aggregate[row] = match best {
                Some((&c, _)) => seeded[c as usize],
                None => {
                    count += 1;
                    count - 1
                }
            };
        }
        self.seeded = seeded;
        self.gather(fine, count as usize);
    }

    /// The coarse matrix: sums of entries between aggregates.
    fn gather(&mut self, fine: &Csr, count: usize) {
        let Level { starts, members, next, slot, .. } = self;
        starts.clear();
        starts.resize(count + 1, 0);
        for &to in &self.aggregate {
            starts[to as usize + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        members.clear();
        members.resize(fine.len(), 0);
        next.clone_from(starts);
        for (row, &to) in self.aggregate.iter().enumerate() {
            members[next[to as usize] as usize] = row as u32;
            next[to as usize] += 1;
        }
        let coarse = &mut self.matrix;
        coarse.clear();
        slot.clear();
        slot.resize(count, u32::MAX);
        for aggregate in 0..count {
            let start = coarse.columns.len();
            let mut diagonal = 0.0;
            for &row in &members[starts[aggregate] as usize..starts[aggregate + 1] as usize] {
                diagonal += fine.diagonal[row as usize];
                let (columns, values) = fine.row(row as usize);
                for (&c, &v) in columns.iter().zip(values) {
                    let to = self.aggregate[c as usize] as usize;
                    if to == aggregate {
                        diagonal += v;
                        continue;
                    }
                    let at = slot[to] as usize;
                    if slot[to] != u32::MAX && at >= start {
                        coarse.values[at] += v;
                    } else {
                        slot[to] = coarse.columns.len() as u32;
                        coarse.columns.push(to as u32);
                        coarse.values.push(v);
                    }
                }
            }
            coarse.starts.push(coarse.columns.len() as u32);
            coarse.diagonal.push(diagonal);
        }
        self.right.resize(count, 0.0);
        self.solution.resize(count, 0.0);
    }
}

/// Dense LU factors without row exchanges: the matrix is diagonally dominant.
fn factorise(a: &Csr, dense: &mut Vec<f64>, n: usize) {
    dense.clear();
    dense.resize(n * n, 0.0);
    for row in 0..n {
        dense[row * n + row] = a.diagonal[row];
        let (columns, values) = a.row(row);
        for (&c, v) in columns.iter().zip(values) {
            dense[row * n + c as usize] += v;
        }
    }
    for k in 0..n {
        let (done, rest) = dense.split_at_mut((k + 1) * n);
        let top = &done[k * n..];
        for row in rest.chunks_exact_mut(n) {
            let factor = row[k] / top[k];
            if factor != 0.0 {
                row[k] = factor;
                for (value, top) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                    *value -= factor * top;
                }
            }
        }
    }
}

fn substitute(dense: &[f64], r: &[f64], z: &mut [f64]) {
    let n = r.len();
    for row in 0..n {
        let known: f64 = (0..row).map(|c| dense[row * n + c] * z[c]).sum();
        z[row] = r[row] - known;
    }
    for row in (0..n).rev() {
        let known: f64 = (row + 1..n).map(|c| dense[row * n + c] * z[c]).sum();
        z[row] = (z[row] - known) / dense[row * n + row];
    }
}
