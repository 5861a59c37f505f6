//! Couplings: rows over joint coordinates and lengths, such as gears, racks, cams and ropes.
//!
//! ```text
//! Φ = (Σ cₖ fₖ(mₖ) − s(t)) / c          c: the largest |cₖ|
//! Φ̇ = Σ gᵢ żᵢ + Σ K V,   Φ̈ = Σ gᵢ z̈ᵢ + Σ K a + bias
//!
//! joint coordinate    m = z                  g = c f',   bias = c f'' ż²;  a guided joint: bias + c f' z̈
//! relation            φ(c₁ m₁ .. cₙ mₙ) in place of the sum: related.rs
//! line over points    m = Σ |d| − L          n = d/|d|,   K = (s × n, n) at the end of a part, its opposite at the beginning
//!                                            bias = Σ (n·s̈ + (ḋ·ḋ − (n·ḋ)²)/|d|)
//! ```

use crate::link::curves::{self, CurveTable};
use crate::link::indexing::{Outside, at, at_mut, range};
use crate::link::plan::Span;
use crate::link::{Link, LinkMotion};
use crate::space::{Numbers, Space};
use mbs_core::Real;
pub use mbs_core::elements::NONE;

/// Are couplings in this build?
pub const IS_BUILT: bool = cfg!(feature = "couplings");
/// Are lines over points of links in this build?
pub const HAS_LINES: bool = cfg!(feature = "lines");
/// Are angles of balls in this build? Tables for controllers have none.
pub(crate) const HAS_BALL_ANGLES: bool = cfg!(feature = "alloc");

/// The row of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledRow<T> {
    /// Terms of the row.
    pub terms: Span,
    /// The links on which its lines have points.
    pub starts: Span,
    /// Number of the guide that is its sum; [`NONE`]: it is zero.
    pub guide: u32,
    /// Part of the sum beside the guide, over the largest factor: what a guide adds to its law where it is exported.
    pub value: T,
    /// One over the largest factor: the sum is divided by it.
    pub inverse: T,
    /// Is its value an angle (otherwise a length)?
    pub is_angle: bool,
}

/// A term of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SumTerm<T> {
    /// Factor of the term over the largest one.
    pub factor: T,
    /// Number of the term's curve; [`NONE`]: the measured number itself.
    pub curve: u32,
    /// Measure that the term is a function of.
    pub of: SumMeasure<T>,
}

impl<T: Real> SumTerm<T> {
    /// Returns the growth of the term by its coordinate; that of a curve was noted when the term, number `i` of all, was evaluated.
    #[inline(always)]
    fn slope(&self, i: usize, slopes: &[T]) -> Result<T, Outside> {
        if self.has_curve() { at(slopes, i).copied() } else { Ok(self.factor) }
    }

    /// Has it a curve? In a build without curves no model has one.
    #[inline(always)]
    fn has_curve(&self) -> bool {
        curves::IS_BUILT && self.curve != NONE
    }
}

/// A number that a coupling measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SumMeasure<T> {
    /// The coordinate of a link whose joint has one freedom, or is guided.
    Joint {
        /// Number of the link.
        link: u32,
        /// The side by which its part of the row travels inward; [`NONE`]: its joint is guided.
        side: u32,
    },
    /// The length of a line, less that in the reference configuration.
    Line {
        /// Points of the line.
        points: Span,
        /// The length in the reference configuration [m].
        reference: T,
    },
    /// The swing of a ball: the angle between a direction of one link and one of another.
    Swing {
        /// The directions, in place of points.
        axes: Span,
    },
    /// The twist of a ball about such directions.
    Twist {
        /// The directions, in place of points.
        axes: Span,
        /// The first of the joint's half angles in z.
        first: u32,
        /// The parent of its link is the joint's second body.
        is_reversed: bool,
    },
}

/// A point of a line, or a direction of a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint<T: Real, S: Space<T>> {
    /// Number of the point's link among those of its row.
    pub start: u32,
    /// The point, from the link's origin, reference axes [m].
    pub point: S::Point,
}

/// A link at which a row begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinkStart {
    /// Number of the link.
    pub link: u32,
    /// The side by which it travels inward.
    pub side: u32,
}

/// Tables that the rows of couplings refer to: constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Couplings<'a, T: Real, S: Space<T>> {
    /// Number of loops that are cut joints; those behind them are couplings. More than there are: all are.
    pub n_cut: u32,
    /// Terms of all rows.
    pub terms: &'a [SumTerm<T>],
    /// Points of lines, and directions of balls.
    pub points: &'a [LinePoint<T, S>],
    /// Links at which the rows of lines and of balls begin.
    pub starts: &'a [LinkStart],
    /// Curves of terms and signals.
    pub curves: &'a [CurveTable<T>],
    /// Knots of splines, each an argument with its value.
    pub knots: &'a [[T; 2]],
    /// Second derivatives of splines at their knots, and coefficients of polynomials.
    pub numbers: &'a [T],
    /// Codes of the user-defined relations.
    #[cfg(feature = "alloc")]
    pub relations: Option<&'a mbs_core::laws::code::Codes>,
}

/// A mechanism at an instant: its links and where they are, and its coordinates, velocities and guides.
pub(crate) type Here<'a, T, S> =
    (&'a [Link<T, S>], &'a [LinkMotion<T, S>], (&'a [T], &'a [T], &'a [[T; 3]]));

/// The gradients of all rows: K of all sides, those of the first in front; and the slope of each term that has a curve.
pub(crate) type Gradients<'a, T, S> = (&'a mut [<S as Space<T>>::Motion], &'a mut [T]);

/// Value of the row of a coupling at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoupledValue<T> {
    /// Φ, Φ̇, and Φ̈ without accelerations.
    pub(crate) row: [T; 3],
    /// The sizes of the parts of Φ and of Φ̇.
    pub(crate) parts: [T; 2],
}

impl<T: Real> CoupledValue<T> {
    /// Returns the value of a row without terms.
    pub(crate) const fn zero() -> Self {
        Self { row: [T::ZERO; 3], parts: [T::ZERO; 2] }
    }

    /// Adds what a term or a guide gives, and the size of what its rate is made of.
    #[inline(always)]
    pub(crate) fn add(&mut self, x: [T; 3], speed: T) {
        self.row.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
        self.parts = [self.parts[0] + x[0].abs(), self.parts[1] + speed.abs()];
    }
}

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// Couplings of a mechanism that has none.
    #[must_use]
    pub const fn none() -> Self {
        Self {
            n_cut: u32::MAX,
            terms: &[],
            points: &[],
            starts: &[],
            curves: &[],
            knots: &[],
            numbers: &[],
            #[cfg(feature = "alloc")]
            relations: None,
        }
    }

    /// f, f' and f'' of a term's curve.
    pub(crate) fn function(&self, curve: u32, x: T) -> Result<[T; 3], Outside> {
        curves::function((self.curves, self.knots, self.numbers), curve, x)
    }

    /// Returns the number of slopes that an evaluation remembers: one for each term up to the last that has a curve.
    #[must_use]
    pub fn n_slopes(&self) -> usize {
        let last = self.terms.iter().rposition(|term| term.curve != NONE);
        last.map_or(0, |last| last + 1)
    }

    /// Value, rate and the part of the acceleration that is known, of what a term measures; and the size of what the rate is made of.
    pub(crate) fn measure(
        &self,
        (of, starts): (&SumMeasure<T>, Span),
        here: Here<'_, T, S>,
    ) -> Result<([T; 3], T), Outside> {
        match *of {
            SumMeasure::Joint { link, .. } => {
                let (links, _, coordinates) = here;
                let numbers = at(links, link as usize)?.coordinate(coordinates)?;
                Ok((numbers, numbers[1].abs()))
            }
            SumMeasure::Line { points, reference } if HAS_LINES => {
                // ends that move across their part cancel in its rate
                let (mut sum, mut speed) = ([-reference, T::ZERO, T::ZERO], T::ZERO);
                self.each_part((points, starts), here.1, |part| {
                    let along = part.direction.dot(&part.rate);
                    let turning = (part.rate.dot(&part.rate) - along * along) / part.length;
                    let known = [part.length, along, part.direction.dot(&part.bias) + turning];
                    sum.iter_mut().zip(known).for_each(|(sum, x)| *sum += x);
                    speed += part.rate.dot(&part.rate).sqrt();
                    Ok(())
                })?;
                Ok((sum, speed))
            }
            SumMeasure::Swing { axes } | SumMeasure::Twist { axes, .. } if HAS_BALL_ANGLES => {
                let numbers = self.ball_angle((of, axes, starts), here)?;
                Ok(([numbers[0], numbers[1], T::ZERO], numbers[1].abs()))
            }
            // Not in this build: a model with one is not loaded.
            _ => Err(Outside),
        }
    }

    /// Evaluates row `k` of a coupling; its gradients are written where they are wanted, of `n_rows` rows.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        place: (&CoupledRow<T>, usize, usize),
        here: Here<'_, T, S>,
        out: Option<Gradients<'_, T, S>>,
    ) -> Result<CoupledValue<T>, Outside> {
        let row = place.0;
        let mut sum = match self.of_joints(row, here)? {
            Some(sum) => sum,
            #[cfg(feature = "alloc")]
            None if self.is_related(row) => self.of_relation(place, here, out)?,
            None if curves::IS_BUILT || HAS_LINES => self.of_terms(place, here, out)?,
            // Not in this build: a model with one is not loaded.
            None => return Err(Outside),
        };
        sum.add([-row.value, T::ZERO, T::ZERO], T::ZERO);
        if row.guide != NONE {
            let (_, _, (_, _, guides)) = here;
            let guided = at(guides, row.guide as usize)?.map(|s| -s * row.inverse);
            sum.add(guided, guided[1]);
        }
        Ok(sum)
    }

    /// The terms of a row, where they are coordinates without curves; `None`: others are among them. Such a row has no gradients that change.
    #[inline(always)]
    fn of_joints(
        &self,
        row: &CoupledRow<T>,
        (links, _, coordinates): Here<'_, T, S>,
    ) -> Result<Option<CoupledValue<T>>, Outside> {
        let mut sum = CoupledValue::zero();
        for term in range(self.terms, row.terms.range())? {
            let (SumMeasure::Joint { link, .. }, NONE) = (term.of, term.curve) else {
                return Ok(None);
            };
            let numbers = at(links, link as usize)?.coordinate(coordinates)?;
            let x = numbers.map(|x| term.factor * x);
            sum.add(x, x[1]);
        }
        Ok(Some(sum))
    }

    /// The terms of any row.
    #[inline(never)]
    fn of_terms(
        &self,
        (row, k, n_rows): (&CoupledRow<T>, usize, usize),
        here: Here<'_, T, S>,
        mut out: Option<Gradients<'_, T, S>>,
    ) -> Result<CoupledValue<T>, Outside> {
        let mut sum = CoupledValue::zero();
        if let Some((gradient, _)) = &mut out {
            gradient.iter_mut().skip(k).step_by(n_rows.max(1)).for_each(|k| *k = S::Motion::zero());
        }
        for (i, term) in row.terms.range().zip(range(self.terms, row.terms.range())?) {
            let ([m, rate, known], speed) = self.measure((&term.of, row.starts), here)?;
            let identity = [m, T::ONE, T::ZERO];
            let [f, slope, bend] =
                if term.has_curve() { self.function(term.curve, m)? } else { identity };
            let (value, slope) = (term.factor * f, term.factor * slope);
            let bias = slope * known + term.factor * bend * rate * rate;
            sum.add([value, slope * rate, bias], slope * speed);
            let Some((gradient, slopes)) = &mut out else { continue };
            if term.has_curve() {
                *at_mut(slopes, i)? = slope;
            }
            self.add_gradient((term, row.starts, slope), (k, n_rows), here.1, gradient)?;
        }
        Ok(sum)
    }

    /// Hands out the ends that a row has, without guides: at joints with their slopes, and at links with wrenches.
    pub(crate) fn each_end(
        &self,
        row: &CoupledRow<T>,
        here: Here<'_, T, S>,
        mut take: impl FnMut(SumEnd<T, S>) -> Result<(), Outside>,
    ) -> Result<(), Outside> {
        for term in range(self.terms, row.terms.range())? {
            let mut slope = term.factor;
            if term.has_curve() {
                let ([m, ..], _) = self.measure((&term.of, row.starts), here)?;
                slope *= self.function(term.curve, m)?[1];
            }
            match term.of {
                SumMeasure::Joint { link, .. } => take(SumEnd::Joint { link, slope })?,
                SumMeasure::Swing { axes } | SumMeasure::Twist { axes, .. } if HAS_BALL_ANGLES => {
                    let (links, g) = self.ball_wrench((&term.of, axes, row.starts), here.1)?;
                    take(SumEnd::Link { link: links[0], wrench: g * -slope })?;
                    take(SumEnd::Link { link: links[1], wrench: g * slope })?;
                }
                SumMeasure::Line { points, .. } if HAS_LINES => {
                    self.each_part((points, row.starts), here.1, |part| {
                        let directions = [-part.direction, part.direction];
                        for ((start, arm), n) in part.ends.iter().zip(directions) {
                            let wrench = S::wrench(arm, &n) * slope;
                            take(SumEnd::Link { link: start.link, wrench })?;
                        }
                        Ok(())
                    })?;
                }
                // Not in this build: a model with one is not loaded.
                _ => return Err(Outside),
            }
        }
        Ok(())
    }

    /// The links at which a row begins.
    pub(crate) fn starts_of(&self, row: &CoupledRow<T>) -> Result<&[LinkStart], Outside> {
        if HAS_LINES { range(self.starts, row.starts.range()) } else { Ok(&[]) }
    }

    /// The links whose coordinates a row has: each with the side by which it travels inward, and g.
    pub(crate) fn joints_of<'s>(
        &'s self,
        row: &CoupledRow<T>,
        slopes: &'s [T],
    ) -> Result<impl Iterator<Item = (u32, u32, T)> + 's, Outside> {
        let terms = row.terms.range().zip(range(self.terms, row.terms.range())?);
        Ok(terms.filter_map(|(i, term)| {
            let SumMeasure::Joint { link, side } = term.of else { return None };
            Some((link, side, term.slope(i, slopes).ok()?))
        }))
    }

    /// Σ K a + Σ g x of row `k` for motions `a` of the links and `x` of the freedoms, and the size of its parts.
    #[inline(always)]
    pub(crate) fn along(
        &self,
        (row, k, n_rows): (&CoupledRow<T>, usize, usize),
        links: &[Link<T, S>],
        (gradient, slopes): (&[S::Motion], &[T]),
        (a, x): (&[S::Motion], &[T]),
    ) -> Result<[T; 2], Outside> {
        let mut sum = [T::ZERO; 2];
        for start in self.starts_of(row)? {
            let k = at(gradient, start.side as usize * n_rows + k)?;
            let a = at(a, start.link as usize)?;
            sum = [sum[0] + k.dot(a), sum[1] + k.parts(a)];
        }
        for (i, term) in row.terms.range().zip(range(self.terms, row.terms.range())?) {
            let SumMeasure::Joint { link, .. } = term.of else { continue };
            let slope = term.slope(i, slopes)?;
            let link = at(links, link as usize)?;
            if !link.kind.is_guided() {
                let x = slope * *at(x, link.v as usize)?;
                sum = [sum[0] + x, sum[1] + x.abs()];
            }
        }
        Ok(sum)
    }

    /// g of the joint of link `i` where a row passes it by this side; zero where it has none.
    #[inline(always)]
    pub(crate) fn slope(
        &self,
        row: &CoupledRow<T>,
        (i, by): (usize, u32),
        slopes: &[T],
    ) -> Result<T, Outside> {
        let mut sum = T::ZERO;
        for (number, term) in row.terms.range().zip(range(self.terms, row.terms.range())?) {
            let SumMeasure::Joint { link, side } = term.of else { continue };
            if link as usize == i && side == by {
                sum += term.slope(number, slopes)?;
            }
        }
        Ok(sum)
    }
}

/// Coordinate or link by whose motion a sum grows, with the growth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SumEnd<T: Real, S: Space<T>> {
    /// The coordinate of a link.
    Joint {
        /// Number of the link.
        link: u32,
        /// The growth by it.
        slope: T,
    },
    /// The motion of a link.
    Link {
        /// Number of the link.
        link: u32,
        /// The growth by it.
        wrench: S::Motion,
    },
}
