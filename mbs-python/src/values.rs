//! Values that are named tuples of Python.

use crate::array::vector;
use pyo3::call::PyCallArgs;
use pyo3::prelude::*;

/// An instance of a class of `multibody.values`.
pub(crate) fn make<'py>(
    py: Python<'py>,
    class: &str,
    fields: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import("multibody.values")?.getattr(class)?.call1(fields)
}

/// Makes a `State` of Python from coordinates and velocities.
pub(crate) fn state<'py>(py: Python<'py>, q: Vec<f64>, v: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
    make(py, "State", (vector(py, &q), vector(py, &v)))
}
