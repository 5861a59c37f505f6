//! How the iteration of a step goes: when a factor serves again, and when what is left is small beside what the rule itself errs by.
//!
//! ```text
//! first correction = (h^2/4) (a_(n+1) - a_n), three times the local error of the trapezoidal rule
//! kept factor:   T' d = -(M a + J^T lambda - Q) / a' - J'^T s phi,     T' = M + J'^T s J' + ...
//! ```
//!
//! With a symmetric tangent corrections of a vehicle shrink to a tenth or less each, with a new factor or with the first: a tire's
//! side force turns with its wheel, and nothing of that is symmetric. That a factor serves on takes two things. s phi goes by the rows
//! of the factor, which answer it with a correction across the motion alone. And multipliers grow by s (phi + J' d), which is what the
//! correction is in balance with, and not by s phi after it [P3 (2)]: that has the square of the correction in it, which the next
//! correction would have to take back while s phi asks for it once more, and once the rows have turned it acts along the motion.

use crate::options::{Options, Penalty};
use crate::workspace::Workspace;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::{Real, SpdSolver};

/// Where effects act, a factor is kept while corrections shrink to this share or less: a new one costs two iterations.
const REUSE: f64 = 0.2;
/// The same where the tolerance alone ends the iteration.
const FAST: f64 = 1e-3;
/// The next correction is taken to be no less than this share of the last, however much that shrank.
const SLOWEST: f64 = 0.1;

/// What is known of the iteration of a step.
#[derive(Debug)]
pub(crate) struct Pace<T> {
    /// What may be left of the first correction [-]; zero where the tolerance alone ends the iteration.
    share: T,
    /// The first correction, and the last two [m].
    first: T,
    corrections: [T; 2],
    /// Sum of the corrections since the matrix was factored [m].
    pub(crate) since: T,
}

impl<T: Real> Pace<T> {
    /// Before the first correction.
    ///
    /// The tolerance alone ends the iteration where constraints act alone: a new factor takes in all of them, and first corrections go
    /// mostly across the motion, so that shares of them tell nothing of the error along it. So it does with a fixed alpha, of which it
    /// is not known what it is in effective masses.
    pub(crate) fn new<M: Model<T>>(model: &M, options: &Options<T>) -> Self {
        let is_scaled = matches!(options.penalty, Penalty::Scaled(_));
        let share = if is_scaled && model.has_forces() { options.share } else { T::ZERO };
        Self { share, first: T::ZERO, corrections: [T::ZERO; 2], since: T::ZERO }
    }

    /// The last correction [m].
    pub(crate) fn last(&self) -> T {
        self.corrections[1]
    }

    /// After a correction.
    pub(crate) fn note(&mut self, correction: T) {
        if self.last() == T::ZERO {
            self.first = correction;
        }
        self.corrections = [self.last(), correction];
    }

    /// Is what a correction leaves below the share of the first one that may be left?
    pub(crate) fn is_enough(&self, correction: T) -> bool {
        let last = self.last();
        let shrinking = (correction / last).max(T::from_f64(SLOWEST));
        last > T::ZERO && correction * shrinking <= self.first * self.share
    }

    /// Is there a share of the first correction that may be left? A kept factor then has a residual with its own rows.
    pub(crate) fn has_share(&self) -> bool {
        self.share > T::ZERO
    }

    /// May the next correction be made with the factor there is? It is one of the matrix as it was while laws are like those that were
    /// factored; rows that have turned since cost little, for its residual takes s phi by the rows that it was made with.
    pub(crate) fn keeps_factor<S>(&self, rule: &Rule<T>, w: &Workspace<T, S>) -> bool
    where
        S: SpdSolver<T>,
    {
        let [before, last] = self.corrections;
        if last == T::ZERO {
            return false;
        }
        let (is_first, shrinking) = (before == T::ZERO, last / before);
        if self.has_share() {
            (is_first || shrinking <= T::from_f64(REUSE)) && w.has_like_laws(rule)
        } else {
            !is_first && shrinking <= T::from_f64(FAST)
        }
    }
}
