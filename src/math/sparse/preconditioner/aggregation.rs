//! Multigrid by plain aggregation.

mod block;

use super::Inverse;
use super::dense::Dense;
use crate::math::sparse::Csr;
use crate::math::team::cut;
use block::Block;

/// A level with at most this many unknowns is solved directly.
const COARSEST: usize = 120;
/// Largest number of levels.
const DEEPEST: usize = 12;
/// A neighbour joins an aggregate if its entry is at least this share of the row's largest.
const STRONG: f64 = 0.25;
/// Coarse corrections of plain aggregation are too small, so they are multiplied by this factor
/// (Braess 1995).
const STRETCH: f64 = 1.6;
/// Means no aggregate.
const NONE: u32 = u32::MAX;

/// Aggregates of aggregates. On every level there is one symmetric Gauss-Seidel sweep down and one
/// up; the coarsest has dense factors.
#[derive(Debug, Clone, Default)]
pub struct Hierarchy {
    levels: [Level; DEEPEST],
    /// Number of levels in use.
    depth: usize,
    dense: Dense,
}

#[derive(Debug, Clone, Default)]
struct Level {
    /// Aggregate of each unknown of the finer level.
    aggregate: Vec<u32>,
    /// The coarse matrix.
    matrix: Csr,
    /// Number of entries of each row of the finer level that count in a sweep from zero.
    reached: Vec<u32>,
    /// The residual of the finer level after a sweep.
    left: Vec<f64>,
    right: Vec<f64>,
    solution: Vec<f64>,
    /// Work space of the coarsening.
    seeded: Vec<u32>,
    starts: Vec<u32>,
    members: Vec<u32>,
    next: Vec<u32>,
    blocks: Vec<Block>,
}

impl Inverse for Hierarchy {
    /// Builds all levels for a matrix.
    fn prepare(&mut self, a: &Csr) {
        self.depth = 0;
        let mut shrinks = true;
        loop {
            let (finer, coarser) = self.levels.split_at_mut(self.depth);
            let fine = finer.last().map_or(a, |level| &level.matrix);
            if !shrinks || fine.len() <= COARSEST || self.depth == DEEPEST {
                self.dense.factorise(fine, 4 * COARSEST);
                return;
            }
            coarser[0].coarsen(fine);
            shrinks = coarser[0].matrix.len() * 10 <= fine.len() * 9;
            self.depth += 1;
        }
    }

    /// One V-cycle from zero.
    fn apply(&mut self, a: &Csr, r: &[f64], z: &mut [f64]) {
        cycle(a, &mut self.levels[..self.depth], &self.dense, r, z);
    }
}

fn cycle(a: &Csr, levels: &mut [Level], dense: &Dense, r: &[f64], z: &mut [f64]) {
    let Some((level, coarser)) = levels.split_first_mut() else {
        if dense.size == r.len() {
            dense.substitute(r, z);
        } else {
            z.fill(0.0);
            relax(a, r, z, 0..a.len());
            relax(a, r, z, (0..a.len()).rev());
        }
        return;
    };
    let Level { aggregate, matrix, reached, left, right, solution, .. } = level;
    z.fill(0.0);
    relax_from_zero(a, reached, r, z);
    let found = &*z;
    a.each_row(left, |row| {
        let (columns, values) = a.row(row);
        let mut image = a.diagonal[row] * found[row];
        for (&c, v) in columns.iter().zip(values) {
            image += v * found[c as usize];
        }
        r[row] - image
    });
    right.fill(0.0);
    for (left, &to) in left.iter().zip(&*aggregate) {
        right[to as usize] += left;
    }
    cycle(matrix, coarser, dense, right, solution);
    for (z, &to) in z.iter_mut().zip(&*aggregate) {
        *z += STRETCH * solution[to as usize];
    }
    relax(a, r, z, (0..a.len()).rev());
}

/// Forward Gauss-Seidel from zero. Entries that would be multiplied by zeros are skipped.
fn relax_from_zero(a: &Csr, reached: &[u32], r: &[f64], z: &mut [f64]) {
    for row in 0..a.len() {
        let (columns, values) = a.row(row);
        let count = reached[row] as usize;
        let mut sum = r[row];
        for (&c, v) in columns[..count].iter().zip(values) {
            sum -= v * z[c as usize];
        }
        if count < columns.len() {
            // Turns -0, from a negative entry times zero, into 0.
            sum += 0.0;
        }
        z[row] = sum / a.diagonal[row];
    }
}

/// Number of entries of a row that count in a forward sweep from zero. Later ones would be
/// multiplied by zeros. All count if none of the later ones is negative.
fn reached(a: &Csr, row: usize) -> u32 {
    let (columns, values) = a.row(row);
    let later = columns.iter().rev().take_while(|&&c| c as usize > row).count();
    let count = columns.len() - later;
    let negative = values[count..].iter().any(|&v| v < 0.0);
    (if negative { count } else { columns.len() }) as u32
}

/// Gauss-Seidel over rows in some order.
fn relax(a: &Csr, r: &[f64], z: &mut [f64], rows: impl Iterator<Item = usize>) {
    for row in rows {
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
        let Level { aggregate, seeded, reached: counts, .. } = self;
        let n = fine.len();
        counts.resize(n, 0);
        fine.each_row(counts, |row| reached(fine, row));
        aggregate.clear();
        aggregate.resize(n, NONE);
        let mut count = 0;
        // Seeds take all free strong neighbours.
        for row in 0..n {
            let (columns, values) = fine.row(row);
            let bound = STRONG * values.iter().copied().fold(0.0, f64::min);
            let mut near = columns.iter().zip(values).filter(|&(_, &v)| v <= bound && v < 0.0);
            let free = |at: usize| aggregate[at] == NONE;
            if free(row) && near.clone().all(|(&c, _)| free(c as usize)) {
                aggregate[row] = count;
                near.by_ref().for_each(|(&c, _)| aggregate[c as usize] = count);
                count += 1;
            }
        }
        // The rest join the neighbour with the strongest entry.
        seeded.clone_from(aggregate);
        for row in (0..n).filter(|&row| seeded[row] == NONE) {
            let (columns, values) = fine.row(row);
            let near = columns.iter().zip(values).filter(|&(&c, _)| seeded[c as usize] != NONE);
            aggregate[row] = match near.min_by(|a, b| a.1.total_cmp(b.1)) {
                Some((&c, _)) => seeded[c as usize],
                None => {
                    count += 1;
                    count - 1
                }
            };
        }
        self.gather(fine, count as usize);
    }

    /// The coarse matrix: sums of entries between aggregates.
    fn gather(&mut self, fine: &Csr, count: usize) {
        self.list_members(count);
        let Level { aggregate, matrix, starts, members, blocks, .. } = self;
        let team = fine.team();
        blocks.resize_with(team.parts(), Block::default);
        for (block, rows) in blocks.iter_mut().zip(cut(count, team.parts())) {
            block.rows = rows;
        }
        // The first rows are assembled in their final place.
        std::mem::swap(&mut blocks[0].matrix, matrix);
        let members = |row: usize| &members[starts[row] as usize..starts[row + 1] as usize];
        team.share(blocks, (), &|block, ()| block.gather(fine, aggregate, (count, members)));
        std::mem::swap(&mut blocks[0].matrix, matrix);
        blocks[1..].iter().for_each(|block| matrix.append(&block.matrix));
        self.left.resize(fine.len(), 0.0);
        self.right.resize(count, 0.0);
        self.solution.resize(count, 0.0);
    }

    /// Lists the unknowns of each aggregate.
    fn list_members(&mut self, count: usize) {
        let Level { aggregate, starts, members, next, .. } = self;
        starts.clear();
        starts.resize(count + 1, 0);
        for &to in &*aggregate {
            starts[to as usize + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        members.clear();
        members.resize(aggregate.len(), 0);
        next.clone_from(starts);
        for (row, &to) in aggregate.iter().enumerate() {
            members[next[to as usize] as usize] = row as u32;
            next[to as usize] += 1;
        }
    }
}
