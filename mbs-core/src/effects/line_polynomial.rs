//! A force by a piecewise polynomial of the length of a line over points, or of its rate.

#[cfg(feature = "alloc")]
pub use data::LinePolynomial;

#[cfg(feature = "alloc")]
mod data {
    use crate::effects::data::*;
    use crate::effects::polynomial::{DAMPER, SPRING, check_pieces, law_of};
    use crate::scene::PolynomialPiece;

    effect! {
        /// A piecewise polynomial along a line over points of bodies: tension of its length (a spring) or of its rate (a damper).
        pub struct LinePolynomial<T> = [SPRING, DAMPER] {
            /// Two points or more, reference configuration.
            points: Vec<(BodyId, [T; 3])> = Line, "m", Needed;
            /// Pieces, in increasing order and without gaps, of the powers of L or L̇.
            pieces as "coefficients": Vec<PolynomialPiece<T>> = Pieces, "N, m or m/s", Needed;
            /// Of the length's rate instead of the length.
            of_rate as "kind": bool = Name(DAMPER), "", Nothing;
        }
    }

    impl<T: Real> EffectModel<T> for LinePolynomial<T> {
        const LAW: &'static str =
            "tension Σ cₖ Lᵏ of a spring, Σ cₖ L̇ᵏ of a damper, positive pulls";

        fn name(&self) -> &'static str {
            if self.of_rate { DAMPER } else { SPRING }
        }
        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            check_pieces(&self.pieces, place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = law_of(&self.pieces, self.of_rate, to);
            to.on_line(&self.points, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::Coil)
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
