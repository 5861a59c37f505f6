//! How the iteration of a step goes: when a factor serves again, and when what is left is small beside what the rule itself errs by.
//!
//! ```text
//! first correction = (h^2/4) (a_(n+1) - a_n), three times the local error of the trapezoidal rule
//! kept factor:   T' d = -(M a + J^T lambda - Q) / a' - J'^T s phi,     T' = M + J'^T s J' + ...
//! ```
//!
//! With a symmetric tangent corrections of a vehicle shrink to a tenth or less each, with a new factor or with the last: a tire's
//! side force turns with its wheel, and nothing of that is symmetric.

use crate::options::{Options, Penalty};
use crate::workspace::Workspace;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::{Real, SpdSolver};

/// Where effects act, a factor made after the first correction is kept while corrections shrink to this share or less: a new one costs
/// two iterations.
const REUSE: f64 = 0.2;
/// The same where the tolerance alone ends the iteration.
const FAST: f64 = 1e-3;
/// The next correction is taken to be no less than this share of the last, however much that shrank.
const SLOWEST: f64 = 0.1;

/// What is known of the iteration of a step.
#[derive(Debug)]
pub(crate) struct Pace<T> {
    /// The scene's length [m].
    length: T,
    /// What may be left of the first correction [-]; zero where the tolerance alone ends the iteration.
    share: T,
    /// The first correction, and the last two with the violations that they left [m].
    first: T,
    corrections: [T; 2],
    violations: [T; 2],
    /// Sum of the corrections since the matrix was factored [m].
    pub(crate) since: T,
}

impl<T: Real> Pace<T> {
    /// Before the first correction, in a scene of the given length [m].
    ///
    /// The tolerance alone ends the iteration where constraints act alone: a new factor takes in all of them, and first corrections go
    /// mostly across the motion, so that shares of them tell nothing of the error along it. So it does with a fixed alpha, of which it
    /// is not known what it is in effective masses.
    pub(crate) fn new<M: Model<T>>(model: &M, options: &Options<T>, length: T) -> Self {
        let is_scaled = matches!(options.penalty, Penalty::Scaled(_));
        let share = if is_scaled && model.has_forces() { options.share } else { T::ZERO };
        Self {
            length,
            share,
            first: T::ZERO,
            corrections: [T::ZERO; 2],
            violations: [T::ZERO; 2],
            since: T::ZERO,
        }
    }

    /// The last correction [m].
    pub(crate) fn last(&self) -> T {
        self.corrections[1]
    }

    /// After a correction and the largest violation that it left.
    pub(crate) fn note(&mut self, correction: T, violation: T) {
        if self.last() == T::ZERO {
            self.first = correction;
        }
        self.corrections = [self.last(), correction];
        self.violations = [self.violations[1], violation];
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

    /// May the next correction be made with the factor there is?
    ///
    /// Its rows are off by the turn since. Of s phi, which the multipliers carry along, that turn stands along free directions, where
    /// only the mass is in its way: it must be small beside the correction. And laws must be like those that were factored.
    pub(crate) fn keeps_factor<S>(&self, rule: &Rule<T>, w: &Workspace<T, S>) -> bool
    where
        S: SpdSolver<T>,
    {
        let ([before, last], [phi_before, phi]) = (self.corrections, self.violations);
        if before == T::ZERO {
            return false;
        }
        if !self.has_share() {
            return last <= before * T::from_f64(FAST);
        }
        let astray = w.base * w.boost * phi.max(phi_before) * self.since / self.length;
        last <= before * T::from_f64(REUSE)
            && astray <= last * T::from_f64(REUSE)
            && w.has_like_laws(rule)
    }
}
