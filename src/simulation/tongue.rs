//! Runup on a beach, read where the water has a given thickness.
//!
//! A tongue of water gets thinner towards its tip. The place where it is one particle spacing thick
//! depends on the spacing. The place of a fixed thickness is the same for every spacing, except for
//! errors of the computation. The thickness at x is the volume of water per length there. It is a
//! mean over [`REACH`] spacings to each side in which nearer water weighs more. It may be less than
//! a spacing: there a tongue's particles lie farther apart.

use crate::boundary::Profile;
use crate::pairs::Fluid;
use crate::scene::CaseConfig;

/// Reach of the mean, in particle spacings.
const REACH: f64 = 2.0;
/// Distance between the places of thickness, in particle spacings.
const APART: f64 = 0.5;
/// A tongue ends where it is too thin at this many places in a row. Fewer may be gaps between
/// particles.
const THIN: usize = 4;

/// Water on a beach, by its thickness.
pub(super) struct Tongue {
    /// The wanted thickness, m.
    thickness: f64,
    /// Where the bed begins to rise, m.
    from: f64,
    apart: f64,
    reach: f64,
    /// Heights of the bed from there on, m.
    bed: Vec<f64>,
    /// Thicknesses of the water there, m.
    thicknesses: Vec<f64>,
}

impl Tongue {
    /// For a case on its bed, if its runups are read this way.
    pub(super) fn of(config: &CaseConfig, bed: &Profile) -> Option<Tongue> {
        let thickness = config.scene.seawall()?.runup_thickness_m?;
        Some(Tongue::new(bed, config.numerics.particle_spacing_m, thickness))
    }

    /// For a bed and water with this particle spacing, up to this thickness; both in metres.
    fn new(bed: &Profile, spacing: f64, thickness: f64) -> Tongue {
        let (from, apart) = (bed.level_up_to(), APART * spacing);
        let count = ((bed.end()[0] - from) / apart).floor() as usize + 1;
        let heights = (0..count).map(|place| bed.height(from + apart * place as f64)).collect();
        let thicknesses = vec![0.0; count];
        Tongue { thickness, from, apart, reach: REACH * spacing, bed: heights, thicknesses }
    }

    /// Level of the surface where the water first stays thinner than wanted, up the beach, metres
    /// above the bed's beginning. If the water is thick enough up to the wall, it is the level read
    /// `at_wall`.
    pub(super) fn level(&mut self, water: &Fluid, at_wall: f64) -> f64 {
        self.spread(water);
        let is_thin = |places: &[f64]| places.iter().all(|&place| place < self.thickness);
        let edge = self.thicknesses.windows(THIN).position(is_thin);
        let bed = match edge {
            Some(0) => self.bed[0],
            Some(edge) => {
                let [thick, thin] = [edge - 1, edge].map(|place| self.thicknesses[place]);
                let part = (thick - self.thickness) / (thick - thin);
                self.bed[edge - 1] + part * (self.bed[edge] - self.bed[edge - 1])
            }
            None => return at_wall.max(self.bed[self.bed.len() - 1] + self.thickness),
        };
        bed + self.thickness
    }

    /// Finds all thicknesses.
    fn spread(&mut self, water: &Fluid) {
        let Tongue { from, apart, reach, thicknesses, .. } = self;
        thicknesses.fill(0.0);
        for k in 0..water.len() {
            let along = water.x[k] - *from;
            if along < -*reach {
                continue;
            }
            let volume = water.mass[k] / (water.density[k] * *reach);
            let first = ((along - *reach) / *apart).max(0.0) as usize;
            for (place, thickness) in thicknesses.iter_mut().enumerate().skip(first) {
                let away = (*apart * place as f64 - along) / *reach;
                if away >= 1.0 {
                    break;
                }
                *thickness += volume * (1.0 - away.abs()).max(0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wedge of water with rows and columns at this spacing. It lies on a slope of 1:10 from 1 m,
    /// where it is 0.1 m thick, to 2 m.
    fn wedge(spacing: f64) -> Fluid {
        let columns = (2.0 / spacing) as usize;
        let column = |k: usize| spacing * (k as f64 + 0.5);
        let thickness = |x: f64| if x < 1.0 { 0.1 } else { 0.1 * (2.0 - x) };
        Fluid::at_rest((0..columns).map(|k| {
            let x = column(k);
            [x, 0.0, 1000.0, 1000.0 * spacing * thickness(x)]
        }))
    }

    #[test]
    fn a_wedge_is_as_thick_as_asked_where_it_is() {
        let bed = Profile::checked(vec![[0.0, 0.0], [1.0, 0.0], [3.0, 0.2]]).unwrap();
        for spacing in [0.004, 0.01, 0.02] {
            for thickness in [0.5 * spacing, spacing, 0.05] {
                let level = Tongue::new(&bed, spacing, thickness).level(&wedge(spacing), 0.0);
                // The surface is level, at 0.1 m everywhere.
                assert!((level - 0.1).abs() < 0.03 * spacing, "{spacing} {thickness}: {level}");
            }
        }
    }

    #[test]
    fn water_that_is_thick_up_to_the_wall_has_no_edge() {
        let bed = Profile::checked(vec![[0.0, 0.0], [0.5, 0.0], [0.9, 0.04]]).unwrap();
        let mut tongue = Tongue::new(&bed, 0.01, 0.02);
        assert_eq!(tongue.level(&wedge(0.01), 0.11), 0.11);
        assert!((tongue.level(&wedge(0.01), 0.0) - 0.06).abs() < 1e-9);
        assert_eq!(tongue.level(&Fluid::at_rest(std::iter::empty()), 0.11), 0.02);
    }

    #[test]
    fn particles_that_lie_apart_are_a_thin_tongue() {
        // 0.01 m apart in height, 0.02 m along: a tongue of half a spacing, with gaps.
        let bed = Profile::checked(vec![[0.0, 0.0], [0.1, 0.0], [3.0, 0.29]]).unwrap();
        let tongue = Fluid::at_rest((0..100).map(|k| [0.02 * (f64::from(k) + 0.5), 0.0, 1e3, 0.1]));
        let level = Tongue::new(&bed, 0.01, 0.004).level(&tongue, 0.0);
        assert!((level - 0.004 - 0.19).abs() < 0.002, "{level}");
    }
}
