//! Change of the outputs between two runs.

use serde::Serialize;

/// Change of an output between two runs.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct OutputChange {
    /// Name of the channel.
    pub output: String,
    /// Unit of these components of it.
    pub unit: String,
    /// Largest difference of a component over the run.
    pub largest: f64,
    /// Largest minus smallest value of a component in the run with all effects.
    pub range: f64,
    /// Ratio `largest / range` [-]; `None` where the range is nothing but rounding.
    pub relative: Option<f64>,
    /// The difference is nothing but rounding: at most 1e-9 of the sizes that outputs of this unit have.
    pub is_rounding: bool,
}
