//! Spring and damper of a sum of joint coordinates and lengths.

#[cfg(feature = "alloc")]
pub use data::SumSpring;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::line_spring::law_of;

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
            /// Whether it is slack below that sum, and pushes nowhere.
            pulls_only: bool = Flag, "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for SumSpring<T> {
        const LAW: &'static str = "tension k (m - m0) + c ṁ, with `pulls_only` zero below m0 and never negative; angles are not wrapped";

        const HAS_BRANCHES: bool = false;

        /// Refuses a negative stiffness or damping of a spring that pulls only.
        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            if !self.pulls_only {
                return Ok(());
            }
            place.not_negative("stiffness", self.stiffness)?;
            place.not_negative("damping", self.damping)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = law_of([self.stiffness, self.damping, self.free_value], self.pulls_only);
            to.on_sum(&self.terms, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}
