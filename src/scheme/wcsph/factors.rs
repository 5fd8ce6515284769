//! What held passes multiply with the slopes.

/// Numbers of a neighbour, one cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub(super) struct Factors(pub [f64; 8]);

impl AsMut<[f64; 8]> for Factors {
    #[inline(always)]
    fn as_mut(&mut self) -> &mut [f64; 8] {
        &mut self.0
    }
}

/// The numbers of all neighbours, fluid and ghosts: those of their velocities for the continuity pass,
/// and those of their pressures for an acoustic step's forces.
#[derive(Debug, Clone, Default)]
pub(super) struct Numbers {
    velocities: Vec<Factors>,
    /// Empty where they take the place of the velocities, which are not needed any more.
    pressures: Vec<Factors>,
}

impl Numbers {
    /// Numbers of so many neighbours.
    pub fn of(neighbours: usize) -> Numbers {
        Numbers { velocities: vec![Factors::default(); neighbours], pressures: Vec::new() }
    }

    /// Gives pressures a place of their own, for parts that go ahead of others.
    pub fn keep_apart(&mut self) {
        self.pressures.resize(self.velocities.len(), Factors::default());
    }

    pub fn velocities(&self) -> &[Factors] {
        &self.velocities
    }

    pub fn velocities_mut(&mut self) -> &mut [Factors] {
        &mut self.velocities
    }

    pub fn pressures(&self) -> &[Factors] {
        if self.pressures.is_empty() { &self.velocities } else { &self.pressures }
    }

    pub fn pressures_mut(&mut self) -> &mut [Factors] {
        if self.pressures.is_empty() { &mut self.velocities } else { &mut self.pressures }
    }
}
