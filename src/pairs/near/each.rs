//! Values that are found particle by particle, or point by point.

use super::{Field, Near, Values};
use crate::pairs::record::Record;

impl Near {
    /// Writes `find(i)` for every particle i.
    pub fn each<R: Values>(&self, values: R, find: impl Fn(usize) -> R::Value + Sync) {
        self.team.read(&self.parts, values, &|part, mut values| {
            let lanes = part.lanes();
            for (place, particle) in (lanes.start..lanes.end.min(self.water)).enumerate() {
                values.put(place, find(particle));
            }
        });
    }

    /// Changes the values of every particle in some fields, given its number.
    pub fn change<const N: usize>(
        &self,
        fields: [&mut [f64]; N],
        change: impl Fn(usize, &mut [f64; N]) + Sync,
    ) {
        self.team.read(&self.parts, fields.map(Field), &|part, fields| {
            let lanes = part.lanes();
            for (place, particle) in (lanes.start..lanes.end.min(self.water)).enumerate() {
                let mut own = [0.0; N];
                for n in 0..N {
                    own[n] = fields[n].0[place];
                }
                change(particle, &mut own);
                for n in 0..N {
                    fields[n].0[place] = own[n];
                }
            }
        });
    }

    /// Writes `find(e)` for every point e.
    pub fn of_points<T: Send>(&self, values: &mut [T], find: impl Fn(usize) -> T + Sync) {
        self.team.read(&self.cuts, values, &|cut, values| {
            for (point, value) in cut.clone().zip(values) {
                *value = find(point);
            }
        });
    }

    /// Fills the records of all points. `fill` gets the number of the point, and that of the
    /// particle that it is or is the image of.
    pub fn each_point(&mut self, fill: impl Fn([usize; 2], &mut Record) + Sync) {
        let Near { team, cuts, records, original, .. } = self;
        team.read(cuts, &mut records[..], &|cut, records| {
            let originals = &original[cut.clone()];
            for ((point, &original), record) in cut.clone().zip(originals).zip(records) {
                fill([point, original as usize], record);
            }
        });
    }
}
