//! Ghost particles and the points in the water that they mirror.

use std::ops::Range;

use super::crest::Crest;
use super::plane::Plane;
use super::profile::Profile;
use crate::body::Place;
use crate::math::simd::LANES;
use crate::pairs::Strips;

/// How a ghost reflects the water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reflection {
    /// At a straight wall with this unit normal, out of the water.
    Plane {
        /// Unit normal out of the water.
        normal: [f64; 2],
    },
    /// At the corner between two walls: through the corner's vertex.
    Corner,
}

/// One ghost before it is stored: all places in the frame of its body, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// The ghost.
    pub ghost: [f64; 2],
    /// The point it mirrors.
    pub mirror: [f64; 2],
    /// How it reflects.
    pub reflection: Reflection,
    /// Its distance from the wall (from the vertex, in a corner).
    pub distance: f64,
    /// Number of the point on the face that tells whether it is wet.
    pub face: u32,
    /// Volume that it stands for (an area, in two dimensions), m².
    pub volume: f64,
    /// Number of another site at the same place, if the two share one weight.
    pub twin: u32,
}

impl Site {
    /// In place of a face point: a ghost behind a wall that never runs dry.
    pub const ALWAYS_WET: u32 = u32::MAX;
    /// In place of a twin.
    pub const ALONE: u32 = u32::MAX;
}

/// A body before its ghosts are stored.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySites {
    /// Its ghosts.
    pub sites: Vec<Site>,
    /// Points on its face that tell whether it is wet.
    pub faces: Vec<[f64; 2]>,
    /// Its face.
    pub plane: Plane,
}

/// The ghosts that move together, and where their points lie in the arrays of [`Ghosts`].
#[derive(Debug, Clone)]
pub struct GhostBody {
    /// Ghosts (whole vectors; the last entries may be padding).
    pub ghosts: Range<usize>,
    /// Face points among the targets, in the order given to [`Ghosts::new`].
    pub faces: Range<usize>,
    /// Its face.
    pub plane: Plane,
    /// Strips of the ghosts.
    pub strips: Strips,
    /// Box around the ghosts in the body's frame: x from, x to, y from, y to.
    pub bounds: [f64; 4],
}

/// All ghosts, body by body, and the target points at which the water is interpolated: first the
/// mirror point of each ghost under the same number, then every body's face points.
#[derive(Debug, Clone, Default)]
pub struct Ghosts {
    /// x in the body's frame, metres.
    pub x: Vec<f64>,
    /// y.
    pub y: Vec<f64>,
    /// Reflection of each ghost.
    pub reflection: Vec<Reflection>,
    /// Distance of each ghost from its wall or vertex, metres.
    pub distance: Vec<f64>,
    /// Face point (a number among the targets) of each ghost.
    pub face: Vec<u32>,
    /// The other ghost at the same place, if the two share one weight; else [`Site::ALONE`].
    pub twin: Vec<u32>,
    /// Full volume (an area, in two dimensions), m²; 0 for padding.
    pub volume: Vec<f64>,
    /// x of the targets in their body's frame.
    pub target_x: Vec<f64>,
    /// y of the targets.
    pub target_y: Vec<f64>,
    /// Body of each vector of eight targets.
    pub target_body: Vec<u8>,
    /// The bodies.
    pub bodies: Vec<GhostBody>,
    /// The bed, where it is not level.
    pub profile: Option<Profile>,
    /// Whether the bed rises out of the still water, and a right wall stands in water behind it.
    pub lagoon: bool,
    /// Where its shore begins, metres, if it has one: see [`Profile::shore`].
    pub shore: Option<f64>,
    /// The crest of the right wall, if water may go over it.
    pub crest: Option<Crest>,
}

impl Ghosts {
    /// Arranges the sites, face points and planes of bodies. `strip_width` is that of the neighbour
    /// search.
    pub fn new(bodies: &[BodySites], strip_width: f64) -> Ghosts {
        let mut all = Ghosts::default();
        for body in bodies {
            all.push_ghosts(&body.sites, body.plane, strip_width);
        }
        for (number, body) in bodies.iter().enumerate() {
            all.push_faces(number, &body.faces);
        }
        all
    }

    /// Whether the bed ends on a slope. If so, behind the wall there is only the wedge of their
    /// corner.
    pub fn end_on_slope(&self) -> bool {
        self.profile.as_ref().is_some_and(|bed| !bed.ends_level())
    }

    /// The line that bounds the water from below, if it is more than a level bed between walls. It
    /// is the bed, and with a crest also the wall's face, its top, its back and what lies behind.
    pub fn outline(&self) -> Option<&Profile> {
        self.crest.as_ref().map(|crest| &crest.outline).or(self.profile.as_ref())
    }

    /// The height of the ground under a gauge, metres above the paddle's foot.
    pub fn ground(&self, x: f64) -> f64 {
        let bed = || self.profile.as_ref().map_or(0.0, |bed| bed.height(x));
        self.crest.as_ref().map_or_else(bed, |crest| crest.ground(x))
    }

    /// Whether water stays behind a crest.
    pub fn keeps_behind(&self) -> bool {
        self.crest.as_ref().is_some_and(|crest| crest.end.is_some())
    }

    /// The lowest place where water may be, metres above the paddle's foot.
    pub fn lowest(&self) -> f64 {
        let floor = self.crest.as_ref().and_then(|crest| crest.line_behind());
        floor.into_iter().flatten().fold(0.0, |low, point| low.min(point[1]))
    }

    /// Whether a ghost stands for deep water even under a thin sheet: below a bed that is not
    /// level, below a crest, and below the floor behind it.
    pub(super) fn is_deep(&self, g: usize) -> bool {
        let below = |body: usize| self.bodies[body].ghosts.contains(&g);
        let level = Reflection::Plane { normal: [0.0, -1.0] };
        let floor = [level, Reflection::Corner];
        self.profile.is_some() && below(Place::Bed.number())
            || self.crest.is_some() && below(Place::Right.number()) && self.reflection[g] == level
            || self.keeps_behind()
                && below(Place::Behind.number())
                && floor.contains(&self.reflection[g])
    }

    /// Number of ghosts, padding included.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// True where there are no walls.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    fn push_ghosts(&mut self, sites: &[Site], plane: Plane, strip_width: f64) {
        let xs: Vec<f64> = sites.iter().map(|site| site.ghost[0]).collect();
        let ys: Vec<f64> = sites.iter().map(|site| site.ghost[1]).collect();
        let ties: Vec<u32> = (0..sites.len() as u32).collect();
        let (_, order) = Strips::sort(&xs, &ys, &ties, strip_width);
        let start = self.x.len();
        let body = self.bodies.len() as u8;
        let mut places = vec![0; sites.len()];
        for &number in &order {
            let site = &sites[number as usize];
            places[number as usize] = self.x.len() as u32;
            self.push_site(site, site.volume);
        }
        for (number, site) in sites.iter().enumerate().filter(|(_, site)| site.twin != Site::ALONE)
        {
            let [own, other] = [places[number], places[site.twin as usize]];
            (self.twin[own as usize], self.twin[other as usize]) = (other, own);
        }
        if let Some(&last) = order.last() {
            while !self.x.len().is_multiple_of(LANES) {
                self.push_site(&sites[last as usize], 0.0);
            }
        }
        self.target_body.resize(self.x.len() / LANES, body);
        let range = start..self.x.len();
        let (x, y) = (&self.x[range.clone()], &self.y[range.clone()]);
        let low = |values: &[f64]| values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.bodies.push(GhostBody {
            plane,
            strips: Strips::of_sorted(x, y, strip_width),
            bounds: [low(x), high(x), low(y), high(y)],
            ghosts: range,
            faces: 0..0,
        });
    }

    fn push_site(&mut self, site: &Site, volume: f64) {
        self.x.push(site.ghost[0]);
        self.y.push(site.ghost[1]);
        self.reflection.push(site.reflection);
        self.distance.push(site.distance);
        self.face.push(site.face);
        self.volume.push(volume);
        self.twin.push(Site::ALONE);
        self.target_x.push(site.mirror[0]);
        self.target_y.push(site.mirror[1]);
    }

    fn push_faces(&mut self, number: usize, faces: &[[f64; 2]]) {
        let start = self.target_x.len();
        self.target_x.extend(faces.iter().map(|point| point[0]));
        self.target_y.extend(faces.iter().map(|point| point[1]));
        let end = self.target_x.len();
        let body = &mut self.bodies[number];
        body.faces = start..end;
        for face in &mut self.face[body.ghosts.clone()] {
            if *face != Site::ALWAYS_WET {
                *face += start as u32;
            }
        }
        while !self.target_x.len().is_multiple_of(LANES) {
            self.target_x.push(self.target_x[end - 1]);
            self.target_y.push(self.target_y[end - 1]);
        }
        self.target_body.resize(self.target_x.len() / LANES, number as u8);
    }
}
