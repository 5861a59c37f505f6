//! Records of a run as plain data, and functions that write them as rows and objects to files.

#[doc(hidden)]
pub mod alias;
mod change;
mod channel;
mod choice;
mod csv;
mod estimate;
mod json;
mod motion;
mod outputs;
mod realtime;
mod series;
mod statistics;

pub use change::OutputChange;
pub use channel::Channel;
pub use choice::{
    Candidate, Fallback, PilotReference, PilotReport, SecondLook, TrialEntry, write_choice,
};
pub use csv::{CsvWriter, append_steps, write_steps};
pub use estimate::ErrorEstimate;
pub use json::{
    Contact, EnergySummary, MethodChoice, MethodUsed, RunError, RunSummary, ViolationSummary,
};
pub use motion::{
    BodyPlace, DrawnBody, DrawnForce, DrawnLine, DrawnPoint, DrawnRoad, DrawnShape, LineStyle,
    N_POSE, RecordedMotion, RoadStrip, ShapeForm,
};
pub use outputs::Outputs;
pub use realtime::{Degraded, MarginSummary, Overrun, RealtimeSummary, Times, write_overruns};
pub use series::{
    ChannelSeries, ControlSummary, EnergySeries, IterationSeries, Provenance, RunRecord, StepRow,
    StepSeries, ViolationSeries,
};
pub use statistics::measured;
pub use statistics::{ChannelSummary, ComponentStatistics, Statistics};
