//! Arrays to be written, cut together with the parts.

/// Arrays to be written, with a fixed number of values per item, in the order of the parts.
pub trait Rows: Send + Sized {
    /// Splits off the rows of the first `first` of `all` items.
    fn split(self, first: usize, all: usize) -> (Self, Self);
}

impl Rows for () {
    fn split(self, _: usize, _: usize) -> ((), ()) {
        ((), ())
    }
}

impl<T: Send> Rows for &mut [T] {
    fn split(self, first: usize, all: usize) -> (Self, Self) {
        let each = self.len() / all.max(1);
        self.split_at_mut(first * each)
    }
}

/// This many values per item, as far as the array goes: the last items may have fewer, or none.
pub struct First<'a, T>(pub &'a mut [T], pub usize);

impl<T: Send> Rows for First<'_, T> {
    fn split(self, first: usize, _: usize) -> (Self, Self) {
        let First(values, each) = self;
        let (front, back) = values.split_at_mut(values.len().min(first * each));
        (First(front, each), First(back, each))
    }
}

impl<R: Rows, const N: usize> Rows for [R; N] {
    fn split(self, first: usize, all: usize) -> (Self, Self) {
        let mut rest = [const { None }; N];
        let mut rests = rest.iter_mut();
        let front = self.map(|rows| {
            let (front, back) = rows.split(first, all);
            if let Some(rest) = rests.next() {
                *rest = Some(back);
            }
            front
        });
        (front, rest.map(|rows| rows.expect("as many as there are in front")))
    }
}

impl<A: Rows, B: Rows> Rows for (A, B) {
    fn split(self, first: usize, all: usize) -> (Self, Self) {
        let ((a, more_a), (b, more_b)) = (self.0.split(first, all), self.1.split(first, all));
        ((a, b), (more_a, more_b))
    }
}
