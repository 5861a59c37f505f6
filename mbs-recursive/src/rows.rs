//! The equations of cut joints, in terms of the motions of their two bodies.
//!
//! ```text
//! Φ̇ = K₁ V₁ + K₂ V₂,   Φ̈ = K₁ a₁ + K₂ a₂ + bias      a = (ω', v') of the links' origins     [P3 (40)–(41)]
//!
//! g: from the first body's point (at s₁ from its origin) to the second's (at s₂), d, x in the first body, y in the second
//! coincidence   g·e            e a world axis     K₂ = (s₂ × e, e),  K₁ = −(s₁ × e, e)
//! gap           g·d − const                       K₂ = (s₂ × d, d),  K₁ = −((s₁ + g) × d, d)
//! dot           x·y − const                       K₁ = (x × y, 0),   K₂ = −K₁
//! length        (g·g − L²)/(2L)                   K₂ = (s₂ × g, g)/L,  K₁ = −(s₁ × g, g)/L
//! ```

use crate::link::Placed;
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// One equation of a cut joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Row<T: Real, S: Space<T>> {
    /// The points coincide along a world axis.
    Coincidence {
        /// Number of the axis.
        axis: u32,
    },
    /// The gap keeps its part along a direction of the first body.
    Gap {
        /// Unit direction, reference axes.
        direction: S::Point,
        /// What it keeps [m].
        constant: T,
    },
    /// Two directions keep their angle.
    Dot {
        /// In the first body, reference axes.
        x: S::Point,
        /// In the second body, reference axes.
        y: S::Point,
        /// Cosine of the angle.
        constant: T,
    },
    /// The points keep their distance.
    Length {
        /// The distance [m].
        length: T,
    },
}

impl<T: Real, S: Space<T>> Row<T, S> {
    /// Is its value an angle (otherwise a length)?
    #[must_use]
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Dot { .. })
    }
}

/// A cut joint: a loop of the mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loop<T: Real, S: Space<T>> {
    /// Links of its first and second body.
    pub links: [u32; 2],
    /// Its point on each, from the link's origin, reference axes [m].
    pub points: [S::Point; 2],
    /// First of its rows.
    pub first: u32,
    /// Number of its rows.
    pub n: u32,
    /// The link nearest to both bodies from which both hang: the rows are eliminated there.
    pub ancestor: u32,
    /// Place of its block of Λ.
    pub block: u32,
    /// Index of the joint in the scene.
    pub joint: u32,
}

/// What an equation is at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowValue<T: Real, S: Space<T>> {
    /// K₁, K₂.
    pub gradient: [S::Motion; 2],
    /// Φ [m or rad].
    pub value: T,
    /// Φ̇.
    pub rate: T,
    /// Φ̈ without accelerations.
    pub bias: T,
}

impl<T: Real, S: Space<T>> Loop<T, S> {
    /// Evaluates the loop's rows and hands them out in order.
    #[inline(always)]
    pub fn evaluate(
        &self,
        rows: &[Row<T, S>],
        placed: &[Placed<T, S>],
        mut take: impl FnMut(usize, RowValue<T, S>),
    ) {
        let bodies = self.links.map(|i| &placed[i as usize]);
        let [a, b] = bodies;
        let arms = [0, 1].map(|i| S::rotate(&bodies[i].rotation, &self.points[i]));
        let spins = bodies.map(|p| S::spin(&p.velocity));
        let speed = |i: usize| S::point(&bodies[i].velocity) + S::cross(&spins[i], &arms[i]);
        let pull = |i: usize| S::centrifugal(&spins[i], &arms[i]);
        let gap = (b.position + arms[1]) - (a.position + arms[0]);
        let gap_rate = speed(1) - speed(0);
        let gap_bias = pull(1) - pull(0);
        let first = self.first as usize;
        for k in first..first + self.n as usize {
            let (value, bias, gradient) = match &rows[k] {
                Row::Coincidence { axis } => {
                    let axis = *axis as usize;
                    let mut e = S::Point::zero();
                    e[axis] = T::ONE;
                    let gradient = [-S::wrench(&arms[0], &e), S::wrench(&arms[1], &e)];
                    (gap[axis], gap_bias[axis], gradient)
                }
                Row::Gap { direction, constant } => {
                    // Φ̈: g̈·d + 2 ġ·ḋ + g·d̈
                    let d = S::rotate(&a.rotation, direction);
                    let turning = S::cross(&spins[0], &d);
                    let bias = gap_bias.dot(&d)
                        + T::TWO * gap_rate.dot(&turning)
                        + gap.dot(&S::centrifugal(&spins[0], &d));
                    let gradient = [-S::wrench(&(arms[0] + gap), &d), S::wrench(&arms[1], &d)];
                    (gap.dot(&d) - *constant, bias, gradient)
                }
                Row::Dot { x, y, constant } => {
                    // Φ̈: ẍ·y + 2 ẋ·ẏ + x·ÿ
                    let (x, y) = (S::rotate(&a.rotation, x), S::rotate(&b.rotation, y));
                    let bias = S::centrifugal(&spins[0], &x).dot(&y)
                        + T::TWO * S::cross(&spins[0], &x).dot(&S::cross(&spins[1], &y))
                        + x.dot(&S::centrifugal(&spins[1], &y));
                    let turn = S::motion(S::moment(&x, &y), S::Point::zero());
                    (x.dot(&y) - *constant, bias, [turn, -turn])
                }
                Row::Length { length } => {
                    let inverse = T::ONE / *length;
                    let d = gap * inverse;
                    let value = (gap.dot(&gap) - *length * *length) * T::HALF * inverse;
                    let bias = gap_rate.dot(&gap_rate) * inverse + d.dot(&gap_bias);
                    (value, bias, [-S::wrench(&arms[0], &d), S::wrench(&arms[1], &d)])
                }
            };
            let rate = gradient[0].dot(&a.velocity) + gradient[1].dot(&b.velocity);
            take(k, RowValue { gradient, value, rate, bias });
        }
    }
}
