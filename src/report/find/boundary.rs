//! Where a condition begins and ends to be met, along one swept key.

use crate::math::scale::Scale;

/// One end of a part of an axis that meets the condition.
#[derive(Debug, Clone)]
pub struct Boundary {
    /// The swept key, by its place among the study's keys.
    pub key: usize,
    /// A case of the line, which has the values of the other swept keys.
    pub row: usize,
    /// How the axis is spread.
    pub scale: Scale,
    /// Whether the condition is met above the boundary, rather than below it.
    pub met_above: bool,
    /// The boundary; `None` where there is nothing to interpolate with.
    pub at: Option<f64>,
    /// It lies between these as far as can be told.
    pub between: [f64; 2],
    /// What was found there, and what it rests on.
    pub basis: Basis,
    /// One of the cases beside it is doubtful.
    pub doubtful: bool,
}

/// What the range of a boundary rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// The bend of the curve, from a point beside the two that are interpolated, and error bars.
    Bend,
    /// Two cases alone: no third tells how the curve bends.
    TwoCases,
    /// The value beyond is a lower bound.
    LowerBound,
    /// The cases between have no value or failed.
    Gap,
    /// The condition is on the axis itself.
    Exact,
}
