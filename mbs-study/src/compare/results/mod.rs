//! Results of a comparison of methods as data, JSON and CSV: orders, times at an error, and ranks.

mod csv;
mod data;
mod digest;
pub(crate) mod fit;
pub(crate) mod front;
pub(crate) mod rank;
pub(crate) mod scale;

pub use csv::write_comparison;
pub use data::{
    Cell, Comparison, ConvergenceMap, CrossCheck, Energy, Fit, JudgedChoice, MethodRuns, Origin,
    OutputScale, Rank, RankLevel, Reference, RunEntry, Status, StepTimes,
};
pub use scale::{output_scales, row_distance};
