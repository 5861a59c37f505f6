//! A given torque, or force, along a sum of joint coordinates and lengths.

#[cfg(feature = "alloc")]
pub use data::SumTorque;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::joint_torque::TorqueLaw;

    effect! {
        /// A torque or force in the sense in which a sum grows: each coordinate has its factor times that.
        pub struct SumTorque<T> = ["torque"] {
            /// The terms of the sum.
            terms: Vec<CouplingTerm<T>> = Terms, "", Needed;
            /// Torque, or force.
            course as "value": Signal<T> = Signal(Scalar), "N m or N", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for SumTorque<T> {
        const LAW: &'static str = "each coordinate has its factor times that";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let course = to.course(&self.course);
            to.on_sum(&self.terms, TorqueLaw::new(course));
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
