use super::*;

struct Probe([f64; LANES]);

impl Task for Probe {
    type Output = [[f64; LANES]; 3];
    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let x = L::load(&self.0);
        let negative = x * L::splat(-3.0);
        [x.rsqrt().to_array(), negative.exp().to_array(), x.sqrt().div(x).to_array()]
    }
}

const INPUT: [f64; LANES] = [1e-12, 0.01, 0.3, 0.999, 1.0, 2.5, 77.0, 200.0];

fn paths() -> impl Iterator<Item = SimdPath> {
    [SimdPath::Portable, SimdPath::Avx2, SimdPath::Avx512]
        .into_iter()
        .filter(|path| path.is_supported())
}

#[test]
fn functions_match_the_standard_library_on_every_path() {
    for path in paths() {
        let [rsqrt, exp, ratio] = dispatch(path, Probe(INPUT));
        for (k, x) in INPUT.into_iter().enumerate() {
            let close = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * b.abs();
            assert!(close(rsqrt[k], 1.0 / x.sqrt(), 2e-15), "{path:?} rsqrt({x})");
            assert!(close(exp[k], (-3.0 * x).exp(), 4e-16 * (4.0 + 3.0 * x)), "{path:?} exp({x})");
            assert!(close(ratio[k], x.sqrt() / x, 3e-16), "{path:?} sqrt/x({x})");
        }
    }
}

#[derive(Clone, Copy)]
struct Row<T>([T; 8]);

impl<T> AsMut<[T; 8]> for Row<T> {
    fn as_mut(&mut self) -> &mut [T; 8] {
        &mut self.0
    }
}

struct Transposed([[f64; LANES]; 8]);

impl Task for Transposed {
    type Output = [Row<f64>; LANES];
    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let mut records = [Row([0.0; 8]); LANES];
        let mut numbers = [L::splat(0.0); 8];
        for (number, values) in numbers.iter_mut().zip(&self.0) {
            *number = L::load(values);
        }
        L::store_records(numbers, &mut records);
        records
    }
}

#[test]
fn records_are_written_number_by_number() {
    let numbers: [[f64; LANES]; 8] =
        std::array::from_fn(|n| std::array::from_fn(|record| (10 * record + n) as f64));
    for path in paths() {
        for (record, stored) in dispatch(path, Transposed(numbers)).into_iter().enumerate() {
            assert_eq!(stored.0, std::array::from_fn(|n| (10 * record + n) as f64), "{path:?}");
        }
    }
}

struct SingleProbe([f64; LANES]);

impl Task for SingleProbe {
    type Output = [[f32; LANES]; 3];
    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Output {
        let x = L::Single::load(&self.0);
        let negative = x * L::Single::splat(-3.0);
        let mut singles = [[0.0; LANES]; 3];
        for (found, into) in
            [x.rsqrt(), negative.exp(), x.sqrt().div(x)].into_iter().zip(&mut singles)
        {
            found.store_single(into);
        }
        singles
    }
}

#[test]
fn single_precision_is_good_to_its_last_digits_on_every_path() {
    for path in paths() {
        let found = dispatch(path, SingleProbe(INPUT));
        let [rsqrt, exp, ratio] = found.map(|row| row.map(f64::from));
        for (k, x) in INPUT.map(|x| f64::from(x as f32)).into_iter().enumerate() {
            let close = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * b.abs();
            assert!(close(rsqrt[k], 1.0 / x.sqrt(), 3e-7), "{path:?} rsqrt({x})");
            if x < 25.0 {
                let wrong = 1.2e-7 * (4.0 + 3.0 * x);
                assert!(close(exp[k], (-3.0 * x).exp(), wrong), "{path:?} exp({x})");
            }
            assert!(close(ratio[k], 1.0 / x.sqrt(), 2e-7), "{path:?} sqrt/x({x})");
        }
    }
    if SimdPath::Avx512.is_supported() {
        let bits = |path| dispatch(path, SingleProbe(INPUT)).map(|row| row.map(f32::to_bits));
        assert_eq!(bits(SimdPath::Avx512), bits(SimdPath::Avx2));
    }
}

#[test]
fn vector_paths_agree_to_the_bit() {
    if SimdPath::Avx512.is_supported() {
        let bits = |path| dispatch(path, Probe(INPUT)).map(|row| row.map(f64::to_bits));
        assert_eq!(bits(SimdPath::Avx512), bits(SimdPath::Avx2));
    }
}
