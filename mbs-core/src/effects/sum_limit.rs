//! Elastic stops of a sum of joint coordinates and lengths: the play of a gear.

#[cfg(feature = "alloc")]
pub use data::SumLimit;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::limit::{LimitLaw, check_range};

    effect! {
        /// Elastic stops of a sum. The play of a gear is a range of half of it on both sides.
        pub struct SumLimit<T> = ["limit"] {
            /// The terms of the sum.
            terms: Vec<CouplingTerm<T>> = Terms, "", Needed;
            /// Sum below which the lower stop pushes.
            lower: T = Number(Any), "rad or m", Needed;
            /// Sum above which the upper stop pushes.
            upper: T = Number(Any), "rad or m", Needed;
            /// Stiffness.
            stiffness: T = Number(NotNegative), "N m/rad or N/m", Needed;
            /// Damping while in contact.
            damping: T = Number(NotNegative), "N m s/rad or N s/m", ZERO;
        }
    }

    impl<T: Real> EffectModel<T> for SumLimit<T> {
        const LAW: &'static str = "a bumper at each end";
        const IS_ONE_SIDED: bool = true;
        const ENDS: &'static [&'static str] = &["lower", "upper"];

        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            check_range([self.lower, self.upper], place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self { ref terms, lower, upper, stiffness, damping } = self;
            to.on_sum(terms, LimitLaw { lower, upper, stiffness, damping });
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
