//! Spring and damper about the axis of a joint.

#[cfg(feature = "alloc")]
pub use data::TorsionSpring;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::spring_damper::SpringDamperLaw;

    effect! {
        /// torque on the second body = -(stiffness (angle - free_value) + damping rate) about a revolute joint's axis.
        pub struct TorsionSpring<T> = ["torsion-spring"] {
            /// The joint.
            joint: JointId = Joint(Rotation), "", Needed;
            /// Stiffness.
            stiffness: T = Number(Any), "N m/rad", ZERO;
            /// Damping.
            damping: T = Number(Any), "N m s/rad", ZERO;
            /// Angle without torque.
            free_value: T = Number(Any), "rad", ZERO;
        }
    }

    impl<T: Real> EffectModel<T> for TorsionSpring<T> {
        const LAW: &'static str =
            "torque on the second body -(k (q - q0) + c q̇); angles are not wrapped";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (stiffness, damping, free) = (self.stiffness, self.damping, self.free_value);
            to.angle(self.joint, SpringDamperLaw { stiffness, damping, free });
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}
