//! Couplings as constraint rows. Each coupling is a group over the points and directions of its joints.

use super::build::Builder;
use super::coordinate::{Coordinate, Places};
use super::forces::Measure;
use super::group::{Group, add_squares};
use super::model::NaturalModel;
use super::row_builder::{CoupledDraft, GroupDraft, MeasureDraft, RowDraft, difference};
use crate::Real;
use crate::algebra::{Vector, along, norm};
use crate::elements::{
    Coupled, CoupledForm, CoupledTables, Curves, Measurand, NONE, Span, add_measure_gradient,
    combine, has_collapsed, measured_value,
};
use crate::inputs::CouplingInput;
use crate::joint::Dimension;
use crate::measure::{Arguments, PreparedCurve, TermInput};
use crate::model::{Owner, Terms};
use crate::scene::{BallAngle, BodyId, CouplingMeasure, transverse};
use alloc::vec;
use alloc::vec::Vec;

impl<T: Real> Builder<'_, T> {
    /// Adds the rows of the couplings.
    pub(super) fn add_couplings(&mut self) {
        let (mut guide, mut relations) = (self.scene.guides.len(), 0);
        for (i, coupling) in self.scene.couplings.iter().enumerate() {
            let input = CouplingInput::new(coupling);
            let scale = input.scale();
            // the factors of a relation are not divided by the scale
            let by = if input.relation.is_some() { T::ONE } else { scale };
            let terms: Vec<_> =
                input.terms.iter().map(|term| self.coupled_draft(term, by)).collect();
            let number = input.sum.is_some().then_some(guide);
            guide += usize::from(input.sum.is_some());
            let is_linear = !coupling.is_driven() && terms.iter().all(|t| t.curve.is_identity());
            let form = match input.relation {
                Some(_) => CoupledForm::Relation(relations),
                None if is_linear => CoupledForm::Linear,
                None => CoupledForm::Sum,
            };
            relations += u32::from(input.relation.is_some());
            let mut group = GroupDraft::new(Owner::Coupling(i));
            group.rows.push(RowDraft::Coupled {
                terms,
                inverse: T::ONE / scale,
                guide: number,
                form,
            });
            self.groups.push(group);
        }
    }

    /// Term of a coupling, with its factor divided by `scale`.
    pub(super) fn coupled_draft(&mut self, term: &TermInput<T>, scale: T) -> CoupledDraft<T> {
        let measures = match (&term.of, term.coordinate) {
            (CouplingMeasure::Length { points }, _) => {
                let parts = points.windows(2).map(|pair| {
                    let [from, to] = [0, 1].map(|k| self.point(pair[k].0, pair[k].1));
                    let reference = term.reference_of(&[pair[0].1, pair[1].1]);
                    MeasureDraft::Length { x: difference(&to, &from), reference }
                });
                parts.collect()
            }
            (CouplingMeasure::Ball { joint, angle, axis }, _) => {
                let scene = self.scene;
                alloc::vec![self.ball_measure(scene.joints[joint.index()].bodies, *angle, axis)]
            }
            (CouplingMeasure::Coordinate { .. }, Some((joint, number))) => {
                self.coordinate_measure(joint, number).into_iter().collect()
            }
            (CouplingMeasure::Coordinate { .. }, None) => Vec::new(),
        };
        CoupledDraft { factor: term.factor / scale, measures, curve: term.curve.clone() }
    }

    /// Returns the measure of the swing or twist of a ball joint about an axis.
    fn ball_measure(
        &mut self,
        [first, second]: [BodyId; 2],
        angle: BallAngle,
        axis: &[T; 3],
    ) -> MeasureDraft<T> {
        let axis = along(&Vector::from(*axis));
        match angle {
            BallAngle::Swing => {
                let (a, b) = (self.direction(first, axis), self.direction(second, axis));
                MeasureDraft::Swing { a, b }
            }
            BallAngle::Twist => {
                let across = transverse(&axis, Dimension::Spatial);
                let [first, second] = [first, second].map(|body| {
                    let [v, w] = across;
                    [self.direction(body, v), self.direction(body, w)]
                });
                MeasureDraft::Twist { first, second }
            }
        }
    }

    /// Returns the measure of a joint coordinate; `None` for coordinates that have no measure, which the check of a scene refuses.
    pub(super) fn coordinate_measure(
        &mut self,
        index: usize,
        number: usize,
    ) -> Option<MeasureDraft<T>> {
        let scene = self.scene;
        let joint = &scene.joints[index];
        let freedom = joint.kind.freedom(scene.dimension, number)?;
        match self.coordinate(joint, scene.dimension, freedom) {
            Coordinate::Angle { x1, x2, y, sign } => {
                Some(MeasureDraft::Angle { x1, x2, y, sign, of: (index, number) })
            }
            Coordinate::Slide { x, y } => Some(MeasureDraft::Slide { x, y }),
            Coordinate::Rotation => None,
        }
    }
}

impl<T: Real> Curves<T> for Vec<PreparedCurve<T>> {
    fn at(&self, curve: u32, x: T) -> [T; 3] {
        self[curve as usize].at(x)
    }

    fn change(&self, curve: u32, x: T, dx: T) -> T {
        self[curve as usize].change(x, dx)
    }
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Tables that coupling rows refer to.
    pub(super) fn coupled_tables(&self) -> CoupledTables<'_, T, Vec<PreparedCurve<T>>> {
        CoupledTables {
            terms: &self.coupled_terms,
            measures: &self.coupled_measures,
            pool: &self.pool,
            curves: &self.curves,
        }
    }

    /// Adds the second derivatives of coupling rows, for motions that keep directions at unit length. The tangent of a step leaves
    /// them out.
    pub(crate) fn add_coupled_curvature(
        &self,
        (q, terms): (&[T], &Terms<T>),
        lambda: &[T],
        element: usize,
        block: &mut [T],
    ) {
        let group = &self.groups[element];
        let rows = group.rows.range();
        for row in self.coupled.iter().filter(|row| rows.contains(&(row.row as usize))) {
            if let CoupledForm::Relation(number) = row.form {
                let weight = lambda[row.row as usize] * row.inverse;
                self.add_relation_curvature((row, number), (q, terms), weight, (group, block));
                continue;
            }
            let weight = lambda[row.row as usize];
            self.add_sum_curvature((row.terms, weight), (q, terms), (group, block));
        }
    }

    /// Adds the second derivatives of a sum of terms, times `weight`.
    fn add_sum_curvature(
        &self,
        (of, weight): (Span, T),
        (q, terms): (&[T], &Terms<T>),
        (group, block): (&Group, &mut [T]),
    ) {
        let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
        for term in of.of(&self.coupled_terms) {
            let measures = term.measures.of(&self.coupled_measures);
            let mut gradient = vec![T::ZERO; group.width as usize];
            let mut m = T::ZERO;
            for measure in measures {
                m += measure.sign * measured_value(&measure.of, at, &terms.angles);
                add_measure_gradient(&measure.of, &self.pool, at, measure.sign, &mut gradient);
            }
            let s = weight * term.factor;
            let [_, slope, bend] = self.coupled_tables().function(term.curve, m);
            add_squares(block, group.clique.len(), [&gradient], [s * bend]);
            for measure in measures {
                self.add_measure_curvature(&measure.of, q, s * slope * measure.sign, group, block);
            }
        }
    }

    /// Second derivatives of an element, packed as its block: of coupling rows, and of sums under tension times `stiffness`. Empty
    /// if the element has neither.
    pub(super) fn coupled_curvature(
        &self,
        (q, terms): (&[T], &Terms<T>),
        (lambda, stiffness): (&[T], T),
        element: usize,
    ) -> Vec<T> {
        let group = &self.groups[element];
        let (k, rows) = (group.clique.len(), group.rows.range());
        // the measures of a law on a body are numbered in another table
        let measures = if group.has_body_law { 0..0 } else { group.measures.range() };
        let sums = measures.filter_map(|m| match self.measures[m].gauge {
            Measure::Sum { terms: of } => Some((of, terms.measures[m].tension * stiffness)),
            _ => None,
        });
        let has_rows = self.coupled.iter().any(|row| rows.contains(&(row.row as usize)));
        if !has_rows && sums.clone().next().is_none() {
            return Vec::new();
        }
        let mut block = vec![T::ZERO; k * (k + 1) / 2];
        self.add_coupled_curvature((q, terms), lambda, element, &mut block);
        for (of, tension) in sums {
            self.add_sum_curvature((of, tension), (q, terms), (group, &mut block));
        }
        block
    }

    /// Adds the second derivatives of a relation: weight (sum_k phi_k H(a_k) + sum_kl phi_kl grad a_k grad a_l^T), a_k: term k.
    fn add_relation_curvature(
        &self,
        (row, number): (&Coupled<T>, u32),
        (q, terms): (&[T], &Terms<T>),
        weight: T,
        (group, block): (&Group, &mut [T]),
    ) {
        let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
        let relation = self.codes().relation(number);
        let mut arguments = Arguments::default();
        let mut gradients = Vec::new();
        for term in row.terms.of(&self.coupled_terms) {
            let mut gradient = vec![T::ZERO; group.width as usize];
            let mut m = T::ZERO;
            for measure in term.measures.of(&self.coupled_measures) {
                let by = term.factor * measure.sign;
                m += by * measured_value(&measure.of, at, &terms.angles);
                add_measure_gradient(&measure.of, &self.pool, at, by, &mut gradient);
            }
            arguments.push([m, T::ZERO], T::ZERO);
            gradients.push(gradient);
        }
        arguments.evaluate(&relation);
        let k = group.clique.len();
        let second = |i, j| weight * arguments.second_derivative(&relation, i, j);
        for (i, a) in gradients.iter().enumerate() {
            add_squares(block, k, [a], [second(i, i)]);
            for (j, b) in gradients.iter().enumerate().take(i) {
                // symmetric product: a b^T + b a^T = ((a + b)(a + b)^T - (a - b)(a - b)^T)/2
                let by = |s: T| -> Vec<T> { a.iter().zip(b).map(|(&x, &y)| x + s * y).collect() };
                let (sum, difference) = (by(T::ONE), by(-T::ONE));
                let half = second(i, j) * T::HALF;
                add_squares(block, k, [&sum, &difference], [half, -half]);
            }
        }
        for (i, term) in row.terms.of(&self.coupled_terms).iter().enumerate() {
            for measure in term.measures.of(&self.coupled_measures) {
                let s = weight * arguments.slope(i) * term.factor * measure.sign;
                self.add_measure_curvature(&measure.of, q, s, group, block);
            }
        }
    }

    fn add_measure_curvature(
        &self,
        of: &Measurand<T>,
        q: &[T],
        s: T,
        group: &Group,
        block: &mut [T],
    ) {
        let at = |x: Span| combine::<T, D>(x.of(&self.pool), q);
        let mut add = |x: Span, y: Span, s: T| {
            self.add_pairs((x.of(&self.pool), y.of(&self.pool)), s, group, block);
        };
        match *of {
            Measurand::Angle { x1, x2, y, .. } => {
                let (c, d) = (at(x1).dot(&at(y)), at(x2).dot(&at(y)));
                let by = s / (c * c + d * d);
                add(x2, y, by * c);
                add(x1, y, -by * d);
            }
            Measurand::Slide { x, y } => add(x, y, s),
            // no constraint row contains a swing or twist
            Measurand::Swing { .. } | Measurand::Twist { .. } => {}
            Measurand::Length { x, .. } => {
                let length = norm(&at(x));
                if length > T::ZERO {
                    let mut gradient = vec![T::ZERO; group.width as usize];
                    add_measure_gradient(of, &self.pool, at, T::ONE, &mut gradient);
                    add(x, x, s / length * T::HALF);
                    add_squares(block, group.clique.len(), [&gradient], [-s / length]);
                }
            }
        }
    }

    /// Index of the first part of a line whose length vanishes in a step `dq` from (q, v); `None` if all parts keep a length.
    pub(super) fn collapsed_part(
        &self,
        terms: Span,
        (q, v, dq): (&[T], &[T], &[T]),
    ) -> Option<usize> {
        let terms = terms.of(&self.coupled_terms).iter();
        let measures = terms.flat_map(|term| term.measures.of(&self.coupled_measures));
        let gaps = measures.filter_map(|measure| match measure.of {
            Measurand::Length { x, .. } => Some(x),
            Measurand::Angle { .. }
            | Measurand::Slide { .. }
            | Measurand::Swing { .. }
            | Measurand::Twist { .. } => None,
        });
        let is_collapsed = |x: Span| {
            let of = |coordinates: &[T]| combine::<T, D>(x.of(&self.pool), coordinates);
            let (before, change) = (of(q), of(dq));
            let after = before + change;
            let [dd, de, ee] = [before.dot(&before), before.dot(&after), after.dot(&after)];
            has_collapsed([dd, de, ee, before.dot(&of(v))])
        };
        gaps.into_iter().position(is_collapsed)
    }

    /// Rows of couplings whose sum is not always zero.
    pub(super) fn driven(&self) -> impl Iterator<Item = &Coupled<T>> {
        self.coupled.iter().filter(|row| row.guide != NONE)
    }

    /// Prescribed sum of a coupling at the current time: value, rate and acceleration; zero without a guide.
    pub(super) fn sum_of(guide: u32, guides: &[[T; 3]]) -> [T; 3] {
        if guide == NONE { [T::ZERO; 3] } else { guides[guide as usize] }
    }

    /// Remembered angles of couplings: joint and coordinate number, sign of the joint's coordinate, and place in
    /// [`State::memory`](crate::model::State::memory).
    pub fn coupled_angles(&self) -> impl Iterator<Item = ((usize, usize), T, usize)> + '_ {
        self.coupled_angles.iter().map(|&(of, sign, place)| (of, sign, place as usize))
    }
}
