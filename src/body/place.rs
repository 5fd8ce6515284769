//! The places of bodies in a scene, and the motions of all bodies.

use std::ops::{Deref, Index, IndexMut};

use super::BodyMotion;

/// The largest number of bodies of a scene.
pub const MOST_BODIES: usize = 4;

/// The place of a body. It gives the number of its ghosts' group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Under the water.
    Bed,
    /// At the start of the tank: the paddle, where there is one.
    Left,
    /// At the end of the tank: the seawall.
    Right,
    /// Over the water.
    Lid,
    /// Behind a seawall that water goes over: its back, the floor there and the end wall.
    Behind,
}

impl Place {
    /// Its number among a scene's bodies. No scene has both a lid and ground behind a wall.
    pub const fn number(self) -> usize {
        match self {
            Place::Behind => Place::Lid.number(),
            _ => self as usize,
        }
    }
}

/// Motions of a scene's bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motions {
    all: [BodyMotion; MOST_BODIES],
    count: usize,
}

impl Motions {
    /// This many bodies at rest.
    pub fn at_rest(count: usize) -> Motions {
        Motions { all: [BodyMotion::default(); MOST_BODIES], count }
    }
}

impl Deref for Motions {
    type Target = [BodyMotion];

    fn deref(&self) -> &[BodyMotion] {
        &self.all[..self.count]
    }
}

impl Index<Place> for Motions {
    type Output = BodyMotion;

    fn index(&self, place: Place) -> &BodyMotion {
        &self.all[place.number()]
    }
}

impl IndexMut<Place> for Motions {
    fn index_mut(&mut self, place: Place) -> &mut BodyMotion {
        &mut self.all[place.number()]
    }
}
