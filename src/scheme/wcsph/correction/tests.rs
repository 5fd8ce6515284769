use super::*;
use crate::kernel::KernelChoice;
use crate::math::simd::{Lanes, SimdPath, Task, dispatch};

/// L of [`correction`] away from walls, and its share.
struct Corrected([f64; 3], f64);

impl Task for Corrected {
    type Output = ([f64; 3], f64);

    fn run<L: Lanes>(self) -> Self::Output {
        let moment = self.0.map(L::splat);
        let completeness = smallest_eigenvalue(moment);
        let first = |lanes: L| -> f64 { lanes.to_array()[0] };
        let found = correction(moment, completeness, L::splat(0.0), self.1);
        (found.map(first), first(surface_share(completeness, self.1)))
    }
}

/// Points of a lattice with one point per unit of area, turned by an angle. The surface, y = 0,
/// lies half a row's distance above the first row.
fn half_plane(steps: [[f64; 2]; 2], angle: f64, row: f64) -> Vec<[f64; 2]> {
    let (sine, cosine) = angle.sin_cos();
    let range = -30..=30;
    range
        .clone()
        .flat_map(|i| range.clone().map(move |j| [f64::from(i), f64::from(j)]))
        .map(|[i, j]| [0, 1].map(|axis| i * steps[0][axis] + j * steps[1][axis]))
        .map(|[x, y]| [cosine * x - sine * y, sine * x + cosine * y - 0.5 * row])
        .filter(|&[x, y]| x.abs() < 9.0 && y < -1e-9 && y > -18.0)
        .collect()
}

/// The imbalance of still water under linear pressure, in units of g. It is the root mean
/// square over the rows of the first five spacings, with the share and with the whole inverse.
fn imbalance(points: &[[f64; 2]], support: f64) -> [f64; 2] {
    let kernel = KernelChoice::WendlandC2;
    let slope = kernel.normalisation() / support.powi(3);
    // ∇_iW_ij
    let gradient = |i: usize, j: usize| {
        let [x, y] = [0, 1].map(|axis| points[i][axis] - points[j][axis]);
        let distance = x.hypot(y);
        let near = distance > 0.0 && distance < support;
        let g = if near { slope * kernel.slope_at(distance / support) / distance } else { 0.0 };
        [g * x, g * y]
    };
    let all = 0..points.len();
    let stress: Vec<([f64; 3], f64)> = all
        .clone()
        .map(|i| {
            let mut moment = [0.0; 3];
            for j in all.clone() {
                let ([gx, gy], [x, y]) = (gradient(i, j), points[i]);
                let (dx, dy) = (points[j][0] - x, points[j][1] - y);
                moment[0] += gx * dx;
                moment[1] += gx * dy;
                moment[2] += gy * dy;
            }
            let (found, share) =
                dispatch(SimdPath::Portable, Corrected(moment, first_row_share(support)));
            (found.map(|part| -points[i][1] * part), share)
        })
        .collect();
    let mut rows: Vec<usize> = all.clone().filter(|&i| points[i][1] > -5.0).collect();
    rows.retain(|&i| points[i][0].abs() < 1.2);
    [true, false].map(|shared| {
        let of = |i: usize| {
            let ([_, xy, yy], share) = stress[i];
            let part = if shared { 1.0 } else { 1.0 / share };
            [xy * part, yy * part]
        };
        let squares = rows.iter().map(|&i| {
            let push: f64 = all
                .clone()
                .map(|j| {
                    let ([gx, gy], [own, other]) = (gradient(i, j), [of(i), of(j)]);
                    -(own[0] + other[0]) * gx - (own[1] + other[1]) * gy
                })
                .sum();
            (push - 1.0).powi(2)
        });
        (squares.sum::<f64>() / rows.len() as f64).sqrt()
    })
}

#[test]
fn linear_pressure_balances_still_water_up_to_its_surface() {
    let side = (4.0_f64 / 3.0).powf(0.25);
    let square = [[1.0, 0.0], [0.0, 1.0]];
    let hexagonal = [[side, 0.0], [0.5 * side, 0.75_f64.sqrt() * side]];
    let (right, half) = (std::f64::consts::FRAC_PI_2, 0.5_f64.atan());
    let diagonal = 0.5_f64.sqrt();
    for (steps, angle, row, bound) in [
        (square, 0.0, 1.0, 0.01),
        (square, 0.5 * right, diagonal, 0.07),
        (square, half, 0.2_f64.sqrt(), 0.1),
        (hexagonal, 0.0, 0.75_f64.sqrt() * side, 0.03),
        (hexagonal, right, 0.5 * side, 0.1),
    ] {
        // Wider supports balance the rows a little worse, and need the share a little less.
        for (support, more, least) in [(4.0, 0.0, 0.12), (4.5, 0.002, 0.1), (5.0, 0.002, 0.1)] {
            let [shared, whole] = imbalance(&half_plane(steps, angle, row), support);
            println!("{angle:.2}, {support}: {shared:.3} g, with the whole of L {whole:.3} g");
            assert!(shared < bound + more, "{shared} at {angle}, {support}");
            assert!(whole > least, "{whole} at {angle}, {support}");
        }
    }
}

#[test]
fn inside_the_water_the_inverse_is_whole() {
    let (found, share) = dispatch(SimdPath::Portable, Corrected([1.25, 0.25, 1.25], 1.3));
    assert_eq!(share, 1.0);
    for (found, exact) in found.into_iter().zip([5.0 / 6.0, -1.0 / 6.0, 5.0 / 6.0]) {
        assert!((found - exact).abs() < 1e-15, "{found}");
    }
}
