//! Check of couplings and sums: their terms, the points and links of their lines, and their curves.

use super::{Look, ends_by, ensure, fault, is_within, sides};
use crate::check::LoadError;
use mbs_core::Real;
use mbs_recursive::link::curves::CurveTable;
use mbs_recursive::link::plan::Span;
use mbs_recursive::loads::SumLoad;
use mbs_recursive::rows::closed_loop::ClosedLoop;
use mbs_recursive::rows::coupled::{CoupledRow, LinkStart, NONE, SumMeasure};
use mbs_recursive::space::Space;

impl<T: Real, S: Space<T>> Look<'_, '_, T, S> {
    /// Checks the row of a coupling.
    pub(super) fn coupling(
        &self,
        (i, lap): (usize, &ClosedLoop<T, S>),
        row: &CoupledRow<T>,
    ) -> Result<(), LoadError> {
        let is_known = row.guide == NONE || (row.guide as usize) < self.sizes.guides;
        ensure(is_known && lap.n == 1, "loops", i)?;
        self.terms(("loops", i), (row.terms, row.starts), fault("loops", i))
    }

    /// Checks an effect on a sum.
    pub(super) fn sum(&self, (i, sum): (usize, &SumLoad<T>)) -> Result<(), LoadError> {
        self.terms(("effects", i), (sum.terms, sum.starts), LoadError::Sum { entry: i })?;
        ensure(sum.law.fits(&self.m.tables, self.sizes.courses), "effects", i)
    }

    /// Checks terms and the links of their lines. `on_ball` is the error for a term that measures an angle of a ball joint.
    fn terms(
        &self,
        (table, i): (&'static str, usize),
        (terms, starts): (Span, Span),
        on_ball: LoadError,
    ) -> Result<(), LoadError> {
        let couplings = &self.m.loops.couplings;
        let terms = couplings.terms.get(terms.range()).unwrap_or(&[]);
        ensure(!terms.is_empty(), table, i)?;
        let starts = couplings.starts.get(starts.range());
        let starts = starts.ok_or(fault(table, i))?;
        for term in terms {
            let holds = match term.of {
                SumMeasure::Joint { link, side } => {
                    self.has_one(link).is_some_and(|is_guided| !is_guided || side == NONE)
                }
                SumMeasure::Line { points, .. } => {
                    couplings.points.get(points.range()).is_some_and(|points| {
                        points.len() > 1
                            && points.iter().all(|point| (point.start as usize) < starts.len())
                    })
                }
                SumMeasure::Swing { .. } | SumMeasure::Twist { .. } => return Err(on_ball),
            };
            let has_curve = term.curve == NONE || (term.curve as usize) < couplings.curves.len();
            ensure(holds && has_curve, table, i)?;
        }
        Ok(())
    }

    /// Returns true if a link with one coordinate is guided, and false if it is not. `None` for the ground and for links with several
    /// coordinates.
    fn has_one(&self, link: u32) -> Option<bool> {
        let kind = self.m.links.get(link as usize).filter(|_| link > 0)?.kind;
        let n = kind.n_freedoms::<T, S>();
        (n < 2).then_some(n == 0)
    }

    /// Checks the links of lines.
    pub(super) fn starts(&self) -> Result<(), LoadError> {
        for (i, start) in self.m.loops.couplings.starts.iter().enumerate() {
            let LinkStart { link, side } = *start;
            let holds = (link as usize) < self.sizes.links && sides(side) <= self.sizes.sides;
            ensure(holds, "links of lines", i)?;
        }
        Ok(())
    }

    /// Checks that the knots and numbers of all curves exist.
    pub(super) fn curves(&self) -> Result<(), LoadError> {
        let couplings = &self.m.loops.couplings;
        for (i, curve) in couplings.curves.iter().enumerate() {
            let holds = match curve {
                CurveTable::Spline { knots, first, .. } => {
                    is_within(*knots, couplings.knots.len())
                        && ends_by(*first, knots.range().len(), couplings.numbers.len())
                }
                CurveTable::Polynomial { coefficients } => {
                    is_within(*coefficients, couplings.numbers.len())
                }
            };
            ensure(holds, "curves", i)?;
        }
        Ok(())
    }
}
