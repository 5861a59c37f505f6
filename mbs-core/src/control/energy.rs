//! Step size from the change of the energy invariant [P2 (32), (33)].
//!
//! ```text
//! e = |Pi_(n+1) - Pi_n| / E,   Pi: energy invariant, n: step, E: energy that moves
//! h <- eta h,   eta = (safety U / e)^(1/r)         if e > U: the step is rejected
//!               eta = (sqrt(U L) / e)^(1/r)        otherwise: the step is accepted, and the next change is between L and U
//! ```
//!
//! h is the step length; the change in a step is proportional to h^r. Differences from the source: e is relative to the moving energy, not
//! to the total energy with its arbitrary zero. The factor h of (33) is left out, since U and L are compared with the change in one step.
//! An accepted step follows the rule too, whereas the source changes the step only at the limits. With changes only at the limits the step
//! is shortened late and enlarged late. The errors of a swing forth and back then do not cancel. At the same cost the error of the
//! invariant is two times (a suspension) to eight times (a double pendulum) larger. The published form is an option. e passes through zero
//! between gain and loss, so larger changes are remembered for a few steps.

/// Energy rule with its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyRule {
    /// Upper limit U of the change [-]. A larger change rejects the step.
    pub upper: f64,
    /// Lower limit L of the change [-]. The step grows while the change is below it, up to the largest step.
    pub lower: f64,
    /// Fraction of U at which a repeated step aims [-].
    pub safety: f64,
    /// Exponent 1/r of the rule, from 1/4 to 1/2 [-].
    pub exponent: f64,
    /// Whether the rule has the published form: a change between L and U leaves the step unchanged.
    pub is_printed: bool,
}

/// Bounds of the factor on a rejected step [-]. Its repetition has between a fifth and four fifths of its length. Chosen, not tuned.
const REJECTED: [f64; 2] = [0.2, 0.8];
/// Bounds of the factor after small changes in the published form [-]. The step at most doubles. Chosen, not tuned.
const ENLARGED: [f64; 2] = [1.0, 2.0];
/// Bounds of the factor on an accepted step [-]. They are narrow, since one small change may be a passage of e through zero. Chosen, not
/// tuned.
const STEERED: [f64; 2] = [0.5, 1.2];
/// Factor by which a remembered change fades in a step [-]. About half of it remains after four steps, in which e may pass through zero.
const MEMORY: f64 = 0.85;
/// Number of consecutive small changes after which the step grows in the published form [-]. A single one may be a passage of e through
/// zero.
const SMALL_CHANGES: u32 = 2;

impl Default for EnergyRule {
    /// Rule with U = 1e-5, L = 1e-7, safety 0.8 and exponent 1/3, since the change in a step is proportional to h^3.
    fn default() -> Self {
        Self { upper: 1e-5, lower: 1e-7, safety: 0.8, exponent: 1.0 / 3.0, is_printed: false }
    }
}

impl EnergyRule {
    /// Rule with the given limits U and L.
    #[must_use]
    pub fn new([upper, lower]: [f64; 2]) -> Self {
        Self { upper, lower, ..Self::default() }
    }

    /// Rule in the published form with the given limits U and L.
    #[must_use]
    pub fn printed(limits: [f64; 2]) -> Self {
        Self { is_printed: true, ..Self::new(limits) }
    }
}

/// Energy rule with its memory from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steering {
    rule: EnergyRule,
    /// Largest recent change [-]. It fades from step to step and is scaled to the length of the next step.
    memory: f64,
    /// Number of consecutive changes below L.
    small: u32,
}

impl Steering {
    /// Rule with an empty memory.
    pub fn new(rule: EnergyRule) -> Self {
        Self { rule, memory: 0.0, small: 0 }
    }

    /// Decides on a relative change `e`. Returns the factor for the next step if the change is accepted. A NaN is rejected.
    ///
    /// Cost: up to two powers.
    ///
    /// # Errors
    /// The factor for the repeated step if the change is rejected.
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
        // A shorter step reduces the change to be expected. A longer step does not increase it here, so that the memory fades.
        self.memory = remembered * libm::pow(factor.min(1.0), 1.0 / exponent);
        Ok(factor)
    }

    /// Memory of the rule: the faded change and the count of small changes.
    pub(super) fn history(&self) -> (f64, u32) {
        (self.memory, self.small)
    }

    /// Restores the memory of the rule from a [`history`](Self::history).
    pub(super) fn set_history(&mut self, (memory, small): (f64, u32)) {
        (self.memory, self.small) = (memory, small);
    }

    /// Clears the memory after a failed step.
    pub(super) fn forget(&mut self) {
        (self.memory, self.small) = (0.0, 0);
    }
}

/// Nearest number within bounds; the lower bound for a NaN.
fn within([lower, upper]: [f64; 2], x: f64) -> f64 {
    if x > lower { x.min(upper) } else { lower }
}
