//! Stiffness and damping with up to three coefficients: forces that are polynomials of a length or of its rate.
//!
//! Force of a spring: −(k₀ x + k₁ x² + k₂ x³), whose second term does not change sign with x. Force of a damper: −(b₀ + b₁ |v| + b₂ v²) v.

use super::defaults::View;
use crate::robot::Piece;
use crate::source::Read;

/// Deviation up to which a spring follows its polynomial [rad or m]; beyond it the tangent continues. The energy is counted from this
/// deviation, so a larger value costs digits.
const REACH: f64 = 100.0;
/// Ends of the pieces of a polynomial on one side of zero [rad or m, or per s]. Each is ten times the previous one, so that low values keep
/// their digits. Beyond the last end, a damper follows the tangent.
const STEPS: [f64; 8] = [0.0, 1.0, 10.0, 1.0e2, 1.0e3, 1.0e4, 1.0e5, 1.0e6];

/// Three coefficients, of increasing powers of a length or rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strength(pub(super) [f64; 3]);

impl Strength {
    pub(super) const NONE: Self = Self([0.0; 3]);

    /// Reads up to three coefficients, some of which may come from a default class.
    pub(super) fn read(view: &View<'_>, name: &str) -> Read<Self> {
        view.merged(name, [0.0; 3]).map(Self)
    }

    /// The coefficients multiplied by a factor that depends on the power of the length or rate.
    pub(super) fn grown(&self, factor: impl Fn(i32) -> f64) -> Self {
        let [a, b, c] = self.0;
        Self([a * factor(1), b * factor(2), c * factor(3)])
    }

    /// Returns the coefficients if the law acts, or else zeros.
    pub(super) const fn where_it(self, acts: bool) -> Self {
        if acts { self } else { Self::NONE }
    }

    /// The coefficient of a linear law; `None` when higher powers act.
    pub(super) fn linear(&self) -> Option<f64> {
        (self.0[1..] == [0.0; 2]).then_some(self.0[0])
    }

    /// The coefficients for a coordinate with this sign relative to the file's. The even term of a spring changes its sign.
    pub(super) fn against(&self, sign: f64) -> Self {
        let [a, b, c] = self.0;
        Self([a, b * sign, c])
    }

    /// Coefficients of the powers of m for the polynomial of x = m − free.
    fn shifted(&self, free: f64) -> [f64; 4] {
        let [k0, k1, k2] = self.0;
        [
            free * (-k0 + free * (k1 - free * k2)),
            k0 + free * (-2.0 * k1 + 3.0 * free * k2),
            k1 - 3.0 * free * k2,
            k2,
        ]
    }

    /// Pieces of the force of a spring that has no force between two values.
    pub(super) fn spring(&self, [lower, upper]: [f64; 2]) -> Vec<Piece> {
        let piece = |lower, upper, coefficients| Piece { lower, upper, coefficients };
        if lower == upper {
            return vec![piece(lower - REACH, upper + REACH, self.shifted(upper))];
        }
        let steps = || STEPS.windows(2).filter(|ends| ends[0] < REACH);
        let [below, above] = [lower, upper].map(|end| self.shifted(end));
        let falling = steps().rev().map(|ends| piece(lower - ends[1], lower - ends[0], below));
        let slack = core::iter::once(piece(lower, upper, [0.0; 4]));
        let rising = steps().map(|ends| piece(upper + ends[0], upper + ends[1], above));
        falling.chain(slack).chain(rising).collect()
    }

    /// Pieces of the force of a damper.
    pub(super) fn damper(&self) -> Vec<Piece> {
        let [b0, b1, b2] = self.0;
        if b1 == 0.0 {
            let coefficients = [0.0, b0, 0.0, b2];
            let reach = STEPS[STEPS.len() - 1];
            return vec![Piece { lower: -reach, upper: reach, coefficients }];
        }
        let rising = STEPS.windows(2).map(|ends| Piece {
            lower: ends[0],
            upper: ends[1],
            coefficients: [0.0, b0, b1, b2],
        });
        let falling = STEPS.windows(2).rev().map(|ends| Piece {
            lower: -ends[1],
            upper: -ends[0],
            coefficients: [0.0, b0, -b1, b2],
        });
        falling.chain(rising).collect()
    }
}
