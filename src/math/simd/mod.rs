//! Eight-lane vectors of `f64`, with the instruction set chosen at run time.
//!
//! A hot loop is a [`Task`], written once against [`Lanes`]. [`dispatch`] compiles it for every
//! [`SimdPath`] and runs the chosen one, so that one binary serves every node of a cluster. All
//! operations are correctly rounded, so AVX-512 and AVX2 give the same bits on any processor.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;
#[cfg(target_arch = "x86_64")]
mod registers;
mod vector;

pub use vector::Vector;

use serde::{Deserialize, Serialize};

/// Number of lanes of every vector.
pub const LANES: usize = 8;

/// An instruction set for the hot loops. AVX-512 and AVX2 give the same bits. The portable path has
/// no fused multiply-add and differs in rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SimdPath {
    /// Plain Rust.
    Portable,
    /// 256-bit vectors with fused multiply-add.
    Avx2,
    /// 512-bit vectors.
    Avx512,
}

impl SimdPath {
    /// The widest that this processor has.
    pub fn widest() -> SimdPath {
        [SimdPath::Avx512, SimdPath::Avx2]
            .into_iter()
            .find(|path| path.is_supported())
            .unwrap_or(SimdPath::Portable)
    }

    /// Whether this processor has the instructions.
    pub fn is_supported(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return match self {
            SimdPath::Portable => true,
            SimdPath::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            SimdPath::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx2")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("fma")
            }
        };
        #[cfg(not(target_arch = "x86_64"))]
        return self == SimdPath::Portable;
    }
}

/// Eight values of double precision.
pub trait Lanes: Vector {
    /// Eight values of single precision, on the same path.
    type Single: Vector;

    /// The values at eight places.
    ///
    /// # Panics
    /// One of them is outside.
    fn gather(values: &[f64], at: &[u32; LANES]) -> Self;
    /// Writes eight values.
    fn store(self, values: &mut [f64; LANES]);
    /// Writes eight records of eight numbers: `numbers[n]` has number n of each of them.
    #[inline(always)]
    fn store_records<R: AsMut<[f64; 8]>>(numbers: [Self; 8], records: &mut [R; LANES]) {
        let mut columns = [[0.0; LANES]; 8];
        for (number, column) in numbers.into_iter().zip(&mut columns) {
            number.store(column);
        }
        for (lane, record) in records.iter_mut().enumerate() {
            for (column, number) in columns.iter().zip(record.as_mut()) {
                *number = column[lane];
            }
        }
    }
    /// Reads eight values in single precision.
    fn load_single(values: &[f32; LANES]) -> Self;
    /// Runs a task of the same path as a function of its own, with its own registers.
    fn call<T: Task>(task: T) -> T::Output;
    /// Prefetches the value that lies this many values after another in memory, if there is one.
    #[inline(always)]
    fn prefetch<T>(value: &T, ahead: usize) {
        let _ = (value, ahead);
    }
    /// The eight values as an array.
    #[inline(always)]
    fn to_array(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        self.store(&mut values);
        values
    }

    /// The values of several vectors. A closure would be a function of its own, without the path's
    /// instructions.
    #[inline(always)]
    fn to_arrays<const N: usize>(vectors: [Self; N]) -> [[f64; LANES]; N] {
        let mut values = [[0.0; LANES]; N];
        for (vector, values) in vectors.into_iter().zip(&mut values) {
            vector.store(values);
        }
        values
    }

    /// Their sum, always in the same order.
    #[inline(always)]
    fn sum(self) -> f64 {
        let v = self.to_array();
        ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]))
    }
}

/// A loop that is compiled once per instruction set.
pub trait Task {
    /// What it returns.
    type Output;
    /// The loop itself. It must be `#[inline(always)]`, as must everything that its hot part calls.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// Runs a task with the instructions of `path`, or portably if the processor lacks them.
pub fn dispatch<T: Task>(path: SimdPath, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    match path {
        // SAFETY: the processor has all that `run` of this path is compiled for.
        SimdPath::Avx512 if path.is_supported() => return unsafe { avx512::run(task) },
        // SAFETY: likewise.
        SimdPath::Avx2 if path.is_supported() => return unsafe { avx2::run(task) },
        _ => {}
    }
    portable::run(task)
}

#[cfg(test)]
mod tests;
