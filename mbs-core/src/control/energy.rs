//! The step from the change of the energy invariant [P2 (32), (33)].
//!
//! ```text
//! e = |Pi_(n+1) - Pi_n| / E,   E the energy that moves
//! h <- eta h,   eta = (safety U / e)^(1/r)         where e > U: the step is rejected
//!               eta = (sqrt(U L) / e)^(1/r)        where it is kept: the change stays between L and U
//! ```
//!
//! Differs from the source: e is relative to the energy that moves, not to the total with its arbitrary zero. The h of (33) is
//! left out, since U and L are compared with the change in one step. A step that is kept follows the rule too, where the source
//! changes the step only at the limits. A step that changes at the limits only is shortened late and enlarged late, and the errors
//! of a swing forth and back do not cancel. At the same cost the error of the invariant is then twice (a suspension) to eight times
//! (a double pendulum) as large. The published form is an option. Since e passes through zero between gain and loss, larger changes
//! are remembered for a few steps.

/// The rule with its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyRule {
    /// Upper limit U of the change: a larger one rejects the step [-].
    pub upper: f64,
    /// Lower limit L of the change: it is kept above it, up to the largest step [-].
    pub lower: f64,
    /// Share of U that the repeated step aims at [-].
    pub safety: f64,
    /// 1/r, from 1/4 to 1/2 [-].
    pub exponent: f64,
    /// Whether the rule is as printed: between L and U the step stays as it is.
    pub is_printed: bool,
}

/// Bounds of the factor on a rejected step [-]: its repetition is shorter by a fifth at least, to a fifth at most. Chosen, not tuned.
const REJECTED: [f64; 2] = [0.2, 0.8];
/// Bounds of the factor after small changes in the published form [-]: the step at most doubles. Chosen, not tuned.
const ENLARGED: [f64; 2] = [1.0, 2.0];
/// Bounds of the factor on a step that is kept [-]: narrow, since one small change may be a passage through zero. Chosen, not tuned.
const STEERED: [f64; 2] = [0.5, 1.2];
/// Factor by which a remembered change fades in a step [-]: half of it is left after four steps, in which e may pass through zero.
const MEMORY: f64 = 0.85;
/// Small changes in a row after which the step grows in the published form [-]: one alone may be a passage through zero.
const SMALL_CHANGES: u32 = 2;

impl Default for EnergyRule {
    /// U = 1e-5, L = 1e-7, safety 0.8, exponent 1/3: the change in a step goes with its cube.
    fn default() -> Self {
        Self { upper: 1e-5, lower: 1e-7, safety: 0.8, exponent: 1.0 / 3.0, is_printed: false }
    }
}

impl EnergyRule {
    /// The rule with other limits.
    #[must_use]
    pub fn new([upper, lower]: [f64; 2]) -> Self {
        Self { upper, lower, ..Self::default() }
    }

    /// The rule as printed.
    #[must_use]
    pub fn printed(limits: [f64; 2]) -> Self {
        Self { is_printed: true, ..Self::new(limits) }
    }
}

/// The rule with what it remembers from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steering {
    rule: EnergyRule,
    /// The last changes, faded, as they would be in the next step [-].
    memory: f64,
    /// Changes below L in a row.
    small: u32,
}

impl Steering {
    /// Nothing is remembered yet.
    pub fn new(rule: EnergyRule) -> Self {
        Self { rule, memory: 0.0, small: 0 }
    }

    /// The factor for the next step where a change `e` is kept; `Err` with the factor for the repeated one where it is not. A
    /// NaN is not.
    ///
    /// Cost: two powers.
    ///
    /// # Errors
    /// The factor for the repeated step where the change is not kept.
    pub fn judge(&mut self, e: f64) -> Result<f64, f64> {
        let EnergyRule { upper, lower, safety, exponent, is_printed } = self.rule;
        if !(e <= upper) {
            self.forget();
            let wish = libm::pow(safety * upper / e, exponent);
            return Err(within(REJECTED, wish));
        }
        if is_printed {
            self.small = if e < lower { self.small + 1 } else { 0 };
            let wish = libm::pow(safety * upper / e, exponent);
            return Ok(if self.small >= SMALL_CHANGES { within(ENLARGED, wish) } else { 1.0 });
        }
        let remembered = e.max(MEMORY * self.memory).max(f64::MIN_POSITIVE);
        let factor = within(STEERED, libm::pow(libm::sqrt(upper * lower) / remembered, exponent));
        // A shorter step makes it smaller; a longer one not larger, so that it fades.
        self.memory = remembered * libm::pow(factor.min(1.0), 1.0 / exponent);
        Ok(factor)
    }

    /// The changes and the count that are remembered.
    pub(super) fn history(&self) -> (f64, u32) {
        (self.memory, self.small)
    }

    /// Restores the rule's memory from a [`history`](Self::history).
    pub(super) fn set_history(&mut self, (memory, small): (f64, u32)) {
        (self.memory, self.small) = (memory, small);
    }

    /// After a step that failed.
    pub(super) fn forget(&mut self) {
        (self.memory, self.small) = (0.0, 0);
    }
}

/// The nearest number within bounds; the lower one for a NaN.
fn within([lower, upper]: [f64; 2], x: f64) -> f64 {
    if x > lower { x.min(upper) } else { lower }
}
