//! When what is left of a correction is small beside what the rule itself errs by.
//!
//! ```text
//! first correction = (h^2/4) (a_(n+1) - a_n), three times the local error of the trapezoidal rule
//! ```

use crate::options::Options;
use mbs_core::Real;
use mbs_core::implicit::Newton;
use mbs_core::model::Model;

/// Least contraction of the next correction that is counted on, however much the last one shrank [-]: a kept factor leaves a tenth.
const MIN_CONTRACTION: f64 = 0.1;

/// Ends an iteration below the truncation error.
#[derive(Debug)]
pub(crate) struct StopRule<T> {
    /// Share of the first correction that may be left [-]; zero where the tolerance alone ends the iteration.
    truncation_share: T,
}

impl<T: Real> StopRule<T> {
    /// The tolerance alone ends the iteration where constraints act alone: first corrections go mostly across the motion there, so that
    /// ratios to them say nothing of the error along it. So it does where multipliers grow as published, with a fixed alpha.
    pub(crate) fn new<M: Model<T>>(model: &M, options: &Options<T>, is_balanced: bool) -> Self {
        let is_on = is_balanced && model.has_forces();
        Self { truncation_share: if is_on { options.truncation_share } else { T::ZERO } }
    }

    /// Does the tolerance alone end the iteration?
    pub(crate) fn is_tolerance_alone(&self) -> bool {
        !(self.truncation_share > T::ZERO)
    }

    /// Is what the last correction leaves below the part of the first one that may be left?
    pub(crate) fn is_below_truncation(&self, newton: &Newton<T>) -> bool {
        let [before, last] = newton.corrections;
        let contraction = (last / before).max(T::from_f64(MIN_CONTRACTION));
        before > T::ZERO && last * contraction <= newton.first * self.truncation_share
    }
}
