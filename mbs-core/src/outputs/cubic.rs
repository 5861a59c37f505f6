//! The cubic through value and rate at both ends of a step: where within the step it is zero, and changes sides.
//!
//! ```text
//! g(t0 + r h) = g0 H00 + h g0' H10 + g1 H01 + h g1' H11,   H00 = (1 + 2r)(1 - r)^2,  H10 = r (1 - r)^2,
//!                                                           H01 = r^2 (3 - 2r),       H11 = r^2 (r - 1)
//! ```
//!
//! Where it changes sides is asked with a band about zero, in which it is on neither. So a step that starts in the band, where
//! the last one has landed, leaves it to either side without a change. A touch that stays in the band is none.

use super::load::Gap;
use crate::Real;

/// A cubic over the share r of a step.
#[derive(Debug, Clone, Copy)]
pub struct Cubic {
    /// Values at both ends.
    values: [f64; 2],
    /// Derivatives by r at both ends.
    slopes: [f64; 2],
}

/// Bisections of a root [-]: to 1e-16 of the step.
const HALVINGS: u32 = 53;

/// Fraction of a step beyond its end in which a change is found [-]: a longer trial ends there, and no tiny step follows. Chosen, not tuned.
const BEYOND: f64 = 0.05;

/// Fraction of a step before which a change is one of its start [-]. A kink of a force at r leaves 4 r (1 - r) of the largest error:
/// here less than half a percent.
pub const AT_START: f64 = 1e-3;

impl Cubic {
    /// Through the gaps at both ends of a step of length `h` [s].
    pub fn new<T: Real>(gaps: [Gap<T>; 2], h: f64) -> Self {
        let values = gaps.map(|gap| gap.value.to_f64());
        Self { values, slopes: gaps.map(|gap| h * gap.rate.to_f64()) }
    }

    fn at(&self, r: f64) -> f64 {
        let ([g0, g1], [d0, d1]) = (self.values, self.slopes);
        let s = 1.0 - r;
        (g0 * (1.0 + 2.0 * r) + d0 * r) * s * s + (g1 * (3.0 - 2.0 * r) - d1 * s) * r * r
    }

    /// Share at which the cubic is `level`, between two shares at which it is on different sides of it.
    ///
    /// Bisection needs no care where the cubic is flat, and roots are asked for rarely.
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

    /// The first share, from [`AT_START`] to [`BEYOND`] the end, at which it comes to the other side of zero by half the band.
    ///
    /// Cost: some eighty operations where nothing changes, and a bisection where it does.
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

    /// The ends of the pieces between which it only rises or only falls: its turns, the step's end, and beyond it.
    fn pieces(&self) -> [f64; 4] {
        let last = 1.0 + BEYOND;
        let ([g0, g1], [d0, d1]) = (self.values, self.slopes);
        // dg/dr = c + 2 b r + a r^2
        let (a, b) = (3.0 * (2.0 * (g0 - g1) + d0 + d1), 3.0 * (g1 - g0) - 2.0 * d0 - d1);
        let root = Real::sqrt(b * b - a * d0);
        let sum = if b < 0.0 { root - b } else { -root - b };
        // Turns elsewhere, and what is no number, end no piece.
        let within = |r: f64| if r > 0.0 && r < last { r } else { last };
        let mut ends = [within(sum / a), within(d0 / sum), 1.0, last];
        ends.sort_unstable_by(f64::total_cmp);
        ends
    }
}

/// Place within a step at which a gap comes to its other side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Share of the step.
    pub share: f64,
    /// Is it the step's end, and near enough?
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
