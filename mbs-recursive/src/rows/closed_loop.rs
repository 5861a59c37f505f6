//! Equations of cut joints, in terms of the motions of the two bodies.
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
//!
//! K₁ and K₂ are the gradients of an equation Φ by the motions of the first and the second link, whose velocities are V₁ and V₂.

use crate::link::LinkMotion;
use crate::link::indexing::{Outside, at, part};
use crate::rows::{Row, RowValue, rolling};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// A closed loop of the mechanism: a cut joint, a body that rolls on another, or a coupling. The links and points of a coupling are in its
/// row, and are not used here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedLoop<T: Real, S: Space<T>> {
    /// Links of the loop's first and second body.
    pub links: [u32; 2],
    /// Point of the loop on each link: vector from the link's origin, in the axes of the reference configuration [m].
    pub points: [S::Point; 2],
    /// Index of the loop's first row.
    pub first: u32,
    /// Number of the loop's rows.
    pub n: u32,
    /// Nearest common ancestor of both links. The rows are eliminated at this link.
    pub ancestor: u32,
    /// Index of the loop's diagonal block of Λ.
    pub block: u32,
    /// Index of the joint, rolling or coupling in the scene.
    pub joint: u32,
}

impl<T: Real, S: Space<T>> ClosedLoop<T, S> {
    /// Returns the indices of the loop's rows.
    #[inline(always)]
    #[must_use]
    pub fn range(&self) -> core::ops::Range<usize> {
        self.first as usize..self.first as usize + self.n as usize
    }

    /// Evaluates the loop's rows and passes each one to `take`, in order.
    ///
    /// # Errors
    /// [`Outside`] if the tables are inconsistent, or an error of `take`.
    #[inline(always)]
    pub fn evaluate(
        &self,
        rows: &[Row<T, S>],
        placed: &[LinkMotion<T, S>],
        take: impl FnMut(usize, RowValue<T, S>) -> Result<(), Outside>,
    ) -> Result<(), Outside> {
        let [first, second] = self.links;
        let links = [at(placed, first as usize)?, at(placed, second as usize)?];
        let own = part(rows, self.first as usize, self.n as usize)?;
        if rolling::IS_BUILT && own.first().is_some_and(Row::begins_rolling) {
            rolling::evaluate((own, self.first as usize), (links, &self.points), take)
        } else {
            self.evaluate_cut(own, links, take)
        }
    }

    /// Evaluates the rows of a cut joint and passes each one to `give`, in order.
    #[inline(always)]
    fn evaluate_cut(
        &self,
        own: &[Row<T, S>],
        [a, b]: [&LinkMotion<T, S>; 2],
        mut take: impl FnMut(usize, RowValue<T, S>) -> Result<(), Outside>,
    ) -> Result<(), Outside> {
        let arms =
            [S::rotate(&a.rotation, &self.points[0]), S::rotate(&b.rotation, &self.points[1])];
        let spins = [S::spin(&a.velocity), S::spin(&b.velocity)];
        let gap = (b.position + arms[1]) - (a.position + arms[0]);
        let gap_rate = (S::point(&b.velocity) + S::cross(&spins[1], &arms[1]))
            - (S::point(&a.velocity) + S::cross(&spins[0], &arms[0]));
        let gap_bias = S::centrifugal(&spins[1], &arms[1]) - S::centrifugal(&spins[0], &arms[0]);
        let coincidence = |axis: usize| {
            let mut e = S::Point::zero();
            e[axis] = T::ONE;
            let gradient = [-S::wrench(&arms[0], &e), S::wrench(&arms[1], &e)];
            (gap[axis], gap_bias[axis], gradient)
        };
        let mut give = |k: usize, (value, bias, gradient): (T, T, [S::Motion; 2])| {
            let rate = gradient[0].dot(&a.velocity) + gradient[1].dot(&b.velocity);
            take(k, RowValue { gradient, value, rate, bias })
        };
        // Fast path for most loops: with the axes in order, the indices of the axes are constants.
        if own.len() == S::Point::N && own.iter().enumerate().all(|(i, row)| row.is_along(i)) {
            for axis in 0..S::Point::N {
                give(self.first as usize + axis, coincidence(axis))?;
            }
            return Ok(());
        }
        for (k, row) in self.range().zip(own) {
            let (value, bias, gradient) = match row {
                Row::Coincidence { axis } if *axis as usize >= S::Point::N => return Err(Outside),
                Row::Coupled(_) | Row::Height { .. } | Row::NoSlip { .. } | Row::Blade { .. } => {
                    return Err(Outside);
                }
                Row::Coincidence { axis } => coincidence(*axis as usize),
                Row::Gap { direction, constant } => {
                    // bias of Φ̈ from g̈·d + 2 ġ·ḋ + g·d̈
                    let d = S::rotate(&a.rotation, direction);
                    let turning = S::cross(&spins[0], &d);
                    let bias = gap_bias.dot(&d)
                        + T::TWO * gap_rate.dot(&turning)
                        + gap.dot(&S::centrifugal(&spins[0], &d));
                    let gradient = [-S::wrench(&(arms[0] + gap), &d), S::wrench(&arms[1], &d)];
                    (gap.dot(&d) - *constant, bias, gradient)
                }
                Row::Dot { x, y, constant } => {
                    // bias of Φ̈ from ẍ·y + 2 ẋ·ẏ + x·ÿ
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
            give(k, (value, bias, gradient))?;
        }
        Ok(())
    }
}
