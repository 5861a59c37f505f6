//! Where a scene is wrong: entry, index and field.

use crate::scene::SceneFault;
use core::fmt::{self, Display, Formatter};

/// An entry of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// `[scene]`.
    Scene,
    /// `[[body]]` number i (from 0).
    Body(usize),
    /// `[[joint]]` number i.
    Joint(usize),
    /// `[[initial]]` number i.
    Initial(usize),
    /// `[[guide]]` number i.
    Guide(usize),
    /// `[[coupling]]` number i.
    Coupling(usize),
    /// `[[rolling]]` number i.
    Rolling(usize),
    /// `[[signal]]` number i.
    Signal(usize),
    /// `[[frame]]` number i.
    Frame(usize),
    /// `[[shape]]` number i.
    Shape(usize),
    /// `[[effect]]` number i.
    Effect(usize),
    /// `[[output]]` number i.
    Output(usize),
    /// `[road]`.
    Road,
    /// Feature number i of the road on the left, or of the only one.
    RoadLeft(usize),
    /// Feature number i of the road on the right.
    RoadRight(usize),
    /// `[solver]`.
    Solver,
}

/// A scene that cannot be meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneError {
    /// Where.
    pub entry: Entry,
    /// The key in the entry, as in scene files.
    pub field: &'static str,
    /// What is wrong.
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
