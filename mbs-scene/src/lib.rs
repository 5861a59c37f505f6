#![doc = include_str!("../README.md")]

mod page;
mod read;
mod record;
mod write;

pub use page::page;
pub use read::{Document, Place, ReadError, ReadFault, suggestion};
pub use record::{
    Animation, Channel, ChannelSeries, Component, EnergySeries, IterationSeries, Polyline,
    Provenance, RunRecord, Trace, ViolationSeries,
};
pub use write::{
    Chosen, CsvWriter, EnergySummary, Outputs, RunError, RunSummary, ViolationSummary, readable,
};
