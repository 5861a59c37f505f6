//! Lines over points of links. The module computes lengths and gradients of their parts, and finds parts that collapse to zero length.

use crate::link::LinkMotion;
use crate::link::indexing::{Outside, at, at_mut, range};
use crate::link::plan::Span;
use crate::rows::coupled::{CoupledRow, Couplings, LinePoint, LinkStart, SumMeasure, SumTerm};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::elements::has_collapsed;

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// Calls `take` for each part of a line that has a positive length.
    pub(crate) fn each_part(
        &self,
        (points, starts): (Span, Span),
        placed: &[LinkMotion<T, S>],
        mut take: impl FnMut(LinePart<T, S>) -> Result<(), Outside>,
    ) -> Result<(), Outside> {
        let starts = range(self.starts, starts.range())?;
        let end = |of: &LinePoint<T, S>| {
            let (start, spin, arm, [place, rate]) = line_end(starts, of, placed)?;
            Ok((start, arm, [place, rate, S::centrifugal(&spin, &arm)]))
        };
        for pair in range(self.points, points.range())?.windows(2) {
            let [first, second] = pair else { continue };
            let ((from, arm, a), (to, arm_to, b)) = (end(first)?, end(second)?);
            let gap = b[0] - a[0];
            let length = gap.dot(&gap).sqrt();
            if length > T::ZERO {
                take(LinePart {
                    ends: [(from, arm), (to, arm_to)],
                    direction: gap * (T::ONE / length),
                    length,
                    rate: b[1] - a[1],
                    bias: b[2] - a[2],
                })?;
            }
        }
        Ok(())
    }

    /// Adds the gradient of a line, multiplied by the slope of its term, to row `k` of `n_rows`.
    #[inline(always)]
    pub(crate) fn add_gradient(
        &self,
        (term, starts, slope): (&SumTerm<T>, Span, T),
        (k, n_rows): (usize, usize),
        placed: &[LinkMotion<T, S>],
        gradient: &mut [S::Motion],
    ) -> Result<(), Outside> {
        let SumMeasure::Line { points, .. } = term.of else { return Ok(()) };
        self.each_part((points, starts), placed, |part| {
            for ((start, arm), n) in part.ends.iter().zip([-part.direction, part.direction]) {
                let place = start.side as usize * n_rows + k;
                *at_mut(gradient, place)? += S::wrench(arm, &n) * slope;
            }
            Ok(())
        })
    }

    /// Finds the part of a row's lines whose length became zero, or whose ends passed each other, between two configurations.
    pub(crate) fn collapsed(
        &self,
        row: &CoupledRow<T>,
        [from, to]: [&[LinkMotion<T, S>]; 2],
    ) -> Result<Option<usize>, Outside> {
        let starts = range(self.starts, row.starts.range())?;
        if starts.is_empty() {
            return Ok(None);
        }
        let mut part = 0;
        for term in range(self.terms, row.terms.range())? {
            let SumMeasure::Line { points, .. } = term.of else { continue };
            for pair in range(self.points, points.range())?.windows(2) {
                let [first, second] = pair else { continue };
                let gap = |placed| {
                    let [(_, _, _, [a, rate_a]), (_, _, _, [b, rate_b])] =
                        [line_end(starts, first, placed)?, line_end(starts, second, placed)?];
                    Ok([b - a, rate_b - rate_a])
                };
                let ([before, rate], [after, _]) = (gap(from)?, gap(to)?);
                let (dd, de, ee) = (before.dot(&before), before.dot(&after), after.dot(&after));
                if has_collapsed([dd, de, ee, before.dot(&rate)]) {
                    return Ok(Some(part));
                }
                part += 1;
            }
        }
        Ok(None)
    }
}

/// End of a part of a line: link, angular velocity of the link, vector from the link's origin to the point, and place and velocity of the
/// point.
type LineEnd<T, S> =
    (LinkStart, <S as Space<T>>::Spin, <S as Space<T>>::Point, [<S as Space<T>>::Point; 2]);

/// Evaluates a point of a line at an instant.
fn line_end<T: Real, S: Space<T>>(
    starts: &[LinkStart],
    of: &LinePoint<T, S>,
    placed: &[LinkMotion<T, S>],
) -> Result<LineEnd<T, S>, Outside> {
    let start = *at(starts, of.start as usize)?;
    let p = at(placed, start.link as usize)?;
    let arm = S::rotate(&p.rotation, &of.point);
    let spin = S::spin(&p.velocity);
    let rate = S::point(&p.velocity) + S::cross(&spin, &arm);
    Ok((start, spin, arm, [p.position + arm, rate]))
}

/// A part of a line: the segment between two adjacent points.
pub(crate) struct LinePart<T: Real, S: Space<T>> {
    /// Links at both ends, each with the vector from the link's origin to the point.
    pub(crate) ends: [(LinkStart, S::Point); 2],
    /// Unit vector from the first end to the second.
    pub(crate) direction: S::Point,
    pub(crate) length: T,
    /// Velocity of the second end minus the velocity of the first end [m/s].
    pub(crate) rate: S::Point,
    /// Acceleration of the second end minus the acceleration of the first end, for zero accelerations of the links [m/s^2].
    pub(crate) bias: S::Point,
}
