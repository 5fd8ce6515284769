//! A study with more points than its file's grid.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use super::Study;
use super::case::{Assignments, Case};
use super::file::SweepFile;
use super::grid;
use crate::math::scale::Scale;
use crate::scene::ConfigError;

impl Study {
    /// The study of a file with more points, all in the order of the grid. Points that no scene may
    /// have are left out, and points that are already there. It keeps the identity of the file's
    /// study, so that its directory takes all of them.
    ///
    /// # Errors
    /// Those of the file itself.
    pub fn with_points(file: &SweepFile, points: &[Assignments]) -> Result<Study, ConfigError> {
        let study = Study::new(file)?;
        if points.is_empty() {
            return Ok(study);
        }
        let mut cases = grid::expand(file)?;
        let mut known: BTreeSet<_> = cases.iter().map(|case| case.id).collect();
        for point in points {
            let case = grid::case_at(file, point);
            cases.extend(case.ok().filter(|case| known.insert(case.id)));
        }
        let position = |case: &Case| {
            let places = file.grid.iter().zip(&case.assignments);
            let places =
                places.map(|(axis, value)| value.as_deref().map_or(-1.0, |v| axis.position(v)));
            places.collect::<Vec<_>>()
        };
        let mut placed: Vec<_> = cases.into_iter().map(|case| (position(&case), case)).collect();
        placed.sort_by(|(a, case), (b, other)| {
            a.partial_cmp(b).unwrap_or(Ordering::Equal).then(case.index.cmp(&other.index))
        });
        let cases = placed.into_iter().enumerate();
        let cases = cases.map(|(index, (_, case))| Case { index, ..case }).collect();
        Ok(Study { identity: study.identity.clone(), ..Study::of_file(file, cases) })
    }

    /// The scale of a swept key with numbers; `None` for other keys.
    pub fn scale(file: &SweepFile, key: usize) -> Option<Scale> {
        let axis = file.grid.get(key)?;
        axis.numbers().map(|_| axis.scale)
    }
}
