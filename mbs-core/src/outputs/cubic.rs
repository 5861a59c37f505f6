//! Cubic through values and rates at both ends of a step: its zeros within the step, and its changes of sign.
//!
//! ```text
//! g(t0 + r h) = g0 H00 + h g0' H10 + g1 H01 + h g1' H11,   H00 = (1 + 2r)(1 - r)^2,  H10 = r (1 - r)^2,
//!                                                           H01 = r^2 (3 - 2r),       H11 = r^2 (r - 1)
//! ```
//!
//! g is the gap, h the step, r the fraction of the step; 0 and 1 denote the beginning and the end of the step. Values in a small band
//! around zero have no sign. If a step begins in the band and leaves it, that is no change of sign. A contact that stays in the band is no
//! change of sign either.

use super::load::Gap;
use crate::Real;

/// A cubic over the fraction r of a step.
#[derive(Debug, Clone, Copy)]
pub struct Cubic {
    /// Values at both ends.
    values: [f64; 2],
    /// Derivatives by the fraction r at both ends.
    slopes: [f64; 2],
}

/// Number of bisections for a root [-]: its error is then 1e-16 of the step.
const HALVINGS: u32 = 53;

/// Length beyond the end of a step in which a change is also searched, relative to the step [-]. The repeated trial is longer and ends at
/// the change, so that no tiny step follows. Chosen, not tuned.
const BEYOND: f64 = 0.05;

/// Fraction of a step before which a change counts as a change at the start [-]. A kink of a force at fraction r causes 4 r (1 - r) times
/// the error of a kink at half the step. Here this factor is below half a percent.
pub const AT_START: f64 = 1e-3;

impl Cubic {
    /// Cubic through the gaps at both ends of a step of length `h` [s].
    pub fn new<T: Real>(gaps: [Gap<T>; 2], h: f64) -> Self {
        let values = gaps.map(|gap| gap.value.to_f64());
        Self { values, slopes: gaps.map(|gap| h * gap.rate.to_f64()) }
    }

    fn at(&self, r: f64) -> f64 {
        let ([g0, g1], [d0, d1]) = (self.values, self.slopes);
        let s = 1.0 - r;
        (g0 * (1.0 + 2.0 * r) + d0 * r) * s * s + (g1 * (3.0 - 2.0 * r) - d1 * s) * r * r
    }

    /// Fraction of the step at which the cubic equals `level`. `low` and `high` are fractions with values on different sides of `level`.
    ///
    /// Bisection is safe where the cubic is flat, and roots are rarely required.
    pub fn root(&self, level: f64, [mut low, mut high]: [f64; 2]) -> f64 {
        let below = self.at(low) < level;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (self.at(middle) < level) == below {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// First fraction, from [`AT_START`] to [`BEYOND`] the end, at which the cubic has changed its sign and exceeds half the band.
    ///
    /// Cost: about eighty operations, and a bisection if there is a change.
    pub fn change(&self, band: f64) -> Option<Change> {
        let mut side = Side::of(self.at(0.0), band);
        let mut from = 0.0;
        for to in self.pieces() {
            let next = Side::of(self.at(to), band);
            match (side, next) {
                (Side::Neither, _) => side = next,
                (_, Side::Neither) if from < 1.0 && to >= 1.0 => {
                    return Some(Change { share: 1.0, lands: true });
                }
                (Side::Above, Side::Below) | (Side::Below, Side::Above) => {
                    let onto = if next == Side::Above { 0.5 * band } else { -0.5 * band };
                    let share = self.root(onto, [from, to]);
                    if share > AT_START {
                        return Some(Change { share, lands: false });
                    }
                    side = next;
                }
                _ => {}
            }
            from = to;
        }
        None
    }

    /// Ends of the pieces on which the cubic is monotone: its extrema, the end of the step, and the end of the range beyond it.
    fn pieces(&self) -> [f64; 4] {
        let last = 1.0 + BEYOND;
        let ([g0, g1], [d0, d1]) = (self.values, self.slopes);
        // dg/dr = c + 2 b r + a r^2
        let (a, b) = (3.0 * (2.0 * (g0 - g1) + d0 + d1), 3.0 * (g1 - g0) - 2.0 * d0 - d1);
        let root = Real::sqrt(b * b - a * d0);
        let sum = if b < 0.0 { root - b } else { -root - b };
        // Extrema outside the range, and NaN, end no piece.
        let within = |r: f64| if r > 0.0 && r < last { r } else { last };
        let mut ends = [within(sum / a), within(d0 / sum), 1.0, last];
        ends.sort_unstable_by(f64::total_cmp);
        ends
    }
}

/// Fraction of a step at which a gap changes its sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Fraction of the step at the change.
    pub share: f64,
    /// True if the change is at the end of the step: the value at the end is within the band.
    pub lands: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Above,
    Neither,
    Below,
}

impl Side {
    fn of(value: f64, band: f64) -> Self {
        if value > band {
            Self::Above
        } else if value < -band {
            Self::Below
        } else {
            Self::Neither
        }
    }
}
