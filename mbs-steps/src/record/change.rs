//! Change of the outputs between two runs.

use serde::Serialize;

/// Change of an output between two runs.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct OutputChange {
    /// Name of the channel.
    pub output: String,
    /// Unit of the components of the output that are compared.
    pub unit: String,
    /// Largest difference of a component between the two runs.
    pub largest: f64,
    /// Largest range of a component (maximum minus minimum) in the run with all effects.
    pub range: f64,
    /// Ratio `largest / range` [-]; `None` if the range is only rounding error.
    pub relative: Option<f64>,
    /// True if the difference is only rounding error: at most 1e-9 of the largest value among the outputs with this unit.
    pub is_rounding: bool,
}
