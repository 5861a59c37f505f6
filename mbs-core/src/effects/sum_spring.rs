//! Spring and damper of a sum of joint coordinates and lengths.

#[cfg(feature = "alloc")]
pub use data::SumSpring;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::spring_damper::SpringDamperLaw;
    use alloc::vec::Vec;

    effect! {
        /// Tension of a sum = stiffness (sum - free_value) + damping rate; each coordinate has minus its factor times that.
        pub struct SumSpring<T> = ["torsion-spring", "spring-damper"] {
            /// The terms of the sum.
            terms: Vec<CouplingTerm<T>> = Terms, "", Needed;
            /// Stiffness.
            stiffness: T = Number(Any), "N m/rad or N/m", ZERO;
            /// Damping.
            damping: T = Number(Any), "N m s/rad or N s/m", ZERO;
            /// Sum without tension.
            free_value: T = Number(Any), "rad or m", ZERO;
        }
    }

    impl<T: Real> EffectModel<T> for SumSpring<T> {
        const LAW: &'static str = "tension k (m - m0) + c ṁ; angles are not wrapped";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (stiffness, damping, free) = (self.stiffness, self.damping, self.free_value);
            to.on_sum(&self.terms, SpringDamperLaw { stiffness, damping, free });
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}
