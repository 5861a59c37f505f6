//! A given torque, or force, between the bodies of a joint: power tau(t) m'.

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// A signal's first component, with the sign of growth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TorqueLaw {
    /// Number of the signal among those of the model.
    pub course: u32,
}

entry!(TorqueLaw { course });

impl<T: Real> TensionLaw<T> for TorqueLaw {
    #[inline]
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
        ScalarForce {
            value,
            rate,
            tension: -law_inputs.course(self.course)[0],
            ..ScalarForce::default()
        }
    }

    fn operations(&self) -> Operations {
        Operations::NONE
    }

    fn fits(&self, _: &LawInputs<'_, T>, n_courses: usize) -> bool {
        (self.course as usize) < n_courses
    }
}

#[cfg(feature = "alloc")]
pub use data::JointTorque;

#[cfg(feature = "alloc")]
mod data {
    use super::TorqueLaw;
    use crate::effects::data::*;

    effect! {
        /// A torque of the first body on the second about the joint's axis (first component); a force along a slide.
        pub struct JointTorque<T> = ["torque"] {
            /// The joint.
            joint: JointId = Joint(Rotation), "", Needed;
            /// Its coordinate; needed where it has several rotations.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// Torque, or force.
            course as "value": Signal<T> = Signal(Scalar), "N m or N", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for JointTorque<T> {
        const LAW: &'static str = "of the first body on the second";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let course = to.course(&self.course);
            to.on_joint((self.joint, self.coordinate), TorqueLaw { course });
        }
    }
}
