//! A user-defined law with data on a coordinate of a joint: see [`code`](crate::laws::code).

#[cfg(feature = "alloc")]
pub use data::LawOnJoint;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::laws::code::{Code, ForceLaw};

    effect! {
        /// A user-defined law with data, on a joint's coordinate; in code only.
        pub struct LawOnJoint<T> = [] {
            /// The joint.
            joint: JointId = Joint(Coordinate), "", Needed;
            /// Its coordinate; needed where it has several.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// The law.
            law: Code<dyn ForceLaw> = ForceLaw, "", Needed;
            /// Its input.
            input as "value": Signal<T> = Signal(Three), "", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for LawOnJoint<T> {
        const LAW: &'static str = "";

        fn name(&self) -> &'static str {
            "law-on-joint"
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = to.force_code(&self.law, &self.input);
            to.on_joint((self.joint, self.coordinate), law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            true
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn follows_time(&self) -> bool {
            true
        }
    }
}
