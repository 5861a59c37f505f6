//! A given torque, or force, between the bodies of a joint: power tau(t) m'.

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// Bit that is set in the number of a signal whose second and third component are slopes [-]. No number of a signal uses this bit.
const RESISTS: u32 = 1 << 31;

/// Torque or force given by the first component of a signal, positive in the sense of growth. If the signal depends on the motion,
/// its second and third component are minus the derivatives of the force by coordinate and rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TorqueLaw {
    /// Number of the signal in the model. A bit is set if the signal depends on the motion.
    pub course: u32,
}

impl TorqueLaw {
    /// By a course of this number.
    #[must_use]
    pub const fn new(course: u32) -> Self {
        Self { course }
    }

    /// By a course that follows the motion: its second and third component are the slopes of the force.
    #[must_use]
    pub const fn following(course: u32) -> Self {
        Self { course: course | RESISTS }
    }

    const fn number(self) -> u32 {
        self.course & !RESISTS
    }
}

entry!(TorqueLaw { course });

impl<T: Real> TensionLaw<T> for TorqueLaw {
    #[inline]
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
        let [force, stiffness, damping] = law_inputs.course(self.number());
        let tension = -force;
        if self.course & RESISTS == 0 {
            return ScalarForce { value, rate, tension, ..ScalarForce::default() };
        }
        ScalarForce { value, rate, tension, stiffness, damping, ..ScalarForce::default() }
    }

    fn operations(&self) -> Operations {
        Operations::NONE
    }

    fn fits(&self, _: &LawInputs<'_, T>, n_courses: usize) -> bool {
        (self.number() as usize) < n_courses
    }
}

#[cfg(feature = "alloc")]
pub use data::JointTorque;

#[cfg(feature = "alloc")]
mod data {
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
            let on = (self.joint, self.coordinate);
            let law = to.torque_law(&self.course, to.coordinate(on));
            to.on_joint(on, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
