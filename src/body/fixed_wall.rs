//! A wall that never moves.

use serde::{Deserialize, Serialize};

use super::WallLaw;

/// It may represent other walls as long as these are held. A run can then tell when they would
/// move.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FixedWall {
    /// The least and the largest force at which none of them moves, N per metre of width.
    pub holds: [f64; 2],
}

impl FixedWall {
    /// Represents no other wall.
    pub const ALONE: FixedWall = FixedWall { holds: [f64::NEG_INFINITY, f64::INFINITY] };

    /// Represents walls that a larger force than this moves, N per metre of width.
    pub fn up_to(threshold: f64) -> FixedWall {
        FixedWall { holds: [f64::NEG_INFINITY, threshold] }
    }
}

impl WallLaw for FixedWall {
    fn lets_go(&self, force: f64) -> bool {
        let [least, most] = self.holds;
        force < least || force > most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_tells_when_others_would_move_and_stays() {
        let mut wall = FixedWall { holds: [-1.0, 2.0] };
        assert_eq!(
            [-1.1, -1.0, 2.0, 2.1].map(|force| wall.lets_go(force)),
            [true, false, false, true]
        );
        assert!(!FixedWall::ALONE.lets_go(1e300) && FixedWall::up_to(2.0).lets_go(2.1));
        assert_eq!(wall.kick(5.0, 1.0, 0.1).travel, 0.0);
        assert!(wall.state().is_none() && wall.restraint().is_none());
    }
}
