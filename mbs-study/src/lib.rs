#![doc = include_str!("../README.md")]
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]

pub mod auto;
pub mod compare;
pub mod doctor;
mod error;
pub mod estimate;
pub mod explain;
mod front;
pub mod imported;
mod journal;
pub mod remedy;
mod stretches;
pub mod sweep;

pub use mbs_redundancy as redundancy;

pub use compare::Request as Compare;
pub use front::{Sweep, SweepResult, compare, run, run_with, sweep};

/// Items for the tests of this crate; they are no part of its interface.
#[doc(hidden)]
pub mod inside {
    pub use crate::doctor::motion::refined;
    pub use crate::estimate::differences::{GROWTH, errors};
    pub use crate::explain::timing::TrialTimes;
    pub use crate::journal::{Head, Journal, Kind};
    pub use crate::sweep::member::MemberValues;
    pub use crate::sweep::whole_rows;
    pub use mbs_redundancy::decompose::{Group, groups};

    pub mod auto {
        pub use crate::auto::candidates::PilotCandidate;
        pub use crate::auto::check::check;
        pub use crate::auto::choose::methods;
        pub use crate::auto::estimate::{Basis, Point, PowerLaw, Prediction, predict};
        pub use crate::auto::goal::{PilotTarget, check_goal};
        pub use crate::auto::pilot::{BUDGET, BUDGET_FRACTION, PilotPlace, PilotSearch};
        pub use crate::auto::trial::{Aim, Bench, Trial, TrialEnd};
    }

    pub mod compare {
        pub use crate::compare::clocked::step_times;
        pub use crate::compare::ladder::{Instants, steps, tolerances};
        pub use crate::compare::layout::{LEVELS, moved};
        pub use crate::compare::map::MapPlan;
        pub use crate::compare::method::{Control, MethodCase};
        pub use crate::compare::reference::{Known, RunPair};
        pub use crate::compare::rounds::{completed, unsettled};
        pub use crate::compare::runs::Refinement;
        pub use crate::compare::store::ResultStore;
        pub use crate::compare::table::{ReferenceTable, read};
    }

    pub mod results {
        pub use crate::compare::results::fit::fit;
        pub use crate::compare::results::front::{Beside, at_error, beside};
        pub use crate::compare::results::rank::{APART, rank};
        pub use crate::compare::results::scale::FLOOR;
    }
}
