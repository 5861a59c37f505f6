//! Piecewise polynomials of a length or a rate. Each piece is expanded about the middle of its range to avoid cancellation.
//!
//! ```text
//! p(x) = sum c_k x^k = sum d_k (x - m)^k,   m the middle of the piece
//! ```
//!
//! In the damper unit of the Iltis, terms of 4e6 N cancel to 130 N. About the middle of the piece nothing cancels. Outside of all
//! pieces the nearest piece is continued along its tangent.

use super::entry::entry;
use crate::Real;

/// Largest number of coefficients of a piece: degree 7.
pub const MAX_COEFFICIENTS: usize = 8;

/// Polynomial about the middle of the range in which it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece<T> {
    /// Lower end of the range.
    pub lower: T,
    /// Upper end of the range.
    pub upper: T,
    /// Middle m of the range.
    pub middle: T,
    /// Coefficients d_k about the middle.
    pub coefficients: [T; MAX_COEFFICIENTS],
    /// Integral of all pieces from the lower end of the first piece to m.
    pub energy: T,
}

entry!(Piece<T> { lower, upper, middle, coefficients, energy });

impl<T: Real> Piece<T> {
    /// Converts coefficients to powers of x - m, m the middle of the range. `None` for more than [`MAX_COEFFICIENTS`], and for an
    /// empty range.
    #[must_use]
    pub fn new([lower, upper]: [T; 2], coefficients: &[T]) -> Option<Self> {
        if coefficients.len() > MAX_COEFFICIENTS || !(lower < upper) {
            return None;
        }
        let middle = (lower + upper) * T::HALF;
        let mut d = [T::ZERO; MAX_COEFFICIENTS];
        d[..coefficients.len()].copy_from_slice(coefficients);
        // Synthetic division by (x - m), repeated for each coefficient.
        for k in 0..MAX_COEFFICIENTS {
            for i in (k..MAX_COEFFICIENTS - 1).rev() {
                let next = d[i + 1];
                d[i] += next * middle;
            }
        }
        Some(Self { lower, upper, middle, coefficients: d, energy: T::ZERO })
    }

    /// Value and slope at `x`. Beyond the ends of the range the tangent at the end is used.
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

    /// Integral from m to x.
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

/// Computes the energy at the middle of each piece, for a list of consecutive pieces.
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

/// Value and slope of piecewise polynomials at `x`; zero without pieces.
#[inline]
pub fn value<T: Real>(pieces: &[Piece<T>], x: T) -> (T, T) {
    find(pieces, x).map_or((T::ZERO, T::ZERO), |piece| piece.value(x))
}

/// Largest relative jump of value or slope between two pieces that does not count as a kink [-].
const LEVEL: f64 = 1e-6;

/// Passes the places between pieces at which value or slope jumps to `take`.
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

/// Integral from the lower end of the first piece to `x` [J for a spring].
pub fn energy<T: Real>(pieces: &[Piece<T>], x: T) -> T {
    find(pieces, x).map_or(T::ZERO, |piece| piece.energy + piece.integral(x))
}
