//! Laws on one body in natural coordinates. The row of an action is the gradient of its rate.
//!
//! ```text
//! p = sum a_k e_k,  u_i the body's orthonormal directions,  w = 1/2 sum_i u_i x u_i'
//! action (d, m):  rate d.p' + m.w,   row A_k^T d + 1/2 sum_i (m x u_i) on u_i
//! ```

use crate::Real;
use crate::algebra::{Vector, cross, lowered, raised};
use crate::effects::BodyLaw;
use crate::elements::{Span, Term, add_gradient, combine};
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, MAX_ACTIONS, UnitWrench};
use crate::laws::scalar::ScalarForce;

/// Law on a body, with the places of its rows in the Jacobian store and of its measures among all measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyElement<T> {
    pub(crate) point: Span,
    /// Directions of the body; empty if the law needs no rotation.
    pub(crate) frame: [Span; 3],
    /// Direction of the law in the axes of the body.
    pub(crate) axis: [T; 3],
    pub(crate) law: BodyLaw<T>,
    pub(crate) measures: Span,
    pub(crate) place: Span,
}

impl<T: Real> BodyElement<T> {
    /// Evaluates the law at (q, v): its rows and its measures.
    pub(crate) fn evaluate<const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, v): (&[T], &[T]),
        law_inputs: &LawInputs<'_, T>,
        (jacobian, measures): (&mut [T], &mut [ScalarForce<T>]),
    ) {
        let n = self.law.n_actions();
        let rows = self.place.of_mut(jacobian);
        rows.fill(T::ZERO);
        let point = self.point.of(pool);
        let mut motion = BodyMotion {
            position: raised::<T, D>(&combine(point, q)).into(),
            velocity: raised::<T, D>(&combine(point, v)).into(),
            axis: self.axis,
            spin: [T::ZERO; 3],
        };
        let turns = self.law.needs_rotation();
        let mut directions = [Vector::<T, 3>::zeros(); 3];
        if turns {
            let (mut spin, mut axis) = (Vector::<T, 3>::zeros(), Vector::<T, 3>::zeros());
            for (i, u) in directions.iter_mut().enumerate().take(D) {
                *u = raised::<T, D>(&combine(self.frame[i].of(pool), q));
                let rate = raised::<T, D>(&combine(self.frame[i].of(pool), v));
                spin += cross(u, &rate) * T::HALF;
                axis += *u * self.axis[i];
            }
            // The planar basis has no third direction, and the axis keeps its third component.
            if D == 2 {
                axis[2] += self.axis[2];
            }
            (motion.axis, motion.spin) = (axis.into(), spin.into());
        }
        let mut actions = [UnitWrench::default(); MAX_ACTIONS];
        self.law.evaluate(&motion, law_inputs, &mut actions[..n]);
        let width = rows.len() / n.max(1);
        let measures = &mut measures[self.measures.range()];
        for (k, ((row, action), measure)) in
            rows.chunks_exact_mut(width.max(1)).zip(&actions).zip(measures).enumerate()
        {
            let before = core::mem::replace(measure, action.measure);
            self.law.look_back(k, measure, &before);
            add_gradient::<T, D>(row, point, &lowered(&Vector::from(action.force)));
            let moment = Vector::<T, 3>::from(action.moment);
            if turns {
                for (span, u) in self.frame.iter().zip(&directions).take(D) {
                    let half = cross(&moment, u) * T::HALF;
                    add_gradient::<T, D>(row, span.of(pool), &lowered(&half));
                }
            }
        }
    }

    /// Stored energy of the law [J].
    pub(crate) fn energy(&self, measures: &[ScalarForce<T>]) -> T {
        let own = self.measures.of(measures).iter().enumerate();
        own.fold(T::ZERO, |sum, (k, measure)| sum + self.law.energy(k, measure))
    }

    /// Power that is not stored [W].
    pub(crate) fn power(&self, measures: &[ScalarForce<T>]) -> T {
        let own = self.measures.of(measures).iter().enumerate();
        own.fold(T::ZERO, |sum, (k, measure)| sum + self.law.power(k, measure))
    }
}
