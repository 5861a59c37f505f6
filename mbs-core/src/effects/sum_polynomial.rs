//! A force by a piecewise polynomial of a sum of joint coordinates and lengths, or of its rate.

#[cfg(feature = "alloc")]
pub use data::SumPolynomial;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::polynomial::{DAMPER, SPRING, check_pieces, law_of};
    use crate::scene::PolynomialPiece;

    effect! {
        /// A piecewise polynomial of a sum (a spring) or of its rate (a damper).
        pub struct SumPolynomial<T> = [SPRING, DAMPER] {
            /// The terms of the sum.
            terms: Vec<CouplingTerm<T>> = Terms, "", Needed;
            /// Pieces, in increasing order and without gaps, of the powers of the sum or its rate.
            pieces as "coefficients": Vec<PolynomialPiece<T>> = Pieces, "N m or N; rad, m or by s", Needed;
            /// Of the rate of the sum instead of the sum.
            of_rate as "kind": bool = Name(DAMPER), "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for SumPolynomial<T> {
        const LAW: &'static str = "tension Σ cₖ mᵏ of a spring, Σ cₖ ṁᵏ of a damper";

        fn name(&self) -> &'static str {
            if self.of_rate { DAMPER } else { SPRING }
        }
        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            check_pieces(&self.pieces, place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = law_of(&self.pieces, self.of_rate, to);
            to.on_sum(&self.terms, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            !self.of_rate
        }
        fn dissipates(&self) -> bool {
            self.of_rate
        }
    }
}
