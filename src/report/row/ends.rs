//! Where the cells of a row end in its text.

/// Where each cell of a row ends. In a large study these numbers take half as much as the text.
#[derive(Debug, Clone, PartialEq)]
pub enum Ends {
    /// Two bytes each.
    Short(Box<[u16]>),
    /// For rows that are too long for this.
    Long(Box<[usize]>),
}

impl Default for Ends {
    fn default() -> Ends {
        Ends::of(&[])
    }
}

impl Ends {
    /// Stores these ends.
    pub fn of(ends: &[usize]) -> Ends {
        let short: Result<_, _> = ends.iter().map(|&end| u16::try_from(end)).collect();
        short.map_or_else(|_| Ends::Long(ends.into()), Ends::Short)
    }

    /// Where the cell at a place ends.
    pub fn get(&self, place: usize) -> Option<usize> {
        match self {
            Ends::Short(ends) => ends.get(place).map(|&end| usize::from(end)),
            Ends::Long(ends) => ends.get(place).copied(),
        }
    }
}
