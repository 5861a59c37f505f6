//! A given force along the line of two points.

#[cfg(feature = "alloc")]
pub use data::Actuator;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::joint_torque::TorqueLaw;

    effect! {
        /// A force along the line of two body points that follows a signal, positive when it pushes them apart.
        pub struct Actuator<T> = ["actuator"] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// One point per body, reference configuration.
            points: [[T; 3]; 2] = Points(true), "m", Needed;
            /// Force, first component.
            course as "value": Signal<T> = Signal(Scalar), "N", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for Actuator<T> {
        const LAW: &'static str = "a force along the line, positive pushes apart";

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let course = to.course(&self.course);
            to.length(self.bodies, self.points, TorqueLaw::new(course));
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::Actuator)
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
