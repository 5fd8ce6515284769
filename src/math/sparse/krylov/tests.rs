use super::*;
use crate::math::sparse::PreconditionerChoice;

const RULE: StopRule = StopRule { size: None, tolerance: 1e-12, floor: 0.0, most_iterations: 500 };

/// The five-point Laplacian on a square of `side` x `side` points, Dirichlet all around;
/// `skew` makes it unsymmetric.
fn lattice(side: usize, skew: f64) -> Csr {
    let mut a = Csr::default();
    a.clear();
    for row in 0..side * side {
        let (i, j) = (row % side, row / side);
        for (inside, column, value) in [
            (i > 0, row.wrapping_sub(1), -1.0 - skew),
            (i + 1 < side, row + 1, -1.0 + skew),
            (j > 0, row.wrapping_sub(side), -1.0),
            (j + 1 < side, row + side, -1.0),
        ] {
            if inside {
                a.columns.push(column as u32);
                a.values.push(value);
            }
        }
        a.end_row();
        a.diagonal.push(4.0);
    }
    a
}

/// Solves for sin(0.7 k), from zero. Returns the report and the largest error.
fn solve(
    a: &Csr,
    choice: PreconditionerChoice,
    symmetric: bool,
    rule: &StopRule,
) -> (SolveReport, f64) {
    let exact: Vec<f64> = (0..a.len()).map(|k| (k as f64 * 0.7).sin()).collect();
    let product = |row: usize| {
        let (columns, values) = a.row(row);
        let others = columns.iter().zip(values).map(|(&c, v)| v * exact[c as usize]);
        a.diagonal[row] * exact[row] + others.sum::<f64>()
    };
    let b: Vec<f64> = (0..a.len()).map(product).collect();
    let mut preconditioner = Preconditioner::new(choice);
    preconditioner.prepare(a);
    let path = SimdPath::widest();
    let mut stored = Stored { path, matrix: a, preconditioner: &mut preconditioner };
    let (mut solver, mut x) = (Krylov::default(), vec![0.0; b.len()]);
    let report = if symmetric {
        solver.conjugate_gradients(&mut stored, (&b, &mut x), rule)
    } else {
        solver.bicgstab(&mut stored, (&b, &mut x), rule)
    };
    let errors = x.iter().zip(&exact).map(|(x, exact)| (x - exact).abs());
    (report, errors.fold(0.0, f64::max))
}

#[test]
fn every_preconditioner_leads_to_the_solution() {
    for (skew, symmetric) in [(0.0, true), (0.3, false)] {
        for &choice in PreconditionerChoice::ALL {
            let (report, error) = solve(&lattice(12, skew), choice, symmetric, &RULE);
            assert!(report.converged && error < 1e-9, "{choice:?}: {report:?}, {error}");
        }
    }
}

#[test]
fn better_preconditioners_take_fewer_iterations() {
    let a = lattice(60, 0.0);
    let rule = StopRule { tolerance: 1e-8, ..RULE };
    let [jacobi, incomplete, multigrid] = [
        PreconditionerChoice::Jacobi,
        PreconditionerChoice::Incomplete,
        PreconditionerChoice::Multigrid,
    ]
    .map(|choice| solve(&a, choice, true, &rule).0.iterations);
    assert!(incomplete < jacobi / 2, "{incomplete} and {jacobi}");
    assert!(multigrid < incomplete, "{multigrid} and {incomplete}");
}

#[test]
fn a_solve_that_runs_out_of_iterations_says_so() {
    let rule = StopRule { most_iterations: 3, ..RULE };
    let (report, _) = solve(&lattice(30, 0.0), PreconditionerChoice::Jacobi, true, &rule);
    assert!(!report.converged && report.iterations == 3 && report.residual > 1e-6);
}
