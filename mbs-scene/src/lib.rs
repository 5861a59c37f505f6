#![doc = include_str!("../README.md")]

pub mod compare;
mod dice;
pub mod format;
mod generate;
mod page;
mod read;
mod record;
mod report;
mod write;

pub use dice::Dice;
pub use generate::{Family, GenerateError, MOST_BODIES, generate};
pub use mbs_core::outputs::Component;
pub use page::page;
pub use read::{Place, ReadError, ReadFault, SceneFile, SweepFault, SweepFile, nearest_name};
pub use record::{
    Animation, Channel, ChannelSeries, EnergySeries, IterationSeries, Polyline, Provenance,
    RunRecord, StepRow, StepSeries, Trace, ViolationSeries,
};
pub use report::{Report, Section};
pub use write::{
    Candidate, Contact, ControlSummary, ControllerStep, CsvWriter, Degraded, EffectCost,
    EffectCosts, EffectEntry, EnergySummary, ErrorEstimate, Explanation, Fallback, GuideEntry,
    JointsByKind, LargestStep, MarginSummary, MethodChoice, MissingEffect, OutputChange, Outputs,
    Overrun, PilotReference, PilotReport, RealtimeSummary, Relative, RunError, RunSummary,
    SearchEnd, SecondLook, Simulated, Sizes, ThinRod, Times, TrialEntry, ViolationSummary,
    WriteError, append_steps, to_toml, write_choice, write_overruns, write_steps,
};
