//! What a comparison of methods says: orders, times at an error, ranks; as text, JSON, CSV and a page.

mod captions;
mod csv;
mod data;
mod digest;
mod fit;
mod front;
mod page;
mod plots;
mod rank;
mod scale;
mod text;

pub use csv::write_comparison;
pub use data::{
    Cell, Comparison, ConvergenceMap, CrossCheck, Energy, Fit, JudgedChoice, MethodRuns, Origin,
    OutputScale, Rank, RankLevel, Reference, RunEntry, Status, StepTimes,
};
pub use page::comparison_page;
pub use scale::{output_scales, row_distance};
