//! What was measured of one scene.

use super::parts::{Part, Shares};
use serde_json::Value;

/// One scene.
#[derive(Debug)]
pub(crate) struct Profile {
    /// What `bench profile told` says.
    pub(crate) told: Value,
    /// Instructions of all its steps.
    pub(crate) shares: Shares,
}

impl Profile {
    pub(crate) fn name(&self) -> &str {
        self.told["scene"].as_str().unwrap_or_default()
    }

    /// A number of the line; not a number where there is none.
    pub(crate) fn number(&self, key: &str) -> f64 {
        self.told[key].as_f64().unwrap_or(f64::NAN)
    }

    /// A count of work in a step.
    pub(crate) fn work(&self, key: &str) -> f64 {
        self.told["work"][key].as_f64().unwrap_or(f64::NAN)
    }

    /// How many steps were looked at.
    pub(crate) fn steps(&self) -> f64 {
        self.number("to") - self.number("from")
    }

    /// Instructions of a part in a step.
    pub(crate) fn instructions(&self, part: Part) -> f64 {
        self.each(self.shares.parts.get(&part).copied().unwrap_or(0))
    }

    /// Of a step.
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub(crate) fn each(&self, instructions: u64) -> f64 {
        instructions as f64 / self.steps()
    }
}
