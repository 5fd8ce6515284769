//! The kinds of walls at the end of a wave tank, and what sets each apart from the others.
//!
//! Others ask what a wall does, and name no kind.

use serde::{Deserialize, Serialize};

/// The motion of the seawall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WallChoice {
    /// It stands still.
    Fixed,
    /// It is mounted on a spring (Liang et al. 2017, Eqs. 16-18).
    Movable,
    /// It slides on its bed with Coulomb friction.
    Caisson,
}

/// How a wall looks in a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallLook {
    /// A slab.
    Slab,
    /// A slab with a spring behind it.
    Sprung,
    /// A broad block.
    Block,
}

/// What sets a kind of wall apart.
struct Nature {
    /// Its name.
    words: &'static str,
    /// A title with its motion.
    title: &'static str,
    /// What absorbs the energy in its law of motion.
    resistance: &'static str,
    /// Whether it may move.
    moves: bool,
    /// Whether the keys `threshold_ratio` and `force_coupling` say when it moves, and how much.
    has_threshold: bool,
    look: WallLook,
}

impl WallChoice {
    fn nature(self) -> Nature {
        match self {
            WallChoice::Fixed => Nature {
                words: "fixed wall",
                title: "fixed wall",
                resistance: "threshold device",
                moves: false,
                has_threshold: true, // of the movable walls that it stands for
                look: WallLook::Slab,
            },
            WallChoice::Movable => Nature {
                words: "movable wall",
                title: "wall on a spring",
                resistance: "threshold device",
                moves: true,
                has_threshold: true,
                look: WallLook::Sprung,
            },
            WallChoice::Caisson => Nature {
                words: "caisson",
                title: "sliding caisson",
                resistance: "friction and water behind",
                moves: true,
                has_threshold: false,
                look: WallLook::Block,
            },
        }
    }

    /// Its name.
    pub fn words(self) -> &'static str {
        self.nature().words
    }

    /// A title with its motion.
    pub fn title(self) -> &'static str {
        self.nature().title
    }

    /// What absorbs the energy in this wall's law of motion.
    pub fn resistance(self) -> &'static str {
        self.nature().resistance
    }

    /// Whether this wall may move.
    pub fn moves(self) -> bool {
        self.nature().moves
    }

    /// Whether the keys `threshold_ratio` and `force_coupling` say when it moves, and how much.
    pub(super) fn has_threshold(self) -> bool {
        self.nature().has_threshold
    }

    /// How it looks in a film.
    pub fn look(self) -> WallLook {
        self.nature().look
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, StrDeserializer};

    use super::*;
    use crate::keys::{Section, Shape};
    use crate::scene::SeawallScene;

    /// The story: a new wall had a threshold, and the keys that set it did not name the wall.
    #[test]
    fn keys_of_the_threshold_name_the_walls_that_have_one() {
        let keys = SeawallScene::keys();
        let key = |name: &str| keys.iter().find(|key| key.name == name).unwrap();
        let Shape::Names(walls) = (key("wall").shape)() else { panic!("walls have names") };
        for name in walls {
            let word: StrDeserializer<Error> = name.into_deserializer();
            let wall = WallChoice::deserialize(word).unwrap();
            for of in ["threshold_ratio", "force_coupling"] {
                let read = key(of).rule.read.unwrap();
                assert_eq!(read.values.contains(name), wall.has_threshold(), "{of}, {name}");
            }
        }
    }
}
