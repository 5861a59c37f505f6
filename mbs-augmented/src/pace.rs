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
/// The same where constraints act alone, which a new factor takes in all, where the tolerance alone ends the iteration, and with a fixed
/// alpha, of which it is not known what it is in effective masses.
const FAST: f64 = 1e-3;
/// The next correction is taken to be no less than this share of the last, however much that shrank.
const SLOWEST: f64 = 0.1;

/// What is known of the iteration of a step.
#[derive(Debug)]
pub(crate) struct Pace<T> {
    /// The scene's length [m].
    length: T,
    /// The first correction, and the last two with the violations that they left [m].
    first: T,
    corrections: [T; 2],
    violations: [T; 2],
    /// Sum of the corrections since the matrix was factored [m].
    pub(crate) since: T,
}

impl<T: Real> Pace<T> {
    /// Before the first correction, in a scene of the given length [m].
    pub(crate) fn new(length: T) -> Self {
        Self {
            length,
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

    /// Is what a correction leaves below the share of the first one that the options allow?
    pub(crate) fn is_enough(&self, correction: T, options: &Options<T>) -> bool {
        let last = self.last();
        let shrinking = (correction / last).max(T::from_f64(SLOWEST));
        last > T::ZERO && correction * shrinking <= self.first * options.share
    }

    /// May the next correction be made with the factor there is?
    ///
    /// Its rows are off by the turn since. Of s phi, which the multipliers carry along, that turn stands along free directions, where
    /// only the mass is in its way: it must be small beside the correction. And laws must be like those that were factored.
    pub(crate) fn keeps_factor<M: Model<T>, S: SpdSolver<T>>(
        &self,
        model: &M,
        rule: &Rule<T>,
        options: &Options<T>,
        w: &Workspace<T, S>,
    ) -> bool {
        let ([before, last], [phi_before, phi]) = (self.corrections, self.violations);
        if before == T::ZERO {
            return false;
        }
        let is_exact = matches!(options.penalty, Penalty::Fixed(_)) || !(options.share > T::ZERO);
        if is_exact || !model.has_forces() {
            return last <= before * T::from_f64(FAST);
        }
        let astray = w.base * w.boost * phi.max(phi_before) * self.since / self.length;
        last <= before * T::from_f64(REUSE)
            && astray <= last * T::from_f64(REUSE)
            && w.has_like_laws(rule)
    }
}
