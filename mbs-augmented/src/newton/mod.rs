//! Policies of Newton's iteration: when a factor is reused, and when the remaining correction is below the truncation error.

mod factor_reuse;
mod stop;

pub(crate) use factor_reuse::{FactorReuse, residual_with_reused_jacobian};
pub(crate) use stop::StopRule;
