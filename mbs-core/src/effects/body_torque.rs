//! A given torque on a body.

#[cfg(feature = "alloc")]
pub use data::BodyTorque;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;

    effect! {
        /// A torque on a body, from the ground: planar counter-clockwise in the first component, spatial a vector in global axes.
        pub struct BodyTorque<T> = ["torque"] {
            /// The body.
            body: BodyId = Body, "", Needed;
            /// Torque.
            course as "value": Signal<T> = Signal(Moment), "N m", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for BodyTorque<T> {
        const LAW: &'static str = "from the ground, in space a vector in global axes";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let Some(body) = self.body.index() else { return };
            let course = to.course(&self.course);
            to.push(Action::Torque { body, course });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
