//! Policies of Newton's iteration: when a factor serves again, and when what is left is below what the rule itself errs by.

mod factor_reuse;
mod stop;

pub(crate) use factor_reuse::{FactorReuse, residual_with_reused_jacobian};
pub(crate) use stop::StopRule;
