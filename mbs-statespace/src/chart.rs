//! Coordinates of the tangent plane: z = C^T q with C = M R at the middle of the step.
//!
//! ```text
//! d = C^T (q - q_p),    C^T v = C^T v_p + v' d,    C^T a = C^T a_p + a' d        [P1 (40) for z = C^T q]
//! x on its constraint is moved along R until C^T x is met:   (C^T R) y = C^T (x_wanted - x),   x += R y
//! ```

use crate::workspace::Workspace;
use mbs_core::model::{Load, Model, State, System, Tangent};
use mbs_core::step::StepError;
use mbs_core::{FactorError, Real};

impl<T: Real> Workspace<T> {
    /// Sets C = M R at the middle of the predicted motion. Leaves the increment up to the middle in `dq`.
    pub(crate) fn set_chart<M: Model<T>>(
        &mut self,
        model: &M,
        dt: T,
        s: &State<T>,
    ) -> Result<(), StepError> {
        model.set_inputs(s.t + dt * T::HALF, s, &mut self.terms);
        for dq in &mut self.dq[..model.n_unknowns()] {
            *dq *= T::HALF;
        }
        self.move_to(model, s)?;
        self.basis.evaluate(&self.elimination);
        let tangent =
            Tangent { stiffness: T::ZERO, damping: T::ZERO, penalty: &[], geometric: None };
        let load = Load { mass: None, multipliers: None, force: T::ZERO };
        let system = System { model, terms: &self.terms, tangent, load };
        self.basis.set_chart(&self.elimination, &system);
        Ok(())
    }

    /// Evaluates C^T of the predicted increment, velocity and acceleration.
    pub(crate) fn predict_chart(&mut self) {
        let [dq, v, a] = &mut self.predicted;
        self.basis.chart(&self.dq, dq);
        self.basis.chart(&self.v, v);
        self.basis.chart(&self.a, a);
    }

    /// Evaluates d = C^T (q - q_p) into `measured`, and factors C^T R.
    pub(crate) fn turn_to_chart(&mut self) -> Result<(), StepError> {
        self.basis.chart_basis(&self.elimination, &mut self.turn);
        self.turn.factor().map_err(|i| {
            let unknown = self.elimination.independent()[i];
            StepError::Singular(FactorError { unknown, pivot: 0.0 })
        })?;
        self.basis.chart(&self.dq, &mut self.measured);
        for (d, &p) in self.measured.iter_mut().zip(&self.predicted[0]) {
            *d -= p;
        }
        Ok(())
    }

    /// Moves v (level 1) or a (level 2) along R until C^T x = C^T x_p + rate d.
    pub(crate) fn meet(&mut self, level: usize, rate: T) {
        let x = if level == 1 { &mut self.v } else { &mut self.a };
        self.basis.chart(x, &mut self.wanted);
        for ((y, &p), &d) in self.wanted.iter_mut().zip(&self.predicted[level]).zip(&self.measured)
        {
            *y = (p - *y) + rate * d;
        }
        self.turn.solve(&mut self.wanted);
        self.basis.expand(&self.elimination, &self.wanted, &mut self.change);
        for (x, &c) in x.iter_mut().zip(&self.change[..]) {
            *x += c;
        }
    }
}
