//! Stop of the iteration where the remaining correction is small relative to the truncation error of the rule.
//!
//! ```text
//! first correction = (h^2/4) (a_(n+1) - a_n), three times the local error of the trapezoidal rule
//! ```

use crate::options::Options;
use mbs_core::Real;
use mbs_core::implicit::Newton;
use mbs_core::model::Model;

/// Smallest contraction that is assumed for the next correction, even if the last one shrank more [-]. With a reused factor a correction
/// leaves a tenth of the error.
const MIN_CONTRACTION: f64 = 0.1;

/// Rule that ends an iteration below the truncation error.
#[derive(Debug)]
pub(crate) struct StopRule<T> {
    /// Fraction of the first correction that may remain [-]. Zero where the tolerance alone ends the iteration.
    truncation_share: T,
}

impl<T: Real> StopRule<T> {
    /// Creates the rule for a step. The tolerance alone ends the iteration where only constraints act. There, first corrections are mainly
    /// across the motion, so that a ratio to them does not describe the error along the motion. The tolerance alone also ends it with a
    /// fixed alpha, where multipliers grow as published.
    pub(crate) fn new<M: Model<T>>(model: &M, options: &Options<T>, is_balanced: bool) -> Self {
        let is_on = is_balanced && model.has_forces();
        Self { truncation_share: if is_on { options.truncation_share } else { T::ZERO } }
    }

    /// True if the tolerance alone ends the iteration.
    pub(crate) fn is_tolerance_alone(&self) -> bool {
        !(self.truncation_share > T::ZERO)
    }

    /// True if the predicted next correction is below the allowed fraction of the first one.
    pub(crate) fn is_below_truncation(&self, newton: &Newton<T>) -> bool {
        let [before, last] = newton.corrections;
        let contraction = (last / before).max(T::from_f64(MIN_CONTRACTION));
        before > T::ZERO && last * contraction <= newton.first * self.truncation_share
    }
}
