//! A given force at a point of a body.

#[cfg(feature = "alloc")]
pub use data::Force;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::scene::AxisFrame;

    effect! {
        /// A force at a point of a body.
        pub struct Force<T> = ["force"] {
            /// The body.
            body: BodyId = Body, "", Needed;
            /// Point of application, reference configuration.
            at: [T; 3] = Point, "m", Needed;
            /// Force.
            course as "value": Signal<T> = Signal(Vector), "N", Needed;
            /// Axes of the force.
            frame: AxisFrame = Frame, "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for Force<T> {
        const LAW: &'static str =
            "constant, or linear between the rows of the table and held outside";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let Some(body) = self.body.index() else { return };
            let at = (body, self.at);
            let action = match (&self.course, self.frame) {
                (Signal::Constant(force), AxisFrame::Global) => {
                    Action::Constant { at, force: *force }
                }
                (course, frame) => {
                    let course = to.course(course);
                    Action::Force { at, course, turns: frame == AxisFrame::Body }
                }
            };
            to.push(action);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
    }
}
