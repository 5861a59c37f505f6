#![doc = include_str!("../README.md")]

pub mod compare;
mod dice;
mod generate;
mod page;
mod read;
mod record;
mod report;
mod write;

pub use dice::Dice;
pub use generate::{Family, GenerateError, MOST_BODIES, generate};
pub use page::page;
pub use read::{Place, ReadError, ReadFault, SceneFile, Sweep, SweepFault, suggestion};
pub use record::{
    Animation, Channel, ChannelSeries, Component, EnergySeries, IterationSeries, Polyline,
    Provenance, RunRecord, StepRow, StepSeries, Trace, ViolationSeries,
};
pub use report::{Report, Section};
pub use write::{
    Absence, Candidate, Change, Choice, Chosen, Contact, ControlSummary, ControllerStep, CsvWriter,
    Degraded, EffectEntry, EnergySummary, ErrorEstimate, Explanation, Fallback, GuideEntry,
    JointGroup, LargestStep, MarginSummary, Outputs, Overrun, PilotReference, Price, Prices,
    RealtimeSummary, Relative, Rod, RunError, RunSummary, SearchEnd, SecondLook, Simulated, Sizes,
    Times, TrialEntry, ViolationSummary, WriteError, append_steps, long, readable, shortest,
    to_toml, write_choice, write_overruns, write_steps,
};
