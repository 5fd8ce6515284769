//! The water: one array per field.

use serde::{Deserialize, Serialize};

use crate::math::simd::LANES;

/// Fluid particles, one array per field, in the order of the neighbour search.
///
/// Every array is padded to whole vectors. A padding entry repeats the last particle's place and
/// has no mass, so it never counts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Fluid {
    len: usize,
    /// Positions, metres.
    pub x: Vec<f64>,
    /// Heights, metres.
    pub y: Vec<f64>,
    /// Horizontal velocities, m/s.
    pub vx: Vec<f64>,
    /// Vertical velocities, m/s.
    pub vy: Vec<f64>,
    /// Densities, kg/m³.
    pub density: Vec<f64>,
    /// Masses, kg per metre of width.
    pub mass: Vec<f64>,
    /// Numbers that stay with the particles when they are reordered.
    pub id: Vec<u32>,
}

impl Fluid {
    /// Particles at rest from (x, y, density, mass).
    pub fn at_rest(points: impl IntoIterator<Item = [f64; 4]>) -> Fluid {
        let mut fluid = Fluid::default();
        for [x, y, density, mass] in points {
            fluid.x.push(x);
            fluid.y.push(y);
            fluid.density.push(density);
            fluid.mass.push(mass);
        }
        fluid.len = fluid.x.len();
        fluid.vx = vec![0.0; fluid.len];
        fluid.vy = vec![0.0; fluid.len];
        fluid.id = (0..fluid.len as u32).collect();
        fluid.pad();
        fluid
    }

    /// Number of particles, without padding.
    pub fn len(&self) -> usize {
        self.len
    }

    /// True for no particles at all.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// |u| of a particle, m/s.
    pub fn speed(&self, i: usize) -> f64 {
        let (vx, vy) = (self.vx[i], self.vy[i]);
        (vx * vx + vy * vy).sqrt()
    }

    /// Length of the arrays: a whole number of vectors.
    pub fn padded_len(&self) -> usize {
        self.len.next_multiple_of(LANES)
    }

    /// All fields but the numbers.
    fn fields_mut(&mut self) -> [&mut Vec<f64>; 6] {
        let Fluid { x, y, vx, vy, density, mass, .. } = self;
        [x, y, vx, vy, density, mass]
    }

    /// Puts the particles into a new order: entry k becomes the old `order[k]`.
    pub fn reorder(&mut self, order: &[u32], scratch: &mut Vec<f64>) {
        debug_assert_eq!(order.len(), self.len);
        let len = self.len;
        for field in self.fields_mut() {
            reorder(&mut field[..len], order, scratch);
        }
        // A number of 32 bits passes through a float unchanged.
        scratch.clear();
        scratch.extend(order.iter().map(|&from| f64::from(self.id[from as usize])));
        for (id, number) in self.id.iter_mut().zip(scratch) {
            *id = *number as u32;
        }
        self.pad();
    }

    /// Keeps the particles at these places in the arrays, in their order.
    pub fn keep(&mut self, kept: &[u32]) {
        self.len = kept.len();
        for field in self.fields_mut() {
            *field = gather(field, kept);
        }
        self.id = kept.iter().map(|&from| self.id[from as usize]).collect();
        self.pad();
    }

    fn pad(&mut self) {
        let (last, padded) = (self.len.saturating_sub(1), self.padded_len());
        for field in [&mut self.x, &mut self.y, &mut self.vx, &mut self.vy, &mut self.density] {
            let value = field.get(last).copied().unwrap_or(0.0);
            field.truncate(self.len);
            field.resize(padded, value);
        }
        self.mass.truncate(self.len);
        self.mass.resize(padded, 0.0);
        self.id.resize(padded, u32::MAX);
    }
}

/// The entries of a field at some places.
pub fn gather<T: Copy>(field: &[T], places: &[u32]) -> Vec<T> {
    places.iter().map(|&from| field[from as usize]).collect()
}

/// Puts a field into a new order: entry k becomes the old `order[k]`.
pub fn reorder(field: &mut [f64], order: &[u32], scratch: &mut Vec<f64>) {
    scratch.clear();
    scratch.extend(order.iter().map(|&from| field[from as usize]));
    field.copy_from_slice(scratch);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padding_repeats_the_last_place_without_mass() {
        let mut fluid = Fluid::at_rest((0..11).map(|k| [f64::from(k), 2.0, 1000.0, 0.5]));
        assert_eq!((fluid.len(), fluid.padded_len()), (11, 16));
        let order: Vec<u32> = (0..11).rev().collect();
        fluid.reorder(&order, &mut Vec::new());
        assert_eq!(fluid.x[..3], [10.0, 9.0, 8.0]);
        assert_eq!((fluid.x[15], fluid.mass[15], fluid.id[0]), (0.0, 0.0, 10));
        assert_eq!(fluid.mass.iter().sum::<f64>(), 5.5);
    }

    #[test]
    fn what_is_kept_keeps_its_number() {
        let mut fluid = Fluid::at_rest((0..11).map(|k| [f64::from(k), 2.0, 1000.0, 0.5]));
        fluid.keep(&[1, 4, 5, 10]);
        assert_eq!((fluid.len(), fluid.padded_len()), (4, 8));
        assert_eq!((fluid.id[..4].to_vec(), fluid.x[3]), (vec![1, 4, 5, 10], 10.0));
        assert_eq!((fluid.mass.iter().sum::<f64>(), fluid.id[4]), (2.0, u32::MAX));
    }
}
