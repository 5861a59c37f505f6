//! Computations of one state, or of each of many.

use crate::array::{States, array};
use crate::error::{Class, class_of, exception, fields};
use crate::mechanism::Mechanism;
use crate::watch::Ear;
use mbs::{SimulationError, Tree, TreeError, TreeErrorKind};
use pyo3::prelude::*;

/// Arguments by name, each with its numbers of a state.
type Arguments<'a, 'py> = [(&'a Bound<'py, PyAny>, &'a str, usize)];

impl Mechanism {
    /// Numbers in q and in v.
    pub(crate) fn sizes(&self, py: Python<'_>) -> PyResult<[usize; 2]> {
        let first = self.first(py)?;
        Ok([first.coordinates().len(), first.velocities().len()])
    }

    /// Computes `n` numbers of each state; `shape` is that of one of them.
    pub(crate) fn each<'py>(
        &self,
        py: Python<'py>,
        (arguments, strict): (&Arguments<'_, 'py>, bool),
        shape: &[usize],
        one: impl Fn(&mut Tree, [&[f64]; 3], &mut [f64]) -> Result<(), TreeError> + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let states = States::new(arguments, strict)?;
        let (n, count) = (shape.iter().product::<usize>(), states.len());
        let mut out = vec![0.0; n * count];
        let rows = states.rows();
        let n_arguments = arguments.len();
        let work = |tree: &mut Tree, k: usize, to: &mut [f64]| {
            let argument = |i: usize| if i < n_arguments { rows.get(i, k) } else { &[] };
            let given = [argument(0), argument(1), argument(2)];
            one(tree, given, &mut *to).and_then(|()| finite(to))
        };
        let all = |tree: &mut Tree, out: &mut [f64]| {
            let mut ear = Ear::new();
            for k in 0..count {
                let to = &mut out[n * k..][..n];
                work(tree, k, to).map_err(|error| Ended::Refused(k, Box::new(error)))?;
                ear.turn().map_err(Ended::Interrupted)?;
            }
            Ok(())
        };
        let done = self.with_tree(py, |tree| match count {
            1 => work(tree, 0, &mut out).map_err(|error| Ended::Refused(0, Box::new(error))),
            _ => py.detach(|| all(tree, &mut out)),
        })?;
        match done {
            Ok(()) => (),
            Err(Ended::Interrupted(error)) => return Err(error),
            Err(Ended::Refused(k, error)) => {
                let error = SimulationError::from(*error);
                let mut fields = fields(&error);
                if fields.code == "not-finite" {
                    let names: Vec<&str> = arguments.iter().map(|(_, name, _)| *name).collect();
                    states.check_finite(py, &names)?;
                }
                if states.k().is_some() {
                    fields.message = format!("state {k}: {}", fields.message);
                }
                return Err(exception(py, class_of(&error, Class::Stop), &fields));
            }
        }
        let many: Vec<usize> = states.k().into_iter().chain(shape.iter().copied()).collect();
        array(py, out, &many)
    }
}

/// Why a loop over states ended early.
enum Ended {
    /// Number of a state that is refused, and its error.
    Refused(usize, Box<TreeError>),
    Interrupted(PyErr),
}

/// Refuses an answer that has overflowed.
fn finite(answer: &[f64]) -> Result<(), TreeError> {
    match answer.iter().position(|x| !x.is_finite()) {
        Some(place) => Err(TreeErrorKind::NotFinite("the answer", place).into()),
        None => Ok(()),
    }
}
