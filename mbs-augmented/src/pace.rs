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

use crate::options::{Options, Penalty, Projection};
use crate::workspace::Workspace;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::{Real, SpdSolver};

/// A factor is kept while corrections shrink to this share or less, where a share of the first may be left: a new one costs two
/// iterations.
const REUSE: f64 = 0.2;
/// The same where the tolerance alone ends the iteration: a new factor takes in nearly all of what constraints alone leave.
const FAST: f64 = 1e-3;
/// The next correction is taken to be no less than this share of the last, however much that shrank.
const SLOWEST: f64 = 0.1;

/// What is known of the iteration of a step.
#[derive(Debug)]
pub(crate) struct Pace<T> {
    /// Do multipliers grow by what a correction is in balance with, and not as printed?
    pub(crate) is_balanced: bool,
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
    /// The tolerance alone ends the iteration where constraints act alone: first corrections go mostly across the motion there, so that
    /// shares of them tell nothing of the error along it. So it does with a fixed alpha and with printed projections, which take the tangent as
    /// the iteration leaves it; multipliers then grow as printed.
    pub(crate) fn new<M: Model<T>>(model: &M, options: &Options<T>) -> Self {
        let is_balanced = matches!(options.penalty, Penalty::Scaled(_))
            && options.projection == Projection::Correction;
        let share = if is_balanced && model.has_forces() { options.share } else { T::ZERO };
        Self { is_balanced, share, first: T::ZERO, corrections: [T::ZERO; 2], since: T::ZERO }
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
        if before == T::ZERO {
            return self.is_balanced && w.has_like_laws(rule);
        }
        let most = T::from_f64(if self.share > T::ZERO { REUSE } else { FAST });
        last <= before * most && (!self.is_balanced || w.has_like_laws(rule))
    }
}
