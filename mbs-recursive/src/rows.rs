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

use crate::coupled::CoupledRow;
use crate::indexing::{Outside, at, part};
use crate::link::LinkMotion;
use crate::rolling;
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
    /// The lowest point of a disc or ball stays on a plane of the second body: the first row of a body that rolls.
    Height {
        /// The radius [m].
        radius: T,
        /// The disc's unit axis, reference axes of the first body; of a ball, and in the plane, zero.
        axis: S::Point,
        /// The plane's unit normal, reference axes of the second body.
        normal: S::Point,
    },
    /// It does not slip along a direction of the second body: a row of velocities.
    NoSlip {
        /// Unit direction, reference axes.
        direction: S::Point,
    },
    /// A point does not move across a blade: a row of velocities.
    Blade {
        /// The unit direction along which it may move, reference axes of the first body.
        direction: S::Point,
        /// The plane's unit normal, reference axes of the second body; in the plane not used.
        normal: S::Point,
    },
    /// A coupling, which is a loop of one row.
    Coupled(CoupledRow<T>),
}

impl<T: Real, S: Space<T>> Row<T, S> {
    /// Is its value an angle (otherwise a length)?
    #[must_use]
    pub fn is_angle(&self) -> bool {
        match self {
            Self::Coupled(row) => row.is_angle,
            _ => self.is_cut_angle(),
        }
    }

    /// Is it the first row of a rolling?
    #[must_use]
    pub fn begins_rolling(&self) -> bool {
        matches!(self, Self::Height { .. } | Self::Blade { .. })
    }

    /// Is it the equation of a cut joint, and its value an angle?
    pub(crate) fn is_cut_angle(&self) -> bool {
        matches!(self, Self::Dot { .. })
    }

    /// Does it hold points together along this world axis?
    fn is_along(&self, world_axis: usize) -> bool {
        matches!(self, Self::Coincidence { axis } if *axis as usize == world_axis)
    }
}

/// A cut joint, which is a loop of the mechanism; a body that rolls on another; or a coupling, whose links and points are those of its row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedLoop<T: Real, S: Space<T>> {
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
    /// Index of the joint, rolling or coupling in the scene.
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

impl<T: Real, S: Space<T>> ClosedLoop<T, S> {
    /// The numbers of its rows.
    #[inline(always)]
    #[must_use]
    pub fn range(&self) -> core::ops::Range<usize> {
        self.first as usize..self.first as usize + self.n as usize
    }

    /// Evaluates the loop's rows and hands them out in order.
    ///
    /// # Errors
    /// [`Outside`] if the tables do not fit each other, or what `take` says.
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

    /// The same of the rows of a cut joint.
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
        // Most loops: the axes one after the other, so that their numbers are constants.
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
            give(k, (value, bias, gradient))?;
        }
        Ok(())
    }
}
