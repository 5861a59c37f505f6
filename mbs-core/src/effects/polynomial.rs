//! Piecewise polynomials of a length or a rate, re-centred so that digits survive.
//!
//! ```text
//! p(x) = sum c_k x^k = sum d_k (x - m)^k,   m the middle of the piece
//! ```
//!
//! The damper unit of the Iltis cancels terms of 4e6 N down to 130 N: about the middle of the piece nothing cancels.
//! Outside of all pieces the nearest piece is continued by its tangent.

use crate::Real;
use crate::laws::entry::entry;
use crate::laws::kink::Kink;
use crate::laws::operations::Operations;
use crate::laws::scalar::{Measure, TensionLaw};
use crate::laws::{Part, Supplies};

/// Most coefficients of a piece: degree 7.
pub const MAX_COEFFICIENTS: usize = 8;

/// A polynomial about the middle of the range in which it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<T> {
    /// Where it begins.
    pub lower: T,
    /// Where it ends.
    pub upper: T,
    /// m.
    pub middle: T,
    /// d_k.
    pub coefficients: [T; MAX_COEFFICIENTS],
    /// The integral of all pieces from the first one's lower end to m.
    pub energy: T,
}

entry!(Piece<T> { lower, upper, middle, coefficients, energy });

impl<T: Real> Piece<T> {
    /// Re-centres coefficients about the middle of their range; what exceeds [`MAX_COEFFICIENTS`] is refused with `None`, and so is
    /// an empty range.
    #[must_use]
    pub fn new([lower, upper]: [T; 2], coefficients: &[T]) -> Option<Self> {
        if coefficients.len() > MAX_COEFFICIENTS || !(lower < upper) {
            return None;
        }
        let middle = (lower + upper) * T::HALF;
        let mut d = [T::ZERO; MAX_COEFFICIENTS];
        d[..coefficients.len()].copy_from_slice(coefficients);
        // Repeated synthetic division by (x - m).
        for k in 0..MAX_COEFFICIENTS {
            for i in (k..MAX_COEFFICIENTS - 1).rev() {
                let next = d[i + 1];
                d[i] += next * middle;
            }
        }
        Some(Self { lower, upper, middle, coefficients: d, energy: T::ZERO })
    }

    /// Value and slope; beyond the ends of the range along the tangent there.
    #[inline]
    fn value(&self, x: T) -> (T, T) {
        let at = x.max(self.lower).min(self.upper);
        let s = at - self.middle;
        let (mut p, mut dp) = (T::ZERO, T::ZERO);
        for &d in self.coefficients.iter().rev() {
            dp = dp * s + p;
            p = p * s + d;
        }
        (p + dp * (x - at), dp)
    }

    /// The integral from m to x.
    fn integral(&self, x: T) -> T {
        let at = x.max(self.lower).min(self.upper);
        let s = at - self.middle;
        let mut sum = T::ZERO;
        for (k, &d) in self.coefficients.iter().enumerate().rev() {
            #[allow(clippy::cast_precision_loss, reason = "at most eight")]
            let power = T::from_f64((k + 1) as f64);
            sum = sum * s + d / power;
        }
        let rest = x - at;
        let (p, dp) = self.value(at);
        sum * s + rest * (p + dp * rest * T::HALF)
    }
}

/// Fills in the energies of pieces that follow each other.
pub fn link<T: Real>(pieces: &mut [Piece<T>]) {
    let mut sum = T::ZERO;
    for piece in pieces {
        sum -= piece.integral(piece.lower);
        piece.energy = sum;
        sum += piece.integral(piece.upper);
    }
}

fn find<T: Real>(pieces: &[Piece<T>], x: T) -> Option<&Piece<T>> {
    let next = pieces.partition_point(|piece| piece.lower <= x);
    pieces.get(next.saturating_sub(1))
}

/// Value and slope at `x`; zero without pieces.
#[inline]
pub fn value<T: Real>(pieces: &[Piece<T>], x: T) -> (T, T) {
    find(pieces, x).map_or((T::ZERO, T::ZERO), |piece| piece.value(x))
}

/// Largest jump of value or slope between two pieces that counts as none, relative to the pieces' own [-]: files state six digits.
const LEVEL: f64 = 1e-6;

/// Hands out the places between pieces where value or slope jump.
pub fn kinks<T: Real>(pieces: &[Piece<T>], mut take: impl FnMut(T)) {
    let jumps = |a: T, b: T| (a - b).abs() > T::from_f64(LEVEL) * (a.abs() + b.abs());
    for pair in pieces.windows(2) {
        let place = pair[1].lower;
        let [(p, dp), (q, dq)] = [0, 1].map(|i| pair[i].value(place));
        if jumps(p, q) || jumps(dp, dq) {
            take(place);
        }
    }
}

/// The integral from the first piece's lower end to `x` [J for a spring].
pub fn energy<T: Real>(pieces: &[Piece<T>], x: T) -> T {
    find(pieces, x).map_or(T::ZERO, |piece| piece.energy + piece.integral(x))
}

/// A piecewise polynomial of the value or of the rate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PolynomialLaw {
    /// Its pieces.
    pub pieces: Part,
    /// Of the rate: a damper.
    pub of_rate: bool,
}

entry!(PolynomialLaw { pieces, of_rate });

impl<T: Real> TensionLaw<T> for PolynomialLaw {
    #[inline]
    fn evaluate(&self, at: T, rate: T, supplies: &Supplies<'_, T>) -> Measure<T> {
        let pieces = self.pieces.of(supplies.pieces());
        let plain = Measure { value: at, rate, ..Measure::default() };
        if self.of_rate {
            let (tension, slope) = value(pieces, rate);
            Measure { tension, damping: slope.max(T::ZERO), ..plain }
        } else {
            let (tension, slope) = value(pieces, at);
            Measure { tension, stiffness: slope.max(T::ZERO), ..plain }
        }
    }

    fn operations(&self) -> Operations {
        Operations::new(17, 19)
    }

    #[inline]
    fn energy(&self, value: T, supplies: &Supplies<'_, T>) -> T {
        if self.of_rate { T::ZERO } else { energy(self.pieces.of(supplies.pieces()), value) }
    }

    #[inline]
    fn power(&self, measure: &Measure<T>, _: &Supplies<'_, T>) -> T {
        if self.of_rate { (T::ZERO - measure.tension) * measure.rate } else { T::ZERO }
    }

    fn may_push(&self) -> bool {
        !self.of_rate
    }

    fn may_have_kinks(&self) -> bool {
        !self.of_rate && self.pieces.n > 1
    }

    fn kinks(&self, supplies: &Supplies<'_, T>, take: &mut dyn FnMut(Kink<T>)) {
        if !self.of_rate {
            kinks(self.pieces.of(supplies.pieces()), |place| {
                take(Kink { place, height: T::ZERO, slope: T::ZERO });
            });
        }
    }

    fn fits(&self, supplies: &Supplies<'_, T>, _: usize) -> bool {
        self.pieces.is_within(supplies.pieces().len())
    }
}

#[cfg(feature = "alloc")]
pub use data::Polynomial;

#[cfg(feature = "alloc")]
mod data {
    use super::{MAX_COEFFICIENTS, Piece, PolynomialLaw, link};
    use crate::effects::data::*;
    use crate::scene::PolynomialPiece;
    use alloc::vec::Vec;

    const KEY: &str = "coefficients";
    const DAMPER: &str = "polynomial-damper";

    effect! {
        /// A piecewise polynomial between two body points: tension of the length (a spring) or of its rate (a damper).
        pub struct Polynomial<T> = ["polynomial-spring", DAMPER] {
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

    impl<T: Real> EffectModel<T> for Polynomial<T> {
        const LAW: &'static str = "tension Σ cₖ Lᵏ of a spring, Σ cₖ L̇ᵏ of a damper, positive pulls; one to eight coefficients a piece";

        fn name(&self) -> &'static str {
            if self.of_rate { DAMPER } else { "polynomial-spring" }
        }
        /// At least one piece; each has coefficients, a range, and begins where the one before ends. Small jumps of the value between
        /// pieces are as published data have them: they pass.
        fn check(&self, _: &Scene<T>, place: Place) -> Result<(), SceneError> {
            match self.direction {
                // a distance along a line may be zero
                Some(direction) => place.axis("direction", direction)?,
                None => place.apart("points", self.points)?,
            }
            if self.pieces.is_empty() {
                return place.fault(KEY, SceneFault::WrongCount { needed: 1, found: 0 });
            }
            let mut end = None;
            for (i, piece) in self.pieces.iter().enumerate() {
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
        fn actions(&self, to: &mut Compiler<'_, T>) {
            let all = &mut to.actions.tables.pieces;
            let first = all.len();
            let piece = |p: &PolynomialPiece<T>| Piece::new([p.lower, p.upper], &p.coefficients);
            all.extend(self.pieces.iter().filter_map(piece));
            link(&mut all[first..]);
            let pieces = crate::actions::part(first, all.len());
            let law = PolynomialLaw { pieces, of_rate: self.of_rate };
            match self.direction {
                None => to.length(self.bodies, self.points, law),
                Some(d) => {
                    let direction = crate::actions::direction_of(d);
                    to.along(self.bodies, self.points, direction, law);
                }
            }
        }
        fn stores_energy(&self) -> bool {
            !self.of_rate
        }
        fn dissipates(&self) -> bool {
            self.of_rate
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use std::vec::Vec;

    fn damper() -> [Piece<f64>; 3] {
        let piece = |range, c: &[f64]| Piece::new(range, c).unwrap();
        let mut pieces = [
            piece([-2.0, -0.2], &[-416.42, 1844.3]),
            piece([-0.2, 0.21], &[0.0, 9945.627, 33955.72, -59832.25, -395_651.0]),
            piece([0.21, 2.0], &[1919.1638, 1634.727]),
        ];
        link(&mut pieces);
        pieces
    }

    #[test]
    fn kinks_are_where_value_or_slope_jump_and_not_where_pieces_join_smoothly() {
        let piece = |range, c: &[f64]| Piece::new(range, c).unwrap();
        // One parabola; a bend; a step.
        let pieces = [
            piece([-1.0, 0.3], &[1.0, -2.0, 3.0]),
            piece([0.3, 2.0], &[1.0, -2.0, 3.0]),
            piece([2.0, 3.0], &[9.0]),
            piece([3.0, 4.0], &[8.0]),
        ];
        let mut found = Vec::new();
        kinks(&pieces, |place| found.push(place));
        assert_eq!(found, [2.0, 3.0]);
        // The published damper joins smoothly, to the digits of its coefficients.
        kinks(&damper(), |place| panic!("{place}"));
    }

    #[test]
    fn re_centred_coefficients_give_the_same_polynomial() {
        let pieces = damper();
        let plain = |v: f64| {
            if v < -0.2 {
                -416.42 + 1844.3 * v
            } else if v < 0.21 {
                9945.627 * v + 33955.72 * v * v - 59832.25 * v.powi(3) - 395_651.0 * v.powi(4)
            } else {
                1919.1638 + 1634.727 * v
            }
        };
        for i in -300..300 {
            let v = f64::from(i) * 0.01 + 0.003;
            assert!((value(&pieces, v).0 - plain(v)).abs() < 1e-9, "{v}");
        }
    }

    #[test]
    fn the_elastic_part_of_the_iltis_damper_keeps_its_digits() {
        let c = [-4.0092e6, 2.8397e7, -6.7061e7, 5.2796e7];
        let pieces = [Piece::new([0.3, 0.6], &c).unwrap()];
        // At 0.44 m by rational arithmetic: -155.136 N exactly.
        assert!((value(&pieces, 0.44).0 + 155.136).abs() < 1e-8, "{}", value(&pieces, 0.44).0);
    }

    #[test]
    fn slope_and_energy_belong_to_the_value() {
        let pieces = damper();
        let h = 1e-6;
        for x in [-2.5, -1.0, -0.19, 0.0, 0.15, 0.5, 2.5] {
            let by = (value(&pieces, x + h).0 - value(&pieces, x - h).0) / (2.0 * h);
            assert!((by - value(&pieces, x).1).abs() < 1e-3, "{x}");
            let by = (energy(&pieces, x + h) - energy(&pieces, x - h)) / (2.0 * h);
            assert!((by - value(&pieces, x).0).abs() < 1e-3, "{x}");
        }
    }
}
