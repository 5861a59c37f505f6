//! Spring and damper of a coordinate of a joint.

#[cfg(feature = "alloc")]
pub use data::TorsionSpring;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::spring_damper::SpringDamperLaw;

    effect! {
        /// torque on the second body = -(stiffness (angle - free_value) + damping rate) about a joint's axis; a force along a slide.
        pub struct TorsionSpring<T> = ["torsion-spring"] {
            /// The joint.
            joint: JointId = Joint(Rotation), "", Needed;
            /// Its coordinate; needed where it has several rotations.
            coordinate: Option<usize> = Coordinate, "", Nothing;
            /// Stiffness.
            stiffness: T = Number(Any), "N m/rad or N/m", ZERO;
            /// Damping.
            damping: T = Number(Any), "N m s/rad or N s/m", ZERO;
            /// Coordinate without torque or force.
            free_value: T = Number(Any), "rad or m", ZERO;
        }
    }

    impl<T: Real> EffectModel<T> for TorsionSpring<T> {
        const LAW: &'static str =
            "torque on the second body -(k (q - q0) + c q̇); angles are not wrapped";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (stiffness, damping, free) = (self.stiffness, self.damping, self.free_value);
            let law = SpringDamperLaw { stiffness, damping, free };
            to.on_joint((self.joint, self.coordinate), law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            let (key, value) = ("free_value", self.free_value);
            [UnitHint::Angle { key, value, of: None }].into()
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}
