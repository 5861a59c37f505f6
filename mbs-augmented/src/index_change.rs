//! Choice of the index in which a step is made [P2 4, 5].
//!
//! Long steps are made in index-3, short steps in index-1. The index changes from 3 to 1 if the step falls below a threshold, or if several
//! reductions of one step have not helped. It changes back if the step grows beyond twice the threshold. Before each change, velocities,
//! accelerations and multipliers are made consistent at the present positions [P2 (5)].

use crate::options::Options;
use crate::workspace::Workspace;
use crate::{index1, index3};
use mbs_core::model::{Model, State};
use mbs_core::step::{Step, StepError, StepReport};
use mbs_core::{Real, SpdSolver};

/// Index of the equations of motion that a step solves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintIndex {
    /// Index-1, in which accelerations are constrained.
    One,
    /// Index-3, in which positions are constrained.
    Three,
}

/// State of an [`IndexChange`] on which the next step depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexHistory<T> {
    /// Index of the present equations.
    pub index: ConstraintIndex,
    /// Number of changes of index so far.
    pub changes: u32,
    /// Length of the last trial [s].
    pub tried: T,
    /// Length of the last accepted step [s].
    pub last: T,
}

/// Step below which steps are made in index-1 [s]. In shorter steps of index-3, alpha phi is lost to rounding in the sum with the
/// multipliers.
const THRESHOLD: f64 = 1e-4;
/// Multiple of the threshold beyond which steps are made in index-3 again [-]. The factor of two prevents a change of index in every step.
const HYSTERESIS: f64 = 2.0;
/// Number of reductions of one step in a row after which index-1 is tried [-]. With halvings, the step is then a sixteenth of the first
/// trial.
const MAX_REDUCTIONS: u32 = 4;

/// Options of index-1 and index-3, with the rule that changes between the two forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexChange<T> {
    /// Options of steps in index-1.
    pub index1: Options<T>,
    /// Options of steps in index-3.
    pub index3: Options<T>,
    /// Step below which steps are made in index-1 [s].
    pub threshold: T,
    /// Multiple of the threshold beyond which steps are made in index-3 again [-].
    pub hysteresis: T,
    /// Number of reductions of one step in a row after which index-1 is tried at any step (`maxite` in the flowchart of P2).
    pub max_reductions: u32,
    /// Index of the present equations.
    index: ConstraintIndex,
    changes: u32,
    /// Lengths of the last trial and of the last accepted step [s].
    tried: T,
    last: T,
}

impl<T: Real> IndexChange<T> {
    /// Creates the rule, which starts in index-3. The threshold is 1e-4 s, the hysteresis 2, and at most 4 reductions are made.
    #[must_use]
    pub fn new(index1: Options<T>, index3: Options<T>) -> Self {
        Self {
            index1,
            index3,
            threshold: T::from_f64(THRESHOLD),
            hysteresis: T::from_f64(HYSTERESIS),
            max_reductions: MAX_REDUCTIONS,
            index: ConstraintIndex::Three,
            changes: 0,
            tried: T::ZERO,
            last: T::ZERO,
        }
    }

    /// Index of the present equations.
    #[must_use]
    pub fn index(&self) -> ConstraintIndex {
        self.index
    }

    /// The options of the present index.
    pub(crate) fn options(&self) -> &Options<T> {
        match self.index {
            ConstraintIndex::One => &self.index1,
            ConstraintIndex::Three => &self.index3,
        }
    }

    /// Number of changes of index so far.
    #[must_use]
    pub fn changes(&self) -> u32 {
        self.changes
    }

    /// State on which the next step depends.
    #[must_use]
    pub fn history(&self) -> IndexHistory<T> {
        let Self { index, changes, tried, last, .. } = *self;
        IndexHistory { index, changes, tried, last }
    }

    /// Restores the state that a [`history`](Self::history) holds.
    pub fn set_history(&mut self, history: IndexHistory<T>) {
        let IndexHistory { index, changes, tried, last } = history;
        (self.index, self.changes, self.tried, self.last) = (index, changes, tried, last);
    }

    /// Chooses the index for a trial step, after `reductions` of the step in a row. Returns whether the index changed. A change also makes
    /// the state consistent.
    ///
    /// If the state cannot be made consistent, the index does not change and the workspace is restored to its saved state.
    pub fn prepare<M: Model<T>, S: SpdSolver<T>>(
        &mut self,
        model: &M,
        step: Step<T>,
        reductions: u32,
        s: &mut State<T>,
        w: &mut Workspace<T, S>,
    ) -> bool {
        let Step { dt: h, length } = step;
        let is_grown = reductions == 0 && h > self.last;
        let target = match self.index {
            ConstraintIndex::Three if h < self.threshold || reductions >= self.max_reductions => {
                ConstraintIndex::One
            }
            ConstraintIndex::One if is_grown && h > self.threshold * self.hysteresis => {
                ConstraintIndex::Three
            }
            same => same,
        };
        if target == self.index {
            return false;
        }
        if index1::settle(model, length, &self.index1, s, w).is_err() {
            w.restore();
            return false;
        }
        self.index = target;
        self.changes += 1;
        true
    }

    /// Records that a trial step of length `h` [s] has ended.
    pub fn tried(&mut self, h: T) {
        self.tried = h;
    }

    /// Accepts the last trial step. A later trial that is longer than this step counts as grown.
    pub fn accept(&mut self) {
        self.last = self.tried;
    }

    /// Makes one step in the present index.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn step<M: Model<T>, S: SpdSolver<T>>(
        &self,
        model: &M,
        step: Step<T>,
        s: &mut State<T>,
        w: &mut Workspace<T, S>,
    ) -> Result<StepReport<T>, StepError> {
        match self.index {
            ConstraintIndex::One => index1::step(model, step, &self.index1, s, w),
            ConstraintIndex::Three => index3::step(model, step, &self.index3, s, w),
        }
    }
}
