//! Files out: CSV rows as the run goes, JSON at its end.

mod choice;
mod csv;
mod estimate;
mod explanation;
mod json;
mod readable;
mod realtime;
mod scene;
#[cfg(test)]
mod tests;
pub(crate) mod toml;

pub use choice::{
    Candidate, Choice, Fallback, PilotReference, SecondLook, TrialEntry, write_choice,
};
pub use csv::{CsvWriter, append_steps, long, shortest, write_steps};
pub use estimate::ErrorEstimate;
pub use explanation::{
    Absence, Change, ControllerStep, EffectEntry, Explanation, GuideEntry, JointGroup, LargestStep,
    Price, Prices, Relative, Rod, SearchEnd, Simulated, Sizes,
};
pub use json::{
    Chosen, Contact, ControlSummary, EnergySummary, Outputs, RunError, RunSummary, ViolationSummary,
};
pub use readable::readable;
pub(crate) use readable::rounded;
pub use realtime::{Degraded, MarginSummary, Overrun, RealtimeSummary, Times, write_overruns};
pub use scene::{WriteError, to_toml};
