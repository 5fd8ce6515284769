//! Where bodies stand in a scene, and what all of them do at an instant.

use std::ops::{Deref, Index, IndexMut};

use super::BodyMotion;

/// A scene has at most so many bodies.
pub const MOST_BODIES: usize = 4;

/// Where a body stands. Its ghosts have this number.
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
    /// Its number among a scene's bodies. No scene has both a lid and what lies behind a wall.
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
    /// Of so many bodies at rest.
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
