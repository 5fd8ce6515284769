//! Resolution companions: the same cases with coarser particles. Their differences give the error
//! bars (`results/error_bars.rs`).
//!
//! A companion is a run like any other: planned, branched from its own trunk, journalled, resumed.
//! It has no row in the summary and leaves no history.

use std::f64::consts::SQRT_2;

use super::case::{Case, CaseId};
use super::case_map::CaseMap;
use crate::keys::Recent;
use crate::scene::{CaseConfig, ErrorBars};

/// The fewest rows of particles over the depth for which readings change regularly with the
/// spacing. With fewer rows the runup of a steep wave has irregular errors of tenths of the depth.
const FEWEST_ROWS: f64 = 10.0;

/// Whether the case would have ten rows of particles or more with `ratio` times its spacing.
pub fn has_enough_rows(config: &CaseConfig, ratio: f64) -> bool {
    let rows = config.scene.frame().depth / config.numerics.particle_spacing_m;
    rows >= ratio * FEWEST_ROWS - 1e-6
}

/// Spacings of a case's companions over its own. Twice the spacing costs about an eighth, √2 times
/// the spacing about a third.
fn ratios(bars: ErrorBars, config: &CaseConfig) -> &'static [f64] {
    match bars {
        ErrorBars::None => &[],
        ErrorBars::Pair if !has_enough_rows(config, 2.0) => &[SQRT_2],
        ErrorBars::Pair => &[2.0],
        ErrorBars::Triple => &[SQRT_2, 2.0],
    }
}

/// The companions of a study's cases, each once. For every case it also gives the indices of its
/// own companions among cases and companions. If the grid sweeps the spacing, a case may be the
/// companion of another. A companion too coarse for its depth is left out. So is one too coarse for
/// another part of its scene, such as a crest. The companion of a pair is then the finer one.
pub(super) fn plan(cases: &[Case], bars: &[ErrorBars]) -> (Vec<Case>, Vec<Vec<usize>>) {
    let mut places: CaseMap<usize> = cases.iter().map(|case| (case.id, case.index)).collect();
    let mut companions: Vec<Case> = Vec::new();
    let mut numerics = Recent::default();
    let mut of = Vec::with_capacity(cases.len());
    let bars = bars.iter().copied().chain(std::iter::repeat(ErrorBars::None));
    for (case, bars) in cases.iter().zip(bars) {
        let mut own = Vec::new();
        let mut coarser: Vec<CaseConfig> = ratios(bars, &case.config)
            .iter()
            .filter_map(|&ratio| case.config.coarsened(ratio).ok())
            .collect();
        if coarser.is_empty() && bars == ErrorBars::Pair {
            coarser.extend(case.config.coarsened(SQRT_2));
        }
        for mut config in coarser {
            numerics.share(&mut config.numerics);
            own.push(place(config, case, &mut places, &mut companions, cases.len()));
        }
        of.push(own);
    }
    (companions, of)
}

fn place(
    config: CaseConfig,
    case: &Case,
    places: &mut CaseMap<usize>,
    companions: &mut Vec<Case>,
    first: usize,
) -> usize {
    let id = CaseId::of(&config);
    *places.entry(id).or_insert_with(|| {
        let index = first + companions.len();
        companions.push(Case { index, id, config, assignments: case.assignments.clone() });
        index
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::SQRT_2;

    use crate::study::Study;
    use crate::study::file::SweepFile;

    fn study(text: &str) -> Study {
        Study::new(&SweepFile::read(&format!("name = \"a\"\n{text}"), &[]).unwrap()).unwrap()
    }

    const WAVES: &str = "[grid]\nwave_height_ratio = [0.2, 0.3]";

    #[test]
    fn bars_change_no_case() {
        let without = study(WAVES);
        for bars in ["pair", "triple"] {
            let with = study(&format!("[numerics]\nerror_bars = \"{bars}\"\n{WAVES}"));
            assert_eq!(with.cases, without.cases);
            assert_eq!(with.identity, without.identity);
        }
        assert!(without.companions.is_empty());
    }

    #[test]
    fn a_pair_is_twice_as_coarse_and_a_triple_also_in_between() {
        let spacings = |study: &Study, case: usize| -> Vec<f64> {
            let own = &study.companions_of[case];
            own.iter().map(|&run| study.run(run).config.numerics.particle_spacing_m).collect()
        };
        let pair = study(&format!("[numerics]\nerror_bars = \"pair\"\n{WAVES}"));
        assert_eq!(pair.companions.len(), 2);
        assert_eq!(spacings(&pair, 1), [0.02]);
        assert_eq!(pair.companions[1].index, 3);
        let triple = study(&format!("[numerics]\nerror_bars = \"triple\"\n{WAVES}"));
        assert_eq!(spacings(&triple, 0), [0.01 * SQRT_2, 0.02]);
    }

    #[test]
    fn cases_of_the_grid_serve_as_companions() {
        let grid = "[grid]\nparticle_spacing_m = [0.005, 0.01, 0.02, 0.04]";
        let study = study(&format!("[numerics]\nerror_bars = \"pair\"\n{grid}"));
        assert_eq!(study.companions_of, [vec![1], vec![2], vec![4], vec![]]);
        let own = study.run(4).config.numerics.particle_spacing_m;
        assert_eq!((study.companions.len(), own), (1, 0.02 * SQRT_2));
        assert_eq!(study.without_bars, 1, "the coarsest has five rows");
    }

    /// A crest of nine spacings once left its case without error bars, because kernels of twice the
    /// spacing are wider.
    #[test]
    fn where_twice_the_spacing_cannot_run_the_nearer_companion_does() {
        let crest =
            "[scene]\nbehind = \"outflow\"\ncrest_freeboard_m = 0.04\ncrest_width_m = 0.075";
        let spacings = |own: f64| -> Vec<f64> {
            let numerics = format!("particle_spacing_m = {own}\nerror_bars = \"pair\"");
            let study = study(&format!("{crest}\n[numerics]\n{numerics}\n{WAVES}"));
            let runs = study.companions_of[0].iter();
            runs.map(|&run| study.run(run).config.numerics.particle_spacing_m / own).collect()
        };
        assert_eq!([0.006, 0.008, 0.0099].map(spacings), [vec![2.0], vec![SQRT_2], vec![SQRT_2]]);
    }

    /// Five rows of particles, at twice the spacing, say nothing about ten rows.
    #[test]
    fn few_rows_have_a_nearer_companion() {
        let spacing = |own: f64| {
            let numerics = format!("particle_spacing_m = {own}\nerror_bars = \"pair\"");
            let study = study(&format!("[numerics]\n{numerics}\n{WAVES}"));
            study.run(study.companions_of[0][0]).config.numerics.particle_spacing_m / own
        };
        assert_eq!([0.008, 0.01, 0.0101, 0.02].map(spacing), [2.0, 2.0, SQRT_2, SQRT_2]);
    }
}
