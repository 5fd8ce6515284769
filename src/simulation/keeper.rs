//! Keeping a run's state now and then, so that hours of work outlive their process.

/// Keeps the states of one run. [`super::Monitor::keeper`] hands it over.
pub trait Keeper: Sync {
    /// The state that was kept last, where there is one.
    fn last(&self) -> Option<Vec<u8>>;

    /// Whether to keep the state now. Asked ahead of every step in which that can be done, and with
    /// `stopping` before a run ends because it was told to.
    fn is_due(&self, stopping: bool) -> bool;

    /// Takes a state.
    fn keep(&self, state: Vec<u8>);

    /// The state that was kept last cannot be gone on from: the run starts over.
    fn refuse(&self, why: &str);
}
