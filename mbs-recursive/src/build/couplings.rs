//! Construction of the rows of couplings from the scene.

use crate::build::error::TreeError;
use crate::build::tree::TreeModel;
use crate::link::plan::Span;
use crate::link::{Link, LinkKind};
use crate::loops::index;
use crate::passes::feedback::FeedbackMeasure;
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::rows::coupled::{CoupledRow, LinePoint, LinkStart, NONE, SumMeasure, SumTerm};
use crate::rows::related::ARGUMENTS;
use crate::space::{Numbers, Space};
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::algebra::{Vector, along};
use mbs_core::feedback::FeedbackOperation;
use mbs_core::measure::{CouplingInput, TermInput};
use mbs_core::scene::{BallAngle, BodyId, CouplingMeasure, JointId, Scene};

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Adds the rows of couplings after the rows of cut joints.
    ///
    /// # Errors
    /// [`TreeError::Coupling`], [`TreeError::CouplingGuided`].
    pub(crate) fn add_couplings(&mut self, scene: &Scene<T>) -> Result<(), TreeError> {
        if scene.couplings.is_empty() {
            return Ok(());
        }
        self.couplings.n_cut = index(self.loops.len());
        let links = self.coordinate_links(scene);
        let (mut guide, mut relations) = (scene.guides.len(), 0);
        for (i, coupling) in scene.couplings.iter().enumerate() {
            let input = CouplingInput::new(coupling);
            let sum = input.sum.is_some().then_some(guide);
            guide += usize::from(sum.is_some());
            // the factors of a relation are arguments of its function, and are not scaled
            let by = if input.relation.is_some() { T::ONE } else { input.scale() };
            let added = self.add_terms((&input.terms, by), (scene, &links));
            let (terms, starts) = added.map_err(|_| TreeError::Coupling { coupling: i })?;
            if input.relation.is_some() {
                let terms = &mut self.couplings.terms[terms.range()];
                terms.iter_mut().for_each(|term| term.curve = ARGUMENTS | relations);
                relations += 1;
            }
            let is_angle = self.is_angle(terms);
            let inverse = T::ONE / input.scale();
            let guide = sum.map_or(NONE, index);
            let row = CoupledRow { terms, starts, guide, value: T::ZERO, inverse, is_angle };
            if self.can_move(&row) {
                self.add_coupled(row, i);
            } else if !self.is_held_by_guides(&row) {
                return Err(TreeError::CouplingGuided { coupling: i });
            }
        }
        Ok(())
    }

    /// Finds the links whose coordinates signals measure, and adds the tables of these signals.
    ///
    /// # Errors
    /// [`TreeError::Signal`].
    pub(crate) fn add_feedback(&mut self, scene: &Scene<T>) -> Result<(), TreeError> {
        let mut feedback = self.prescribed.feedback();
        if feedback.is_empty() {
            return Ok(());
        }
        let links = self.coordinate_links(scene);
        for (number, term) in feedback.measured.iter().enumerate() {
            if let Some(of) = term.coordinate {
                let link = self.sole_link(&links, of);
                self.measured.push(link.ok_or(TreeError::Signal { joint: of.0 })?);
                continue;
            }
            self.measured.push(NONE);
            let first = self.couplings.starts.len();
            let of = self.sum_measure(term, (scene, &links), first);
            let of = of.map_err(|joint| TreeError::Signal { joint })?;
            let starts = Span { first: index(first), end: index(self.couplings.starts.len()) };
            self.measures.push(FeedbackMeasure { number: index(number), of, starts });
        }
        for step in &mut feedback.steps {
            if let FeedbackOperation::Curve { curve, .. } = &mut step.operation {
                *curve = self.couplings.curves.add(&feedback.curves[*curve as usize]);
            }
        }
        self.feedback = feedback;
        Ok(())
    }

    /// Adds terms to the tables, and the links of their lines. Factors are divided by `scale`.
    ///
    /// # Errors
    /// Index of a joint whose coordinate is not the coordinate of a single link.
    pub(crate) fn add_terms(
        &mut self,
        (terms, scale): (&[TermInput<T>], T),
        (scene, links): (&Scene<T>, &[Vec<Option<u32>>]),
    ) -> Result<(Span, Span), usize> {
        let (first_term, first_start) = (self.couplings.terms.len(), self.couplings.starts.len());
        for term in terms {
            let of = self.sum_measure(term, (scene, links), first_start)?;
            let curve = self.couplings.curves.add(&term.curve);
            self.couplings.terms.push(SumTerm { factor: term.factor / scale, curve, of });
        }
        let terms = Span { first: index(first_term), end: index(self.couplings.terms.len()) };
        let starts = Span { first: index(first_start), end: index(self.couplings.starts.len()) };
        Ok((terms, starts))
    }

    /// Makes the measure of a term. Adds the links of the measure to the links of the row, which begin at index `first`.
    ///
    /// # Errors
    /// Index of a joint whose coordinate is not the coordinate of a single link.
    fn sum_measure(
        &mut self,
        term: &TermInput<T>,
        (scene, links): (&Scene<T>, &[Vec<Option<u32>>]),
        first: usize,
    ) -> Result<SumMeasure<T>, usize> {
        match (&term.of, term.coordinate) {
            (CouplingMeasure::Length { points }, _) => Ok(self.line((points, term), first)),
            (CouplingMeasure::Ball { joint, angle, axis }, _) => {
                self.ball((scene, *joint), (*angle, axis), first)
            }
            (CouplingMeasure::Coordinate { joint, number }, _) => {
                let of = (joint.index(), *number);
                let link = self.sole_link(links, of).ok_or(of.0)?;
                let is_guided = self.links[link as usize].kind.is_guided();
                Ok(SumMeasure::Joint { link, side: if is_guided { NONE } else { 0 } })
            }
        }
    }

    /// Returns the link that carries a coordinate of a joint. `None` if no single link carries it.
    fn sole_link(
        &self,
        links: &[Vec<Option<u32>>],
        (joint, number): (usize, usize),
    ) -> Option<u32> {
        let link = links[joint].get(number).copied().flatten()?;
        let kind = self.links[link as usize].kind;
        (!matches!(kind, LinkKind::Ball | LinkKind::Free)).then_some(link)
    }

    fn add_coupled(&mut self, row: CoupledRow<T>, coupling: usize) {
        self.loops.push(ClosedLoop {
            links: [0; 2],
            points: [S::Point::zero(); 2],
            first: index(self.rows.len()),
            n: 1,
            ancestor: 0,
            block: 0,
            joint: index(coupling),
        });
        self.rows.push(Row::Coupled(row));
    }

    /// Makes the measure of the length of a line through points. Adds the links of the line to the links of the row, which begin at index
    /// `first`.
    fn line(
        &mut self,
        (points, term): (&[(BodyId, [T; 3])], &TermInput<T>),
        first: usize,
    ) -> SumMeasure<T> {
        let begin = index(self.couplings.points.len());
        for &(body, at) in points {
            let (link, point) = self.seat_point(body, at);
            self.add_point(link, point, first);
        }
        let parts = points.windows(2).map(|pair| term.reference_of(&[pair[0].1, pair[1].1]));
        let reference = parts.fold(T::ZERO, |sum, part| sum + part);
        SumMeasure::Line {
            points: Span { first: begin, end: begin + index(points.len()) },
            reference,
        }
    }

    /// Adds a point of a link to the points of lines. Adds the link to the links of the row, which begin at index `first`.
    fn add_point(&mut self, link: u32, point: S::Point, first: usize) {
        let starts = &mut self.couplings.starts;
        let known = starts[first..].iter().position(|start| start.link == link);
        let start = known.unwrap_or_else(|| {
            starts.push(LinkStart { link, side: 0 });
            starts.len() - 1 - first
        });
        self.couplings.points.push(LinePoint { start: index(start), point });
    }

    /// Makes the measure of the swing or twist of a ball joint. A twist is computed from the coordinates of the link that carries the
    /// joint.
    ///
    /// # Errors
    /// Index of a joint that no link carries.
    fn ball(
        &mut self,
        (scene, joint): (&Scene<T>, JointId),
        (angle, axis): (BallAngle, &[T; 3]),
        first: usize,
    ) -> Result<SumMeasure<T>, usize> {
        let begin = index(self.couplings.points.len());
        let axis = S::point_from(&along(&Vector::from(*axis)));
        for body in scene.joints[joint.index()].bodies {
            let link = self.link(body);
            self.add_point(link, axis, first);
        }
        let axes = Span { first: begin, end: begin + 2 };
        if angle == BallAngle::Swing {
            return Ok(SumMeasure::Swing { axes });
        }
        let carried = self.seats.iter().find(|seat| seat.branch.joint == Some(joint.index()));
        let seat = carried.ok_or(joint.index())?;
        let has_ball = |link: &&Link<T, S>| matches!(link.kind, LinkKind::Ball | LinkKind::Free);
        let links = &self.links[seat.first as usize..=seat.link as usize];
        let first = links.iter().find(has_ball).ok_or(joint.index())?.z;
        Ok(SumMeasure::Twist { axes, first, is_reversed: seat.branch.is_reversed })
    }

    /// True if the sum of the terms is an angle: the term with the largest factor measures an angle.
    fn is_angle(&self, terms: Span) -> bool {
        let terms = &self.couplings.terms[terms.range()];
        let largest = terms.iter().filter(|term| term.factor.abs() == T::ONE);
        let plain = largest.clone().find(|term| term.curve == NONE);
        plain.or_else(|| largest.clone().next()).is_some_and(|term| match term.of {
            SumMeasure::Joint { link, .. } => {
                let kind = self.links[link as usize].kind;
                matches!(kind, LinkKind::Revolute | LinkKind::GuidedRevolute)
            }
            _ => false,
        })
    }

    /// True if one of the row's joints has a freedom, or if a line of the row connects different links.
    fn can_move(&self, row: &CoupledRow<T>) -> bool {
        let is_line = self.couplings.starts[row.starts.range()].len() > 1;
        is_line
            || self.couplings.terms[row.terms.range()].iter().any(|term| match term.of {
                SumMeasure::Joint { link, .. } => !self.links[link as usize].kind.is_guided(),
                _ => false,
            })
    }

    /// True if the guides of the row's joints satisfy the row. The guides are evaluated at a few times.
    fn is_held_by_guides(&self, row: &CoupledRow<T>) -> bool {
        /// Times at which guides are evaluated [s]. Chosen, not tuned.
        const TIMES: [f64; 5] = [0.0, 0.171_3, 0.618_2, 1.393_7, 7.129_1];
        /// Sum of guides that counts as zero, relative to the sum of the absolute values of its terms [-]. Chosen, not tuned.
        const ROUNDING: f64 = 1e-9;
        let mut guides = alloc::vec![[T::ZERO; 3]; self.prescribed.n_guides()];
        let placed = alloc::vec![crate::link::LinkMotion::ground(); self.links.len()];
        TIMES.iter().all(|&t| {
            self.prescribed.write(T::from_f64(t), &self.prescribed.inputs(), &mut guides, &mut []);
            let here = (&self.links[..], &placed[..], (&[][..], &[][..], &guides[..]));
            let value =
                self.couplings.slices(self.tables.codes()).evaluate((row, 0, 1), here, None);
            value.is_ok_and(|value| {
                value.row[0].abs() <= value.parts[0] * T::from_f64(ROUNDING).max(T::EPSILON)
            })
        })
    }
}
