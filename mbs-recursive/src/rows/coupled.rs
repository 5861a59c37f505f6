//! Couplings: rows over joint coordinates and lengths, for example of gears, racks, cams and ropes.
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
//!
//! mₖ are the measured numbers of the terms, cₖ their factors and fₖ their curves. s(t) is the value of the guide. gᵢ is the slope of the
//! row by the coordinate zᵢ of a joint. K is the gradient of the row by the motion of a link, which has velocity V and acceleration a. For
//! a line, L is the length in the reference configuration, d the vector along a part, and s the vector from a link's origin to an end of
//! the part.

use crate::link::curves::{self, CurveTable};
use crate::link::indexing::{Outside, at, at_mut, range};
use crate::link::plan::Span;
use crate::link::{Link, LinkMotion};
use crate::space::{Numbers, Space};
use mbs_core::Real;
pub use mbs_core::elements::NONE;

/// True if this build supports couplings.
pub const IS_BUILT: bool = cfg!(feature = "couplings");
/// True if this build supports lines over points of links.
pub const HAS_LINES: bool = cfg!(feature = "lines");
/// True if this build supports angles of ball joints. Tables for controllers have no such angles.
pub(crate) const HAS_BALL_ANGLES: bool = cfg!(feature = "alloc");

/// Data of the row of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoupledRow<T> {
    /// Terms of the row.
    pub terms: Span,
    /// Links that carry points of the row's lines or axes of its ball joints.
    pub starts: Span,
    /// Index of the guide to which the sum is equal; [`NONE`] if the sum is zero.
    pub guide: u32,
    /// Constant that is subtracted from the sum, divided by the largest factor. In an exported model it is the constant part of the guide.
    pub value: T,
    /// Inverse of the largest factor. The sum is multiplied by this number.
    pub inverse: T,
    /// True if the value of the row is an angle; false if it is a length.
    pub is_angle: bool,
}

/// A term of a coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SumTerm<T> {
    /// Factor of the term, divided by the largest factor of the row.
    pub factor: T,
    /// Index of the term's curve; [`NONE`] if the term is the measured number itself.
    pub curve: u32,
    /// Measured number of which the term is a function.
    pub of: SumMeasure<T>,
}

impl<T: Real> SumTerm<T> {
    /// Returns the derivative of term `i` by its measured number. If the term has a curve, the derivative is read from `slopes`, where the
    /// last evaluation stored it.
    #[inline(always)]
    fn slope(&self, i: usize, slopes: &[T]) -> Result<T, Outside> {
        if self.has_curve() { at(slopes, i).copied() } else { Ok(self.factor) }
    }

    /// True if the term has a curve. In a build without curves no term has a curve.
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
        /// Index of the link.
        link: u32,
        /// Index of the side by which this part of the row is carried inward; [`NONE`] if the joint is guided.
        side: u32,
    },
    /// The length of a line minus its length in the reference configuration.
    Line {
        /// Points of the line.
        points: Span,
        /// The length in the reference configuration [m].
        reference: T,
    },
    /// The swing of a ball joint: the angle between a direction of one link and a direction of the other link.
    Swing {
        /// Directions of the ball joint's axes, stored in the list of points.
        axes: Span,
    },
    /// The twist of a ball joint: the angle of rotation about a direction of one link and a direction of the other link.
    Twist {
        /// Directions of the ball joint's axes, stored in the list of points.
        axes: Span,
        /// Index in z at which the joint's quaternion begins.
        first: u32,
        /// True if the parent of the link is the joint's second body.
        is_reversed: bool,
    },
}

/// A point of a line, or a direction of a ball joint's axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint<T: Real, S: Space<T>> {
    /// Index of the point's link in the list of the row's links.
    pub start: u32,
    /// Vector from the link's origin to the point [m], or unit direction, in the axes of the reference configuration.
    pub point: S::Point,
}

/// A link from which a row is carried inward.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinkStart {
    /// Index of the link from which the row is carried inward.
    pub link: u32,
    /// Index of the side by which the row is carried inward from the link.
    pub side: u32,
}

/// Tables for the rows of couplings; they are constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Couplings<'a, T: Real, S: Space<T>> {
    /// Number of loops that belong to cut joints or rollings. All later loops belong to couplings. If this number is larger than the number
    /// of loops, there are no couplings.
    pub n_cut: u32,
    /// Terms of all rows.
    pub terms: &'a [SumTerm<T>],
    /// Points of lines, and directions of ball joints' axes.
    pub points: &'a [LinePoint<T, S>],
    /// Links from which the rows of lines and of angles of ball joints are carried inward.
    pub starts: &'a [LinkStart],
    /// Curves of terms and signals.
    pub curves: &'a [CurveTable<T>],
    /// Knots of all splines. A knot is an argument and the value of the spline at this argument.
    pub knots: &'a [[T; 2]],
    /// Second derivatives of splines at their knots, and coefficients of polynomials.
    pub numbers: &'a [T],
    /// Program code of the user-defined relations.
    #[cfg(feature = "alloc")]
    pub relations: Option<&'a mbs_core::laws::code::Codes>,
}

/// A mechanism at an instant: links, their places and motions, and coordinates, velocities and guides.
pub(crate) type Here<'a, T, S> =
    (&'a [Link<T, S>], &'a [LinkMotion<T, S>], (&'a [T], &'a [T], &'a [[T; 3]]));

/// Gradients of all rows: K of the first sides of all rows, then K of the second sides and so on, and the slopes of terms with curves.
pub(crate) type Gradients<'a, T, S> = (&'a mut [<S as Space<T>>::Motion], &'a mut [T]);

/// Value of the row of a coupling at an instant.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoupledValue<T> {
    /// Value Φ, rate Φ̇, and bias: the part of Φ̈ that remains for zero accelerations.
    pub(crate) row: [T; 3],
    /// Sums of absolute values of the parts of Φ and of Φ̇.
    pub(crate) parts: [T; 2],
}

impl<T: Real> CoupledValue<T> {
    /// Returns the value of a row without terms.
    pub(crate) const fn zero() -> Self {
        Self { row: [T::ZERO; 3], parts: [T::ZERO; 2] }
    }

    /// Adds value, rate and bias of a term or guide. `speed` is the sum of the absolute values of the parts of its rate.
    #[inline(always)]
    pub(crate) fn add(&mut self, x: [T; 3], speed: T) {
        self.row.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
        self.parts = [self.parts[0] + x[0].abs(), self.parts[1] + speed.abs()];
    }
}

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// Returns the tables of a mechanism without couplings.
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

    /// Evaluates f, f' and f'' of a term's curve.
    pub(crate) fn function(&self, curve: u32, x: T) -> Result<[T; 3], Outside> {
        curves::function((self.curves, self.knots, self.numbers), curve, x)
    }

    /// Returns the number of slopes that an evaluation stores: one for each term up to the last term with a curve.
    #[must_use]
    pub fn n_slopes(&self) -> usize {
        let last = self.terms.iter().rposition(|term| term.curve != NONE);
        last.map_or(0, |last| last + 1)
    }

    /// Returns value, rate, and bias of a term's measured number; the bias is the part of the acceleration that remains for zero
    /// accelerations. The last result is the sum of the absolute values of the parts of the rate.
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
                // Parts of a rate may cancel if the ends move across their part of the line, so `speed` sums their absolute values.
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
            // This build does not support the measure. A model with this measure is refused when it is loaded.
            _ => Err(Outside),
        }
    }

    /// Evaluates the row of a coupling, which is row `k` of `n_rows`. If `out` is given, writes the gradients to it.
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
            // This build does not support the row. A model with such a row is refused when it is loaded.
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

    /// Sums the terms of a row if all of them are coordinates without curves; otherwise returns `None`. The gradients of such a row are
    /// constant.
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

    /// Sums the terms of any row, and writes gradients if requested.
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

    /// Calls `take` for each coordinate or link whose motion changes a row's sum, with the derivative of the sum. The row's guide is not
    /// included.
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
                // This build does not support the measure. A model with this measure is refused when it is loaded.
                _ => return Err(Outside),
            }
        }
        Ok(())
    }

    /// Returns the links from which a row is carried inward.
    pub(crate) fn starts_of(&self, row: &CoupledRow<T>) -> Result<&[LinkStart], Outside> {
        if HAS_LINES { range(self.starts, row.starts.range()) } else { Ok(&[]) }
    }

    /// Returns the links whose coordinates are terms of a row. Each link comes with the side by which its term is carried inward, and with
    /// the slope g of the term.
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

    /// Returns Σ K a + Σ g x of row `k` for motions `a` of the links and `x` of the freedoms. The second result is the sum of the absolute
    /// values of all parts.
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

    /// Returns the slope g of a row by the coordinate of link `i`, for one side of the row. It is zero if no term of this side measures the
    /// coordinate.
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

/// Coordinate or link whose motion changes a sum, with the derivative of the sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SumEnd<T: Real, S: Space<T>> {
    /// The coordinate of a link.
    Joint {
        /// Index of the link.
        link: u32,
        /// Derivative of the sum by the coordinate.
        slope: T,
    },
    /// The motion of a link.
    Link {
        /// Index of the link.
        link: u32,
        /// Derivative of the sum by the motion, as a wrench on the link.
        wrench: S::Motion,
    },
}
