//! Angles of a ball joint for effects and couplings, each defined by an axis in each of the two bodies.
//!
//! ```text
//! swing   γ = atan2(|a × b|, a·b)              g = (a × b)/|a × b|, zero without swing
//! twist   τ = 2 atan2(v·a, w)                  g = (a + b)/(1 + a·b)          (w, v) the half angles of the joint
//! rate    g·(ω₂ − ω₁),   wrench g on the second link, −g on the first
//! ```
//!
//! a and b are the unit axes in the first and the second body, in world axes.
//!
//! The sign of the half angles is continuous from step to step. The twist is therefore known up to a whole turn in both directions. Beyond
//! a whole turn it jumps by two turns.

use crate::link::LinkMotion;
use crate::link::indexing::{Outside, at, range};
use crate::link::plan::Span;
use crate::rows::coupled::{CoupledRow, Couplings, Here, LinkStart, NONE, SumMeasure};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross, norm};
use mbs_core::elements::{ball_directions, is_open};

/// Links of a ball joint, and the directions of its axes in world axes.
type Axes<T> = ([u32; 2], [Vector<T, 3>; 2]);

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// Returns the links of a ball joint, and the directions of its axes in world axes.
    fn ball_axes(
        &self,
        (axes, starts): (Span, Span),
        placed: &[LinkMotion<T, S>],
    ) -> Result<Axes<T>, Outside> {
        let starts: &[LinkStart] = range(self.starts, starts.range())?;
        let [first, second] = range(self.points, axes.range())? else { return Err(Outside) };
        let one = |of: &crate::rows::coupled::LinePoint<T, S>| {
            let link = at(starts, of.start as usize)?.link;
            let rotation = &at(placed, link as usize)?.rotation;
            Ok((link, S::point_into(&S::rotate(rotation, &of.point))))
        };
        let ((i, a), (j, b)) = (one(first)?, one(second)?);
        Ok(([i, j], [a, b]))
    }

    /// Returns the direction g of a swing or twist, from the axes a and b of the ball joint.
    fn direction(of: &SumMeasure<T>, [a, b]: &[Vector<T, 3>; 2]) -> Vector<T, 3> {
        let [swing, twist] = ball_directions(a, b);
        if matches!(of, SumMeasure::Twist { .. }) { twist } else { swing }
    }

    /// Returns the swing or twist of a ball joint, and its rate.
    pub(crate) fn ball_angle(
        &self,
        (of, axes, starts): (&SumMeasure<T>, Span, Span),
        (_, placed, (z, ..)): Here<'_, T, S>,
    ) -> Result<[T; 2], Outside> {
        let (links, axes) = self.ball_axes((axes, starts), placed)?;
        let spin = |link: u32| Ok(S::spin_into(&S::spin(&at(placed, link as usize)?.velocity)));
        let turning: Vector<T, 3> = spin(links[1])? - spin(links[0])?;
        let rate = Self::direction(of, &axes).dot(&turning);
        let [a, b] = axes;
        let value = match of {
            SumMeasure::Twist { axes, first, is_reversed, .. } => {
                self.twist((*axes, *first, *is_reversed), z)?
            }
            _ => norm(&cross(&a, &b)).atan2(a.dot(&b)),
        };
        Ok([value, rate])
    }

    /// Returns the twist from the joint's quaternion, which begins at index `first` in z.
    fn twist(&self, (axes, first, is_reversed): (Span, u32, bool), z: &[T]) -> Result<T, Outside> {
        let axis = range(self.points, axes.range())?.first().ok_or(Outside)?;
        let axis = S::point_into(&axis.point);
        let half = |i: usize| at(z, first as usize + i).copied();
        let along = axis[0] * half(1)? + axis[1] * half(2)? + axis[2] * half(3)?;
        let twist = T::TWO * along.atan2(half(0)?);
        Ok(if is_reversed { -twist } else { twist })
    }

    /// Returns the links of a ball joint, and the wrench g of its angle on the second link.
    pub(crate) fn ball_wrench(
        &self,
        (of, axes, starts): (&SumMeasure<T>, Span, Span),
        placed: &[LinkMotion<T, S>],
    ) -> Result<([u32; 2], S::Motion), Outside> {
        let (links, axes) = self.ball_axes((axes, starts), placed)?;
        let g = S::spin_from(&Self::direction(of, &axes));
        Ok((links, S::motion(g, crate::space::Numbers::zero())))
    }

    /// True if a twist of the row is undefined, because the axes of its ball joint are opposite at these places.
    pub(crate) fn has_open_twist(
        &self,
        row: &CoupledRow<T>,
        placed: &[LinkMotion<T, S>],
    ) -> Result<bool, Outside> {
        for term in range(self.terms, row.terms.range())? {
            let SumMeasure::Twist { axes, .. } = term.of else { continue };
            let (_, [a, b]) = self.ball_axes((axes, row.starts), placed)?;
            if is_open(T::ONE + a.dot(&b)) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns the amount that must be added to a row's sum because twists have jumped by two turns between two states. `None` if the row
    /// is not linear in such a twist.
    pub(crate) fn lost_twist(
        &self,
        row: &CoupledRow<T>,
        [from, to]: [&[T]; 2],
    ) -> Result<Option<T>, Outside> {
        let whole = T::from_f64(4.0) * T::PI;
        let mut lost = T::ZERO;
        for term in range(self.terms, row.terms.range())? {
            let SumMeasure::Twist { axes, first, is_reversed, .. } = term.of else { continue };
            let of = (axes, first, is_reversed);
            let change = self.twist(of, to)? - self.twist(of, from)?;
            if change.abs() > T::TWO * T::PI {
                if term.curve != NONE {
                    return Ok(None);
                }
                lost += if change > T::ZERO { -whole } else { whole } * term.factor;
            }
        }
        Ok(Some(lost))
    }
}
