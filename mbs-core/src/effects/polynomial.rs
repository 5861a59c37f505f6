//! A force by a piecewise polynomial: see [`polynomial`](crate::laws::polynomial).

use crate::Real;
use crate::laws::corner::LawCorner;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::polynomial::{energy, kinks, value};
use crate::laws::scalar::{ScalarForce, TensionLaw};
use crate::laws::{LawInputs, Part};

/// Law of a piecewise polynomial of the value or of the rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PolynomialLaw {
    /// Pieces of the polynomial.
    pub pieces: Part,
    /// True if the polynomial is one of the rate, as in a damper.
    pub of_rate: bool,
}

entry!(PolynomialLaw { pieces, of_rate });

impl<T: Real> TensionLaw<T> for PolynomialLaw {
    #[inline]
    fn evaluate(&self, at: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T> {
        let pieces = self.pieces.of(law_inputs.pieces());
        let plain = ScalarForce { value: at, rate, ..ScalarForce::default() };
        if self.of_rate {
            let (tension, slope) = value(pieces, rate);
            ScalarForce { tension, damping: slope.max(T::ZERO), ..plain }
        } else {
            let (tension, slope) = value(pieces, at);
            ScalarForce { tension, stiffness: slope.max(T::ZERO), ..plain }
        }
    }

    fn operations(&self) -> Operations {
        Operations::new(17, 19)
    }

    #[inline]
    fn energy(&self, value: T, law_inputs: &LawInputs<'_, T>) -> T {
        if self.of_rate { T::ZERO } else { energy(self.pieces.of(law_inputs.pieces()), value) }
    }

    #[inline]
    fn power(&self, measure: &ScalarForce<T>, _: &LawInputs<'_, T>) -> T {
        if self.of_rate { (T::ZERO - measure.tension) * measure.rate } else { T::ZERO }
    }

    fn may_push(&self) -> bool {
        !self.of_rate
    }

    fn may_have_kinks(&self) -> bool {
        !self.of_rate && self.pieces.n > 1
    }

    fn kinks(&self, law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) {
        if !self.of_rate {
            kinks(self.pieces.of(law_inputs.pieces()), |place| {
                take(LawCorner { place, height: T::ZERO, slope: T::ZERO });
            });
        }
    }

    fn fits(&self, law_inputs: &LawInputs<'_, T>, _: usize) -> bool {
        self.pieces.is_within(law_inputs.pieces().len())
    }
}

#[cfg(feature = "alloc")]
pub use data::Polynomial;
#[cfg(feature = "alloc")]
pub(super) use data::{DAMPER, SPRING, check_pieces, law_of};

#[cfg(feature = "alloc")]
mod data {
    use super::PolynomialLaw;
    use crate::effects::data::*;
    use crate::laws::polynomial::{MAX_COEFFICIENTS, Piece, link};
    use crate::scene::PolynomialPiece;

    const KEY: &str = "coefficients";
    pub(in crate::effects) const SPRING: &str = "polynomial-spring";
    pub(in crate::effects) const DAMPER: &str = "polynomial-damper";

    effect! {
        /// A piecewise polynomial between two body points: tension of the length (a spring) or of its rate (a damper).
        pub struct Polynomial<T> = [SPRING, DAMPER] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// One point per body, reference configuration.
            points: [[T; 3]; 2] = Points(false), "m", Needed;
            /// Pieces, in increasing order and without gaps, of the powers of L or L̇.
            pieces as "coefficients": Vec<PolynomialPiece<T>> = Pieces, "N, m or m/s", Needed;
            /// The length is measured along this direction, fixed in the first body, instead of between the points.
            direction: Option<[T; 3]> = MaybeAxis, "", Nothing;
            /// Of the length's rate instead of the length.
            of_rate as "kind": bool = Name(DAMPER), "", Nothing;
        }
    }

    /// Checks that the pieces are in increasing order and without gaps, and that each has coefficients.
    pub(in crate::effects) fn check_pieces<T: Real>(
        pieces: &[PolynomialPiece<T>],
        place: Place,
    ) -> Result<(), SceneError> {
        if pieces.is_empty() {
            return place.fault(KEY, SceneFault::WrongCount { needed: 1, found: 0 });
        }
        let mut end = None;
        for (i, piece) in pieces.iter().enumerate() {
            let PolynomialPiece { lower, upper, coefficients } = piece;
            for x in [lower, upper].into_iter().chain(coefficients) {
                place.finite(KEY, *x)?;
            }
            if coefficients.is_empty() || coefficients.len() > MAX_COEFFICIENTS {
                let found = coefficients.len();
                return place.fault(KEY, SceneFault::PieceCoefficients { piece: i, found });
            }
            if !(lower < upper) {
                return place.fault(KEY, SceneFault::PieceRange(i));
            }
            if end.is_some_and(|end| end != *lower) {
                return place.fault(KEY, SceneFault::PieceGap(i));
            }
            end = Some(*upper);
        }
        Ok(())
    }

    /// Adds these pieces to the tables, and returns their law.
    pub(in crate::effects) fn law_of<T: Real>(
        pieces: &[PolynomialPiece<T>],
        of_rate: bool,
        to: &mut Compiler<'_, T>,
    ) -> PolynomialLaw {
        let all = &mut to.actions.tables.pieces;
        let first = all.len();
        let piece = |p: &PolynomialPiece<T>| Piece::new([p.lower, p.upper], &p.coefficients);
        all.extend(pieces.iter().filter_map(piece));
        link(&mut all[first..]);
        PolynomialLaw { pieces: crate::effects::action::part(first, all.len()), of_rate }
    }

    impl<T: Real> EffectModel<T> for Polynomial<T> {
        const LAW: &'static str = "tension Σ cₖ Lᵏ of a spring, Σ cₖ L̇ᵏ of a damper, positive pulls; one to eight coefficients a piece";

        fn name(&self) -> &'static str {
            if self.of_rate { DAMPER } else { SPRING }
        }
        /// Checks that there is at least one piece. Each piece must have coefficients and a range, and begin at the end of the
        /// piece before. Small jumps of the value between pieces are allowed, because published data have them.
        fn check(&self, _: Surroundings<'_, T>, place: Place) -> Result<(), SceneError> {
            match self.direction {
                // The distance along a direction may be zero, so that the points may coincide.
                Some(direction) => place.axis("direction", direction)?,
                None => place.apart("points", self.points)?,
            }
            check_pieces(&self.pieces, place)
        }
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = law_of(&self.pieces, self.of_rate, to);
            match self.direction {
                None => to.length(self.bodies, self.points, law),
                Some(d) => {
                    let direction = crate::effects::action::direction_of(d);
                    to.along(self.bodies, self.points, direction, law);
                }
            }
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::of([!self.of_rate, self.of_rate]))
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
