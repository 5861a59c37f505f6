//! Errors of a scene, with the entry, its index and the key.

use crate::scene::SceneFault;
use core::fmt::{self, Display, Formatter};

/// Entry of the scene that an error refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// Table `[scene]` of scene files.
    Scene,
    /// `[[body]]` number i (from 0).
    Body(usize),
    /// `[[joint]]` number i (from 0).
    Joint(usize),
    /// `[[initial]]` number i (from 0).
    Initial(usize),
    /// `[[guide]]` number i (from 0).
    Guide(usize),
    /// `[[coupling]]` number i (from 0).
    Coupling(usize),
    /// `[[rolling]]` number i (from 0).
    Rolling(usize),
    /// `[[signal]]` number i (from 0).
    Signal(usize),
    /// `[[frame]]` number i (from 0).
    Frame(usize),
    /// `[[shape]]` number i (from 0).
    Shape(usize),
    /// `[[effect]]` number i (from 0).
    Effect(usize),
    /// `[[output]]` number i (from 0).
    Output(usize),
    /// Table `[road]` of scene files.
    Road,
    /// Feature number i (from 0) of the road on the left, or of the only road.
    RoadLeft(usize),
    /// Feature number i (from 0) of the road on the right.
    RoadRight(usize),
    /// Table `[solver]` of scene files.
    Solver,
}

/// Error of a scene: a fault, and the key where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneError {
    /// Entry of the scene that has the fault.
    pub entry: Entry,
    /// Key in the entry, as in scene files.
    pub field: &'static str,
    /// Fault of the field.
    pub fault: SceneFault,
}

impl Display for Entry {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene => write!(f, "[scene]"),
            Self::Body(i) => write!(f, "body {}", i + 1),
            Self::Joint(i) => write!(f, "joint {}", i + 1),
            Self::Initial(i) => write!(f, "initial {}", i + 1),
            Self::Guide(i) => write!(f, "guide {}", i + 1),
            Self::Coupling(i) => write!(f, "coupling {}", i + 1),
            Self::Rolling(i) => write!(f, "rolling {}", i + 1),
            Self::Signal(i) => write!(f, "signal {}", i + 1),
            Self::Frame(i) => write!(f, "frame {}", i + 1),
            Self::Shape(i) => write!(f, "shape {}", i + 1),
            Self::Effect(i) => write!(f, "effect {}", i + 1),
            Self::Output(i) => write!(f, "output {}", i + 1),
            Self::Road => write!(f, "[road]"),
            Self::RoadLeft(i) => write!(f, "road feature {}", i + 1),
            Self::RoadRight(i) => write!(f, "road feature {} on the right", i + 1),
            Self::Solver => write!(f, "[solver]"),
        }
    }
}

impl Display for SceneError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` of {} {}", self.field, self.entry, self.fault)
    }
}

impl core::error::Error for SceneError {}
