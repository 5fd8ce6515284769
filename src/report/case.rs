//! The case behind a row, made again: the study's file with the settings of its command line, the
//! swept keys in the row, and the numerics that `--max-error` chose for it.

use rayon::prelude::*;
use toml::{Table, Value};

use super::load::Loaded;
use crate::keys::read_value;
use crate::quantities::summary::{BOUNDARY, KERNEL, PARTICLE_SPACING, SCHEME};
use crate::scene::CaseConfig;

/// The key of a recorded stroke, whose value in a file is a path.
pub(super) const STROKE: &str = "recorded_stroke";

/// How many cases are made at once, on all cores: those of a large study take gigabytes.
const BLOCK: usize = 1024;

impl Loaded {
    /// `[scene]` and `[numerics]` of a row as in a file. `None` where the study's files do not tell
    /// them, or numerics were chosen case by case and those of the row are not known.
    pub(super) fn tables(&self, place: usize) -> Option<[Table; 2]> {
        let file = self.file.as_ref()?;
        match &self.chosen {
            None if file.aims => None,
            None => file.of_row(&self.keys, place, &file.numerics),
            Some(chosen) => file.of_row(&self.keys, place, &numerics(&chosen[place])?),
        }
    }

    /// The case of a row as it ran. It reads the file of a recorded stroke.
    pub(super) fn case_as_run(&self, place: usize) -> Option<CaseConfig> {
        let [scene, numerics] = self.tables(place)?;
        CaseConfig::with_probes(&scene, &numerics, &self.file.as_ref()?.probes).ok()
    }

    /// The case of a row; `None` where the study's files do not tell it. It has the scheme, the
    /// interpolator, the kernel and the spacing of the row, whatever today's defaults are. A recorded
    /// stroke stands still on its clock: a long record in every case would take gigabytes, and its
    /// file may be out of reach where the report is made.
    pub(super) fn case(&self, place: usize) -> Option<CaseConfig> {
        self.case_and_stroke(place).map(|(case, _)| case)
    }

    /// The same, with the path of its recorded stroke.
    pub(super) fn case_and_stroke(&self, place: usize) -> Option<(CaseConfig, Option<String>)> {
        let file = self.file.as_ref()?;
        let of_file = || file.of_row(&self.keys, place, &file.numerics);
        let [mut scene, mut numerics] = self.tables(place).or_else(of_file)?;
        let row = &self.rows[place];
        for column in [&SCHEME, &BOUNDARY, &KERNEL] {
            let text = Some(row.text(column)).filter(|text| !text.is_empty());
            text.map(|text| numerics.insert(column.name.to_owned(), text.into()));
        }
        let spacing = row.number(&PARTICLE_SPACING);
        spacing.map(|spacing| numerics.insert(PARTICLE_SPACING.name.to_owned(), spacing.into()));
        let stroke = scene.get(STROKE).and_then(Value::as_str).map(str::to_owned);
        if let Some(path) = &stroke {
            scene.insert(STROKE.to_owned(), file.still_stroke(path)?);
        }
        let case = CaseConfig::with_probes(&scene, &numerics, &file.probes).ok()?;
        Some((case, stroke))
    }

    /// What `make` makes of the rows at these places, in blocks on all cores.
    pub(super) fn in_blocks<T: Send>(
        &self,
        mut places: impl Iterator<Item = usize>,
        make: impl Fn(usize) -> T + Sync,
    ) -> impl Iterator<Item = T> {
        let block = move || {
            let block: Vec<usize> = places.by_ref().take(BLOCK).collect();
            (!block.is_empty()).then(|| block.into_par_iter().map(&make).collect::<Vec<_>>())
        };
        std::iter::from_fn(block).flatten()
    }
}

/// `particle_spacing_m = 0.02, boundary = sfdi` as a table.
fn numerics(list: &str) -> Option<Table> {
    let pair = |pair: &str| {
        let (key, value) = pair.split_once(" = ")?;
        Some((key.to_owned(), read_value(value)))
    };
    list.split(", ").filter(|pair| !pair.is_empty()).map(pair).collect()
}
