//! Values that many cases share.

use std::collections::VecDeque;
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

/// A value that is stored once for all owners. An owner that changes it gets a copy.
#[derive(Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Shared<T>(Arc<T>);

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Shared<T> {
        Shared(Arc::clone(&self.0))
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Clone> DerefMut for Shared<T> {
    fn deref_mut(&mut self) -> &mut T {
        Arc::make_mut(&mut self.0)
    }
}

impl<T: PartialEq> PartialEq for Shared<T> {
    fn eq(&self, other: &Shared<T>) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl<T> From<T> for Shared<T> {
    fn from(value: T) -> Shared<T> {
        Shared(Arc::new(value))
    }
}

/// Number of values that are remembered.
const REMEMBERED: usize = 128;

/// Remembers recent values.
#[derive(Debug)]
pub struct Recent<T>(VecDeque<T>);

impl<T> Default for Recent<T> {
    fn default() -> Recent<T> {
        Recent(VecDeque::new())
    }
}

impl<T> Recent<T> {
    /// The recent value for which `is` holds. If there is none, a new one is made and remembered.
    pub fn find(&mut self, is: impl Fn(&T) -> bool, make: impl FnOnce() -> T) -> &T {
        let at = self.0.iter().position(is).unwrap_or_else(|| {
            self.0.truncate(REMEMBERED - 1);
            self.0.push_front(make());
            0
        });
        &self.0[at]
    }
}

impl<T: PartialEq> Recent<Shared<T>> {
    /// Replaces this value by an equal recent one, so that it is stored once.
    pub fn share(&mut self, value: &mut Shared<T>) {
        *value = self.find(|known| known == value, || value.clone()).clone();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_are_held_once_until_one_changes() {
        let mut pool = Recent::default();
        let [mut a, mut b] = [vec![1], vec![1]].map(Shared::from);
        pool.share(&mut a);
        pool.share(&mut b);
        assert!(Arc::ptr_eq(&a.0, &b.0));
        b.push(2);
        assert_eq!((&*a, &*b), (&vec![1], &vec![1, 2]));
        assert_ne!(a, b);
    }

    #[test]
    fn only_so_many_are_remembered() {
        let mut pool = Recent::default();
        for number in 0..1000 {
            pool.share(&mut Shared::from(number));
        }
        assert_eq!(pool.0.len(), REMEMBERED);
    }

    #[test]
    fn it_is_written_as_what_it_holds() {
        let text = serde_json::to_string(&Shared::from(vec![0.1, 2.0])).unwrap();
        assert_eq!(text, "[0.1,2.0]");
        assert_eq!(serde_json::from_str::<Shared<Vec<f64>>>(&text).unwrap()[..], [0.1, 2.0]);
    }
}
