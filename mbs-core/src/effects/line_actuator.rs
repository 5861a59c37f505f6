//! A given tension along a line over points: a rope on a winch of a given force.

#[cfg(feature = "alloc")]
pub use data::LineActuator;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::joint_torque::TorqueLaw;

    effect! {
        /// A force along a line over points of bodies that follows a signal, positive when it lengthens the line.
        pub struct LineActuator<T> = ["actuator"] {
            /// Two points or more, reference configuration.
            points: Vec<(BodyId, [T; 3])> = Line, "m", Needed;
            /// Force, first component.
            course as "value": Signal<T> = Signal(Scalar), "N", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for LineActuator<T> {
        const LAW: &'static str = "a force along the line, positive pushes apart";

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let course = to.course(&self.course);
            to.on_line(&self.points, TorqueLaw::new(course));
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::Actuator)
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
