//! Ghosts of a bed that is not level, and of the corners between its stretches.

use std::f64::consts::PI;

use super::corner::Corner;
use super::ghosts::{BodySites, Reflection, Site};
use super::layout::{TankLayout, at};
use super::plane::Plane;
use super::profile::{Profile, Stretch, WALL, ends_low, turn};
use super::territory::Territory;

/// The sites of a profile, and a face point for every column of the stretches that may run dry.
///
/// Each stretch continues a lattice behind its face. Where the bed bends up, the wedge between two
/// normals is filled ring by ring. Where it bends down, two lattices would overlap. There each ends
/// at the bisector, and a ghost counts by the part of its cell on its own side. Other stretches may
/// be as near behind low steps, short stretches and narrow ridges: see [`Territory`].
pub(super) fn bed_sites(layout: &TankLayout, profile: &Profile) -> BodySites {
    let stretches: Vec<_> = profile.stretches().collect();
    let mut bed = Bed {
        layout,
        territory: Territory::of(&stretches, layout.support_radius),
        level: profile.level_up_to(),
        sites: Vec::new(),
        faces: Vec::new(),
        first_faces: Vec::new(),
        edges: Vec::new(),
    };
    for (number, stretch) in stretches.iter().enumerate() {
        let before = number.checked_sub(1).map(|before| &stretches[before]);
        let after = stretches.get(number + 1);
        bed.lay((number, stretch), [before, after]);
        if let Some(after) = after.filter(|after| turn(stretch, after) > 0.0) {
            bed.fill_bend(number, [stretch, after]);
        }
    }
    bed.back_edges(&stretches);
    // The profile takes the place of the bed's own plane.
    let plane = Plane::nowhere([0.0, -1.0]);
    BodySites { sites: bed.sites, faces: bed.faces, plane }
}

struct Bed<'a> {
    layout: &'a TankLayout,
    territory: Territory<'a>,
    /// The bed is level from the paddle up to here, and never dry.
    level: f64,
    sites: Vec<Site>,
    faces: Vec<[f64; 2]>,
    /// The first face point of each stretch.
    first_faces: Vec<usize>,
    /// Numbers of ghosts below the edges of dry tops. Each comes with the number of the stretch
    /// whose face it is also behind.
    edges: Vec<(usize, usize)>,
}

impl Bed<'_> {
    /// Number of columns of ghosts behind a stretch.
    fn columns(&self, stretch: &Stretch) -> f64 {
        (stretch.length / self.layout.spacing_x).round().max(1.0)
    }

    /// The lattice behind one stretch.
    fn lay(
        &mut self,
        (number, stretch): (usize, &Stretch),
        [before, after]: [Option<&Stretch>; 2],
    ) {
        let TankLayout { spacing_y, support_radius, still_level, .. } = *self.layout;
        let columns = self.columns(stretch);
        let width = stretch.length / columns;
        let layers = (support_radius / spacing_y).ceil() as i64;
        let dries = stretch.from[0] + stretch.length > self.level + 1e-9;
        self.first_faces.push(self.faces.len());
        let low = |bend| ends_low(bend, still_level, [spacing_y, support_radius]);
        let edges = [
            before.filter(|before| low([before, stretch])),
            after.filter(|after| low([stretch, after])),
        ];
        for column in 0..columns as i64 {
            let along = at(column, width);
            let asks = dries && stretch.rise() > WALL;
            let face = if asks { self.faces.len() as u32 } else { Site::ALWAYS_WET };
            if dries {
                self.faces.push(stretch.place(along, 0.0));
            }
            for layer in 0..layers {
                let depth = at(layer, spacing_y);
                let ghost = stretch.place(along, depth);
                let mut share = 1.0_f64;
                if let Some(before) = before.filter(|before| turn(before, stretch) < 0.0) {
                    share = share.min(0.5 + past(ghost, before, stretch) / width);
                }
                if let Some(after) = after.filter(|after| turn(stretch, after) < 0.0) {
                    share = share.min(0.5 - past(ghost, stretch, after) / width);
                }
                let cell = |[a, b]: [f64; 2]| {
                    let behind = depth + b * spacing_y;
                    (stretch.place(along + a * width, behind), behind)
                };
                let share = self.territory.share([number, number], share.clamp(0.0, 1.0), cell);
                if share > 0.0 {
                    let site = Site {
                        ghost,
                        mirror: stretch.place(along, -depth),
                        reflection: Reflection::Plane { normal: stretch.normal() },
                        distance: depth,
                        face,
                        volume: width * spacing_y * share,
                        twin: Site::ALONE,
                    };
                    let behind =
                        |edge: Option<&Stretch>| edge.map_or(f64::INFINITY, |it| it.behind(ghost));
                    let [one, other] = edges.map(behind);
                    if !asks && one.min(other) < support_radius {
                        let face = if one <= other { number - 1 } else { number + 1 };
                        self.edges.push((self.sites.len(), face));
                    }
                    self.sites.push(site);
                }
            }
        }
    }

    /// Adds ghosts behind the faces below dry tops. There the ghosts of the tops have no water to
    /// mirror.
    fn back_edges(&mut self, stretches: &[Stretch]) {
        for (twin, number) in std::mem::take(&mut self.edges) {
            let (site, stretch) = (self.sites[twin], &stretches[number]);
            let columns = self.columns(stretch);
            let [along, distance] = [stretch.passed(site.ghost), stretch.behind(site.ghost)];
            let column = (along / stretch.length * columns).clamp(0.0, columns - 1.0) as usize;
            self.sites.push(Site {
                mirror: stretch.place(along, -distance),
                reflection: Reflection::Plane { normal: stretch.normal() },
                distance,
                face: (self.first_faces[number] + column) as u32,
                twin: twin as u32,
                ..site
            });
        }
    }

    /// Fills the wedge behind a bend upwards, from the stretch with this number to the next.
    fn fill_bend(&mut self, number: usize, [before, after]: [&Stretch; 2]) {
        let width = turn(before, after);
        let [nx, ny] = before.normal();
        let middle = libm::atan2(ny, nx) + 0.5 * width;
        let corner = Corner { vertex: after.from, middle, width, water: PI - width };
        for site in corner.sites(self.layout, Site::ALWAYS_WET) {
            let [x, y] = [0, 1].map(|axis| site.ghost[axis] - after.from[axis]);
            let broad = site.volume / self.layout.spacing_x / site.distance;
            let cell = |[a, b]: [f64; 2]| {
                let [sin, cos] = [libm::sin(a * broad), libm::cos(a * broad)];
                let farther = 1.0 + b * self.layout.spacing_x / site.distance;
                let place = [x * cos - y * sin, x * sin + y * cos].map(|part| part * farther);
                ([0, 1].map(|axis| after.from[axis] + place[axis]), site.distance * farther)
            };
            let share = self.territory.share([number, number + 1], 1.0, cell);
            if share > 0.0 {
                self.sites.push(Site { volume: site.volume * share, ..site });
            }
        }
    }
}

/// How far a place lies past the bisector of a bend, metres along the bed.
fn past(place: [f64; 2], before: &Stretch, after: &Stretch) -> f64 {
    let [x, y] = [0, 1].map(|axis| before.along[axis] + after.along[axis]);
    let [from_x, from_y] = after.from;
    ((place[0] - from_x) * x + (place[1] - from_y) * y) / x.hypot(y).max(1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::tank_ghosts;

    fn layout() -> TankLayout {
        TankLayout::plain(3.0, 0.5, None)
    }

    /// Ghosts behind any bed fill a strip of one support radius behind it.
    #[test]
    fn ghosts_fill_what_lies_behind_a_bed() {
        let layers = 0.1;
        for (points, solid) in [
            (vec![[0.0, 0.0], [3.0, 0.0]], 3.0 * layers),
            // A bend up by θ has a wedge of ½ θ R² in addition. A bend down lacks R² tan(θ/2).
            (
                vec![[0.0, 0.0], [1.0, 0.0], [3.0, 0.5]],
                0.1 + 0.1 * 4.25_f64.sqrt() + 0.005 * 0.25_f64.atan(),
            ),
            (
                vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.3], [3.0, 0.3]],
                0.33 + 0.005 * (PI / 2.0) - 0.01,
            ),
            // A ridge of two spacings: the part behind both of its sides counts once.
            (
                vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [1.04, 0.1], [1.04, 0.0], [3.0, 0.0]],
                0.296 + 0.004 + 0.04 * 0.099,
            ),
        ] {
            let profile = Profile::checked(points.clone()).unwrap();
            let bed = bed_sites(&layout(), &profile);
            let area: f64 = bed.sites.iter().map(|site| site.volume).sum();
            assert!((area / solid - 1.0).abs() < 0.01, "{points:?}: {area} of {solid}");
            for site in &bed.sites {
                let (_, behind) = profile.nearest(site.ghost);
                let (_, before) = profile.nearest(site.mirror);
                let own_side = behind > 0.5 * site.distance - 1e-9;
                assert!(own_side && before < 1e-9, "{points:?}: {site:?} {behind} {before}");
            }
        }
    }

    #[test]
    fn a_level_profile_has_the_ghosts_of_a_tank() {
        let level = Profile::checked(vec![[0.0, 0.0], [3.0, 0.0]]).unwrap();
        let (plain, same) =
            (tank_ghosts(&layout(), None, 0.2), tank_ghosts(&layout(), Some(&level), 0.2));
        assert_eq!(plain.x.len(), same.x.len());
        for k in 0..plain.x.len() {
            let off = (plain.x[k] - same.x[k]).abs() + (plain.target_y[k] - same.target_y[k]).abs();
            assert!(off < 1e-12, "{k}");
        }
    }
}
