#![doc = include_str!("../README.md")]

pub mod compare;
mod diagnosis;
mod explanation;
mod page;
mod report;
mod table;
mod text;

pub use compare::comparison_page;
pub use diagnosis::report as diagnosis;
pub use explanation::report as explanation;
pub use page::{difference_page, paced_page, page, plots_page, sweep_page};
pub use report::{Report, Section};
