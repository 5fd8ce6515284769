//! Smoothing kernels, in coordinates scaled by the support radius R.
//!
//! W(r) = C/R² · w(q) with q = r/R, zero for q ≥ 1. A kernel needs one file with one [`Kernel`]
//! implementation, and two lines here: its `mod` and its place in `kernels!`. Its name in scene
//! files comes from there. The tests below run over all kernels.

mod cubic_spline;
mod gaussian;
mod quintic_spline;
mod wendland_c2;
mod wendland_c4;

use crate::math::simd::{Lanes, Vector};

/// A radial kernel with compact support, by its dimensionless shape w(q).
pub trait Kernel: Copy + Send + Sync + 'static {
    /// Smoothing length h over the support radius R: the h of the terms α h c0 and δ h c0.
    const SMOOTHING_LENGTH_RATIO: f64;

    /// C, such that C ∫ w(q) 2π q dq = 1.
    fn normalisation() -> f64;

    /// w(q) from s = q² (above 0) and 1/q.
    fn shape<V: Vector>(s: V, inverse_q: V) -> V;

    /// A constant factor of w'(q)/q that is applied elsewhere, once per particle.
    const SLOPE_FACTOR: f64;

    /// w'(q)/q over [`Kernel::SLOPE_FACTOR`] from s = q² (above 0), q and 1/q; zero where q ≥ 1.
    fn slope_over_q<V: Vector>(s: V, roots: [V; 2]) -> V;
}

/// w(q) for s = q², exactly zero where q ≥ 1.
#[inline(always)]
pub fn shape_within<K: Kernel, V: Vector>(s: V) -> V {
    let s = s.max(V::splat(1e-12));
    let value = K::shape(s, s.rsqrt()).max(V::splat(0.0));
    s.select_less(V::splat(1.0), value, V::splat(0.0))
}

/// Declares the family: the names of scene files (in kebab case), the list of all, and
/// `with_kernel!`, which runs a body with a type's name bound to the kernel of a choice.
macro_rules! kernels {
    ($d:tt $($(#[$doc:meta])* $name:ident in $file:ident;)+) => {
        $(pub use $file::$name;)+

        /// Names of the kernels, as scene files spell them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum KernelChoice {
            $($(#[$doc])* $name,)+
        }

        impl KernelChoice {
            /// Every kernel.
            pub const ALL: [KernelChoice; [$(stringify!($name)),+].len()] =
                [$(KernelChoice::$name),+];
        }

        macro_rules! with_kernel {
            ($d choice:expr, $d K:ident => $d body:expr) => {
                match $d choice {
                    $($crate::kernel::KernelChoice::$name => {
                        type $d K = $crate::kernel::$name;
                        $d body
                    })+
                }
            };
        }
        pub(crate) use with_kernel;
    };
}

kernels! { $
    /// Wendland C2.
    WendlandC2 in wendland_c2;
    /// Wendland C4.
    WendlandC4 in wendland_c4;
    /// Truncated Gaussian of Huang et al. 2019, Eq. 7.
    Gaussian in gaussian;
    /// Cubic B-spline.
    CubicSpline in cubic_spline;
    /// Quintic B-spline.
    QuinticSpline in quintic_spline;
}

impl KernelChoice {
    /// h/R, see [`Kernel::SMOOTHING_LENGTH_RATIO`].
    pub fn smoothing_length_ratio(self) -> f64 {
        with_kernel!(self, K => K::SMOOTHING_LENGTH_RATIO)
    }

    /// See [`Kernel::SLOPE_FACTOR`].
    pub fn slope_factor(self) -> f64 {
        with_kernel!(self, K => K::SLOPE_FACTOR)
    }

    /// C, see [`Kernel::normalisation`].
    pub fn normalisation(self) -> f64 {
        with_kernel!(self, K => K::normalisation())
    }

    /// w(q), one value at a time: for set-up and tests.
    pub fn shape_at(self, q: f64) -> f64 {
        if q >= 1.0 { 0.0 } else { self.probe(q).0 }
    }

    /// w'(q), one value at a time: for set-up and tests.
    pub fn slope_at(self, q: f64) -> f64 {
        if q >= 1.0 { 0.0 } else { q * self.probe(q).1 }
    }

    fn probe(self, q: f64) -> (f64, f64) {
        struct Probe<K>(f64, std::marker::PhantomData<K>);
        impl<K: Kernel> crate::math::simd::Task for Probe<K> {
            type Output = (f64, f64);
            #[inline(always)]
            fn run<L: Lanes>(self) -> (f64, f64) {
                let (s, inverse) = (L::splat(self.0 * self.0), L::splat(1.0 / self.0));
                let slope = K::slope_over_q(s, [s * inverse, inverse]);
                (K::shape(s, inverse).to_array()[0], slope.to_array()[0] * K::SLOPE_FACTOR)
            }
        }
        let q = q.max(1e-9);
        let path = crate::math::simd::SimdPath::Portable;
        with_kernel!(self, K => crate::math::simd::dispatch(
            path, Probe::<K>(q, std::marker::PhantomData)))
    }

    /// Share of the kernel's integral on the near side of a straight line. The line is at the
    /// signed distance `d` (in support radii) beyond the kernel's centre: 1/2 at d = 0, 1 for d ≥
    /// 1.
    pub fn half_plane_fraction(self, d: f64) -> f64 {
        if d.abs() >= 1.0 {
            return if d > 0.0 { 1.0 } else { 0.0 };
        }
        // The part beyond |d|: arcs of half-angle acos(|d|/q), midpoint rule in t with
        // q = |d| + (1 - |d|) t², which takes the root out of acos at q = |d|.
        const STEPS: usize = 256;
        let (near, width) = (d.abs(), 1.0 - d.abs());
        let beyond: f64 = (0..STEPS)
            .map(|k| (k as f64 + 0.5) / STEPS as f64)
            .map(|t| (near + width * t * t, 2.0 * width * t / STEPS as f64))
            .map(|(q, dq)| self.shape_at(q) * 2.0 * libm::acos(near / q) * q * dq)
            .sum::<f64>()
            * self.normalisation();
        if d > 0.0 { 1.0 - beyond } else { beyond }
    }

    /// ⟨|x|⟩/R, ⟨x²⟩/R² and ⟨|x + R/2|⟩/R, weighted with W along a line through the kernel's middle.
    pub fn line_moments(self) -> [f64; 3] {
        const STEPS: u32 = 2000;
        let (mut weights, mut first, mut second, mut aside) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..STEPS {
            let q = (f64::from(k) + 0.5) / f64::from(STEPS);
            let w = self.shape_at(q);
            weights += w;
            first += w * q;
            second += w * q * q;
            aside += w * q.max(0.5); // the mean of |½ + q| and |½ - q|
        }
        [first / weights, second / weights, aside / weights]
    }
}

#[cfg(test)]
mod tests;
