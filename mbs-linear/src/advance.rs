//! State after a short time, by one step of the classical Runge-Kutta method in natural coordinates.
//!
//! ```text
//! (q, v)' = (v, a(q, v, t)),   q on the constraints and v on their rates at each stage
//! ```

use crate::error::LinearError;
use crate::linearise::{Field, Instant};
use crate::options::LinearOptions;
use crate::workspace::Workspace;
use alloc::vec::Vec;
use mbs_core::model::{Model, State};
use mbs_core::{Real, SymmetricSolver};

/// Returns the state after a time `h` [s]. The states of signals keep their values.
///
/// The error is of fifth order in h.
///
/// Cost: 5 evaluations and factorisations, and the dense split; allocates.
///
/// # Errors
/// [`LinearError`] if the constraints cannot be closed at a stage, or the state lacks inertia.
pub fn advance<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    h: T,
    s: &State<T>,
    w: &mut Workspace<T, S>,
) -> Result<State<T>, LinearError> {
    let mut field = Field::checked(model, (Instant::Motion, &LinearOptions::default()), s, w)?;
    let mut stage = |part: T, rates: &[Vec<T>; 2]| -> Result<[Vec<T>; 2], LinearError> {
        field.go_to(h * part, rates)?;
        Ok([field.v.clone(), field.a.clone()])
    };
    let still = [0, 1].map(|_| alloc::vec![T::ZERO; s.q.len()]);
    let first = stage(T::ZERO, &still)?;
    let second = stage(T::HALF, &first)?;
    let third = stage(T::HALF, &second)?;
    let fourth = stage(T::ONE, &third)?;
    let mean = [0, 1].map(|k| {
        let all = first[k].iter().zip(&second[k]).zip(third[k].iter().zip(&fourth[k]));
        let sixth = T::ONE / T::from_f64(6.0);
        all.map(|((a, b), (c, d))| (*a + *d + (*b + *c) * T::TWO) * sixth).collect::<Vec<_>>()
    });
    stage(T::ONE, &mean)?;
    let (q, v, a, lambda) = (field.q, field.v, field.a, field.lambda);
    let reaction = lambda.clone();
    Ok(State { t: s.t + h, q, v, a, lambda, reaction, ..s.clone() })
}

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Field<'_, T, M, S> {
    /// Evaluates accelerations at a time `h` after the start. Positions and velocities are those of the start plus `h` times the rates `[v,
    /// a]`.
    fn go_to(&mut self, h: T, [v, a]: &[Vec<T>; 2]) -> Result<(), LinearError> {
        let start = self.start;
        self.model.set_inputs(start.t + h, start, &mut self.w.terms);
        for (to, (&from, &rate)) in self.q.iter_mut().zip(start.q.iter().zip(v)) {
            *to = from + rate * h;
        }
        self.close()?;
        self.factor()?;
        let moved: Vec<T> = start.v.iter().zip(a).map(|(&v, &a)| v + a * h).collect();
        self.at_rest_of(&moved).map(|_| ())
    }
}
