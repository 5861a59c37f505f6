//! Pieces of a polynomial spring or damper. Small jumps of the value between pieces are as published data have them: they pass.

use super::vector::Place;
use crate::Real;
use crate::scene::{PolynomialPiece, SceneError, SceneFault};

const FIELD: &str = "coefficients";

/// At least one piece; each has coefficients, a range, and begins where the one before ends.
pub(super) fn check<T: Real>(
    pieces: &[PolynomialPiece<T>],
    place: Place,
) -> Result<(), SceneError> {
    if pieces.is_empty() {
        return place.fault(FIELD, SceneFault::WrongCount { needed: 1, found: 0 });
    }
    let mut end = None;
    for (i, piece) in pieces.iter().enumerate() {
        let PolynomialPiece { lower, upper, coefficients } = piece;
        for x in [lower, upper].into_iter().chain(coefficients) {
            place.finite(FIELD, *x)?;
        }
        if coefficients.is_empty() || coefficients.len() > PolynomialPiece::<T>::MAX_COEFFICIENTS {
            let found = coefficients.len();
            return place.fault(FIELD, SceneFault::PieceCoefficients { piece: i, found });
        }
        if !(lower < upper) {
            return place.fault(FIELD, SceneFault::PieceRange(i));
        }
        if end.is_some_and(|end| end != *lower) {
            return place.fault(FIELD, SceneFault::PieceGap(i));
        }
        end = Some(*upper);
    }
    Ok(())
}
