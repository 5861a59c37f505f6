//! Drive that holds a speed: proportional control with a limited force.
//!
//! ```text
//! F = L s(g (v0 - v) / L),   s(x) = x / sqrt(1 + x^2)
//! ```
//!
//! F is the force, g the gain, v0 the speed to hold, v the speed and L the largest force. The saturation s is smooth, so that the
//! force has a derivative everywhere. Below a third of the limit, the force differs from g (v0 - v) by at most 5 %.

use crate::Real;
use crate::algebra::Vector;
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, UnitWrench, WrenchesLaw, put};
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::ScalarForce;

/// Law of a drive that holds a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedHoldLaw<T> {
    /// Speed to hold [m/s].
    pub speed: T,
    /// Gain: force per difference of speed [N s/m].
    pub gain: T,
    /// Largest force [N].
    pub limit: T,
}

entry!(SpeedHoldLaw<T> { speed, gain, limit });

impl<T: Real> SpeedHoldLaw<T> {
    /// Force along the direction at a speed, and minus its derivative by the speed.
    #[inline]
    pub fn force(&self, speed: T) -> (T, T) {
        let x = self.gain * (self.speed - speed) / self.limit;
        let root = (T::ONE + x * x).sqrt();
        (self.limit * x / root, self.gain / (root * root * root))
    }
}

impl<T: Real> WrenchesLaw<T> for SpeedHoldLaw<T> {
    /// Writes the force on a body along the law's direction.
    fn evaluate(&self, motion: &BodyMotion<T>, _: &LawInputs<'_, T>, out: &mut [UnitWrench<T>]) {
        let axis = Vector::<T, 3>::from(motion.axis);
        let rate = axis.dot(&Vector::from(motion.velocity));
        let (force, damping) = self.force(rate);
        let measure = ScalarForce { rate, tension: -force, damping, ..ScalarForce::default() };
        put(out, 0, UnitWrench { force: motion.axis, moment: [T::ZERO; 3], measure });
    }

    fn operations(&self, _: &LawInputs<'_, T>) -> Operations {
        Operations::new(9, 5).and(3, 1, 0)
    }
}

#[cfg(feature = "alloc")]
pub use data::SpeedHold;

#[cfg(feature = "alloc")]
mod data {
    use super::SpeedHoldLaw;
    use crate::effects::data::*;

    effect! {
        /// A force at the centre of mass along a direction of the body that holds its speed.
        pub struct SpeedHold<T> = ["speed-hold"] {
            /// The body.
            body: BodyId = Body, "", Needed;
            /// Direction, fixed in the body.
            direction: [T; 3] = Axis, "", Needed;
            /// Speed to hold.
            speed: T = Number(Any), "m/s", Needed;
            /// Force per speed.
            gain: T = Number(NotNegative), "N s/m", Needed;
            /// Largest force.
            limit: T = Number(Positive), "N", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for SpeedHold<T> {
        const LAW: &'static str = "along the direction at the centre of mass: x/√(1 + (x/limit)²), x = gain (speed - v); within 5 % of the gain below a third of the limit";

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self { body, direction, speed, gain, limit } = self;
            let Some(index) = body.index() else { return };
            let at = to.among.bodies[index].mass_properties().1.into();
            let axis = crate::effects::action::direction_of(direction);
            to.on_body((body, at), axis, SpeedHoldLaw { speed, gain, limit });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
            leave("drive");
            false
        }
    }
}
