//! Files out: CSV rows as the run goes, JSON at its end.

mod alias;
mod choice;
mod csv;
mod estimate;
mod explanation;
mod json;
mod outputs;
mod realtime;
mod scene;
mod serde;
#[cfg(test)]
mod tests;
pub(crate) mod toml;

pub use crate::record::ControlSummary;
pub use choice::{
    Candidate, Fallback, PilotReference, PilotReport, SecondLook, TrialEntry, write_choice,
};
pub use csv::{CsvWriter, append_steps, write_steps};
pub use estimate::ErrorEstimate;
pub use explanation::{
    ControllerStep, EffectCost, EffectCosts, EffectEntry, Explanation, GuideEntry, JointsByKind,
    LargestStep, MissingEffect, OutputChange, Relative, SearchEnd, Simulated, Sizes, ThinRod,
};
pub use json::{Contact, EnergySummary, MethodChoice, RunError, RunSummary, ViolationSummary};
pub use outputs::Outputs;
pub use realtime::{Degraded, MarginSummary, Overrun, RealtimeSummary, Times, write_overruns};
pub use scene::{WriteError, to_toml};
