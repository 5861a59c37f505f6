//! Friction of a sum of joint coordinates and lengths: a clutch between two joints.

#[cfg(feature = "alloc")]
pub use data::SumFriction;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::friction::{FrictionLaw, check_levels, leave_levels, rise};

    effect! {
        /// Stribeck friction of a sum, regularised; with a signal a clutch.
        pub struct SumFriction<T> = ["friction"] {
            /// The terms of the sum.
            terms: Vec<CouplingTerm<T>> = Terms, "", Needed;
            /// Friction of fast motion.
            coulomb: T = Number(NotNegative), "N m or N", Needed;
            /// Friction of slow motion.
            r#static as "static": T = Number(NotNegative), "N m or N", As("coulomb");
            /// Rate at which the one becomes the other.
            stribeck: T = Number(Positive), "rad/s or m/s", Times("10", "regularisation");
            /// Viscous part.
            viscous: T = Number(NotNegative), "N m s/rad or N s/m", ZERO;
            /// Rate below which friction falls to zero with the rate.
            regularisation: T = Number(Positive), "rad/s or m/s", Number("1e-3");
            /// Factor of `coulomb` and `static`. Below zero it counts as zero.
            factor as "value": Signal<T> = Signal(Scalar), "-", Number("1");
        }
    }

    impl<T: Real> EffectModel<T> for SumFriction<T> {
        const LAW: &'static str = "g(ṁ) ṁ/√(ṁ² + e²) + v ṁ, g = `value` (C + (S - C)/(1 + (ṁ/s)²))";

        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            check_levels([self.r#static, self.coulomb], place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self { coulomb, r#static, stribeck, viscous, regularisation, .. } = self;
            let law =
                FrictionLaw { coulomb, r#static, stribeck, viscous, regularisation, course: None };
            let law = law.by(&self.factor, to);
            to.on_sum(&self.terms, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn sticking(&self) -> Option<T> {
            rise([self.coulomb, self.r#static], self.regularisation)
        }
        fn dissipates(&self) -> bool {
            true
        }
        fn rest(&mut self, leave: &mut dyn FnMut(&'static str)) -> bool {
            let levels = [&mut self.coulomb, &mut self.r#static];
            leave_levels(levels, leave);
            self.viscous > T::ZERO
        }
    }
}
