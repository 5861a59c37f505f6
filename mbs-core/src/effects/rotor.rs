//! Inertia of a rotor whose angle is a ratio times a joint coordinate, such as that of a motor behind a gear.
//!
//! ```text
//! E = inertia (ratio q')^2 / 2          nothing else: no moment on the housing but that about the joint's axis
//! ```
//!
//! A rotor is an inertia and exerts no force. Models read it from [`RotorInput`](crate::mechanism::RotorInput).

#[cfg(feature = "alloc")]
pub use data::Rotor;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;

    effect! {
        /// A rotor that turns by ratio times a joint's coordinate: kinetic energy inertia (ratio rate)² / 2.
        pub struct Rotor<T> = ["rotor"] {
            /// The joint.
            joint: JointId = Joint(Coordinate), "", Needed;
            /// Its coordinate; needed where it has several.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// Inertia of the rotor about its axis.
            inertia: T = Number(Positive), "kg m²", Needed;
            /// How far the rotor turns for each unit of the coordinate.
            ratio: T = Number(Any), "- or rad/m", Needed;
        }
    }

    impl<T: Real> Rotor<T> {
        /// Inertia that the rotor adds to its joint coordinate [kg m^2; for a slide kg].
        fn at_joint(&self) -> T {
            self.inertia * self.ratio * self.ratio
        }
    }

    impl<T: Real> EffectModel<T> for Rotor<T> {
        const LAW: &'static str = "adds `inertia` `ratio`² to the inertia of the coordinate";
        const HAS_BRANCHES: bool = false;

        fn check(&self, among: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            let is_free = |joint: &crate::scene::Joint<T>| joint.kind.is_free();
            if among.joints.get(self.joint.index()).is_some_and(is_free) {
                return place.fault("joint", SceneFault::FreeRotor);
            }
            let at_joint = self.at_joint();
            if at_joint.is_finite() && at_joint > T::ZERO {
                return Ok(());
            }
            place.fault("ratio", SceneFault::RotorRatio(at_joint.to_f64()))
        }

        fn actions(&self, _: &mut Compiler<'_, T>) {}
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn rotor(&self) -> Option<RotorInertia<T>> {
            let inertia = self.at_joint();
            Some(RotorInertia { joint: self.joint, coordinate: self.coordinate, inertia })
        }
    }
}
