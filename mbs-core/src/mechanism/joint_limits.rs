//! Intended limits of joints in code, and the stops that enforce them.

use crate::effects::Limit;
use crate::mechanism::Effect;
use crate::scene::{Joint, JointId, Number};
use alloc::string::String;

impl Joint<Number> {
    /// Sets the intended range of the coordinate [rad or m], relative to the reference configuration. The range has no effect on the
    /// motion. A run notes where the coordinate leaves it; a [`Limit`] enforces it.
    #[must_use]
    pub fn range(mut self, lower: impl Into<Number>, upper: impl Into<Number>) -> Self {
        self.limits.range = Some([lower.into(), upper.into()]);
        self
    }

    /// Sets the largest force or moment of the joint's drive [N or N m]. It has no effect on the motion.
    #[must_use]
    pub fn effort_limit(mut self, effort: impl Into<Number>) -> Self {
        self.limits.effort = Some(effort.into());
        self
    }

    /// Sets the largest intended rate of the coordinate [rad/s or m/s]. It has no effect on the motion. A run notes where the rate is
    /// larger.
    #[must_use]
    pub fn velocity_limit(mut self, velocity: impl Into<Number>) -> Self {
        self.limits.velocity = Some(velocity.into());
        self
    }
}

impl Effect<Number> {
    /// Elastic stops at the ends of a joint's own [range](Joint::range). Stiffness and damping follow from the mass that the joint moves.
    /// They stop it within about 20 ms, with little rebound.
    pub fn stops(joint: JointId) -> Self {
        let [lower, upper, stiffness, damping] = [(); 4].map(|()| Number::open());
        let (coordinate, range) = (None, true);
        let stops = Limit { joint, coordinate, range, lower, upper, stiffness, damping };
        Self { name: String::new(), enabled: true, kind: stops.into() }
    }
}
