use super::*;

#[test]
fn every_kernel_integrates_to_one() {
    for kernel in KernelChoice::ALL {
        let n = 20_000;
        let integral: f64 = (0..n)
            .map(|k| (k as f64 + 0.5) / f64::from(n))
            .map(|q| kernel.shape_at(q) * std::f64::consts::TAU * q / f64::from(n))
            .sum::<f64>()
            * kernel.normalisation();
        assert!((integral - 1.0).abs() < 1e-7, "{kernel:?}: {integral}");
    }
}

#[test]
fn every_slope_is_the_derivative_of_its_shape() {
    for kernel in KernelChoice::ALL {
        for k in 1..100 {
            let (q, step) = (f64::from(k) / 100.0, 1e-5);
            let numeric = (kernel.shape_at(q + step) - kernel.shape_at(q - step)) / (2.0 * step);
            let told = kernel.slope_at(q);
            assert!((numeric - told).abs() < 2e-4, "{kernel:?} at {q}: {numeric} vs {told}");
        }
    }
}

#[test]
fn every_kernel_ends_at_its_support() {
    struct Beyond<K>(std::marker::PhantomData<K>);
    impl<K: Kernel> crate::math::simd::Task for Beyond<K> {
        type Output = [f64; 8];
        fn run<L: Lanes>(self) -> [f64; 8] {
            let s = L::load(&[1.0, 1.0001, 1.1, 1.5, 2.0, 4.0, 9.0, 100.0]);
            K::slope_over_q(s, s.roots()).to_array()
        }
    }
    for kernel in KernelChoice::ALL {
        let beyond = with_kernel!(kernel, K => crate::math::simd::dispatch(
            crate::math::simd::SimdPath::widest(), Beyond::<K>(std::marker::PhantomData)));
        // At q = 1 rounding of 1 - q remains in a slope that falls straight to zero.
        assert!(beyond[0].abs() < 1e-15, "{kernel:?}: {beyond:?}");
        assert!(beyond[1..].iter().all(|v| v.abs() < 1e-30), "{kernel:?}: {beyond:?}");
        assert!(kernel.shape_at(0.999_999).abs() < 1e-4, "{kernel:?}");
    }
}

#[test]
fn splines_hold_their_textbook_values() {
    // 10/(7π h²) at r = 0 and a quarter of it at r = h; 7·66/(478π h²) at 0, 7·26/(478π h²) at h.
    let pi = std::f64::consts::PI;
    let over_h = |kernel: KernelChoice, r: f64| {
        let h = kernel.smoothing_length_ratio();
        h * h * kernel.normalisation() * kernel.shape_at(r * h)
    };
    for (kernel, r, exact) in [
        (KernelChoice::CubicSpline, 0.0, 10.0 / (7.0 * pi)),
        (KernelChoice::CubicSpline, 1.0, 2.5 / (7.0 * pi)),
        (KernelChoice::QuinticSpline, 0.0, 7.0 * 66.0 / (478.0 * pi)),
        (KernelChoice::QuinticSpline, 1.0, 7.0 * 26.0 / (478.0 * pi)),
    ] {
        assert!((over_h(kernel, r) - exact).abs() < 1e-7, "{kernel:?} at {r} h");
    }
}

#[test]
fn line_moments_of_wendland_c2_are_those_of_its_polynomial() {
    // ∫ (1-q)⁴(1+4q) qⁿ dq = 1/3, 1/14, 1/42 for n = 0, 1, 2; over q > ½ 1/48 and 11/896 for n = 0, 1.
    let [first, second, aside] = KernelChoice::WendlandC2.line_moments();
    assert!((first - 3.0 / 14.0).abs() < 1e-6 && (second - 1.0 / 14.0).abs() < 1e-6);
    let beyond = 3.0 * (11.0 / 896.0 - 0.5 / 48.0);
    assert!((aside - 0.5 - beyond).abs() < 1e-6, "{aside}");
}

#[test]
fn half_plane_fractions_are_shares() {
    for kernel in KernelChoice::ALL {
        assert!((kernel.half_plane_fraction(0.0) - 0.5).abs() < 1e-4);
        let (a, b) = (kernel.half_plane_fraction(0.3), kernel.half_plane_fraction(-0.3));
        assert!((a + b - 1.0).abs() < 1e-12 && a > 0.7);
    }
}
