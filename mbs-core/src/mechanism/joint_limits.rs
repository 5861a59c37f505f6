//! Limits that a joint is meant to keep to, in code, and the stops that keep it there.

use crate::effects::Limit;
use crate::mechanism::Effect;
use crate::scene::{Joint, JointId, Number};
use alloc::string::String;

impl Joint<Number> {
    /// The range that its coordinate is meant to keep to [rad or m], from the reference configuration: data, without effect on the
    /// motion. A run notes where it leaves it; a [`Limit`] pushes back.
    #[must_use]
    pub fn range(mut self, lower: impl Into<Number>, upper: impl Into<Number>) -> Self {
        self.limits.range = Some([lower.into(), upper.into()]);
        self
    }

    /// The largest force or moment that its drive has [N or N m]: data, without effect on the motion.
    #[must_use]
    pub fn effort_limit(mut self, effort: impl Into<Number>) -> Self {
        self.limits.effort = Some(effort.into());
        self
    }

    /// The largest rate that it is meant to have [rad/s or m/s]: data, without effect on the motion. A run notes where it is larger.
    #[must_use]
    pub fn velocity_limit(mut self, velocity: impl Into<Number>) -> Self {
        self.limits.velocity = Some(velocity.into());
        self
    }
}

impl Effect<Number> {
    /// Elastic stops at the ends of a joint's own [range](Joint::range), with a stiffness and a damping that follow from the mass that
    /// the joint moves: they stop it within some 20 ms, and it does not rebound far.
    pub fn stops(joint: JointId) -> Self {
        let [lower, upper, stiffness, damping] = [(); 4].map(|()| Number::open());
        let (coordinate, range) = (None, true);
        let stops = Limit { joint, coordinate, range, lower, upper, stiffness, damping };
        Self { name: String::new(), enabled: true, kind: stops.into() }
    }
}
