//! The runs that are made: scenes, steps, penalties and ways.

use super::run::Run;

pub(super) const SCENES: [Scene; 2] = [
    Scene { file: "double-pendulum", what: "Double pendulum: smooth motion" },
    Scene { file: "two-four-bars", what: "Two four-bars: through a singular position" },
];

/// The report's fixed alpha; as it raises that where it does not converge, to 1e9 at 1e-4 s and 1e11 at 1e-5 s; and raised so
/// fast that multipliers from zero converge at the singular position.
pub(super) const LADDERS: [Ladder; 3] = [
    Ladder { name: "1e7", exponent: |_| 7 },
    Ladder { name: "10/dt², 1e7 at least", exponent: |k| (2 * k + 1).max(7) },
    Ladder { name: "10/dt⁴", exponent: |k| 4 * k + 1 },
];

/// The printed form with 16 digits, with 32, and with the factor of the one and the residuals of the other; then ours.
pub(super) const WAYS: [Way; 6] = [
    Way { name: "printed, f64", form: "printed", digits: "f64" },
    Way { name: "printed, once", form: "printed", digits: "once" },
    Way { name: "printed, refined", form: "printed", digits: "refined" },
    Way { name: "printed, dd", form: "printed", digits: "dd" },
    Way { name: "correction, f64", form: "correction", digits: "f64" },
    DEFAULT,
];

pub(super) const PRINTED: usize = 0;

pub(super) const REFINED: usize = 2;

pub(super) const PAIRS: usize = 3;

pub(super) const CORRECTION: usize = 4;

/// Our default needs no alpha; it is run once for each step.
pub(super) const DEFAULT: Way = Way { name: "default, f64", form: "default", digits: "f64" };

pub(super) const OURS: usize = 5;

/// A scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Scene {
    pub(super) file: &'static str,
    pub(super) what: &'static str,
}

/// How the penalty is chosen for a step of 10^-k s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ladder {
    pub(super) name: &'static str,
    /// The exponent of alpha.
    pub(super) exponent: fn(i32) -> i32,
}

/// How a run is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Way {
    pub(super) name: &'static str,
    pub(super) form: &'static str,
    pub(super) digits: &'static str,
}

/// A step with one penalty, in every way, in the order of [`WAYS`].
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub(super) scene: Scene,
    /// The step is 10^-k s, alpha 10^exponent.
    pub(super) k: i32,
    pub(super) exponent: i32,
    pub(super) runs: Vec<Run>,
}

impl Cell {
    pub(super) fn step(&self) -> f64 {
        10_f64.powi(-self.k)
    }

    /// Is its penalty the one that this ladder chooses for its step?
    pub(super) fn is_on(&self, ladder: &Ladder) -> bool {
        (ladder.exponent)(self.k) == self.exponent
    }
}
