//! GMRES (Saad and Schultz 1986), for the well-conditioned equations of the second kind met here.

/// The iteration did not reach its tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotConverged;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Solves `apply(x) = right` to a residual of `tolerance`, starting from `x`.
///
/// # Errors
/// Where `most` directions are not enough.
pub fn solve(
    apply: impl Fn(&[f64], &mut [f64]),
    right: &[f64],
    x: &mut [f64],
    tolerance: f64,
    most: usize,
) -> Result<(), NotConverged> {
    let count = right.len();
    let mut residual = vec![0.0; count];
    apply(x, &mut residual);
    residual.iter_mut().zip(right).for_each(|(r, b)| *r = b - *r);
    let size = dot(&residual, &residual).sqrt();
    if !size.is_finite() {
        return Err(NotConverged);
    }
    if size <= tolerance {
        return Ok(());
    }
    let mut basis = vec![residual.iter().map(|r| r / size).collect::<Vec<f64>>()];
    let mut columns: Vec<Vec<f64>> = Vec::new(); // of the triangular factor
    let mut turns: Vec<(f64, f64)> = Vec::new();
    let mut reduced = vec![size];
    for step in 0..most {
        let mut next = vec![0.0; count];
        apply(&basis[step], &mut next);
        let mut column = Vec::with_capacity(step + 2);
        for direction in &basis {
            let share = dot(&next, direction);
            next.iter_mut().zip(direction).for_each(|(n, d)| *n -= share * d);
            column.push(share);
        }
        let rest = dot(&next, &next).sqrt();
        for (k, &(cos, sin)) in turns.iter().enumerate() {
            let (a, b) = (column[k], column[k + 1]);
            (column[k], column[k + 1]) = (cos * a + sin * b, cos * b - sin * a);
        }
        let length = column[step].hypot(rest);
        let (cos, sin) = (column[step] / length, rest / length);
        column[step] = length;
        turns.push((cos, sin));
        columns.push(column);
        let last = reduced[step];
        reduced[step] = cos * last;
        reduced.push(-sin * last);
        if reduced[step + 1].abs() <= tolerance {
            for row in (0..=step).rev() {
                let known: f64 = (row + 1..=step).map(|k| columns[k][row] * reduced[k]).sum();
                reduced[row] = (reduced[row] - known) / columns[row][row];
            }
            for (direction, share) in basis.iter().zip(&reduced) {
                x.iter_mut().zip(direction).for_each(|(x, d)| *x += share * d);
            }
            return Ok(());
        }
        basis.push(next.iter().map(|n| n / rest).collect());
    }
    Err(NotConverged)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unsymmetric_system_is_solved() {
        let entry = |i: usize, j: usize| {
            let off = 0.3 / (1.0 + 2.0 * i as f64 + j as f64);
            if i == j { 2.0 + off } else { off }
        };
        let apply = |x: &[f64], out: &mut [f64]| {
            for (i, out) in out.iter_mut().enumerate() {
                *out = x.iter().enumerate().map(|(j, x)| entry(i, j) * x).sum();
            }
        };
        let exact: Vec<f64> = (0..20).map(|i| (i as f64).sin()).collect();
        let mut right = vec![0.0; 20];
        apply(&exact, &mut right);
        let mut x = vec![0.0; 20];
        solve(apply, &right, &mut x, 1e-13, 20).unwrap();
        assert!(x.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-11));
        assert_eq!(solve(apply, &right, &mut [0.0; 20], 1e-13, 2), Err(NotConverged));
    }
}
