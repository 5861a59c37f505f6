//! Methods of a mechanism that was a model: the report of its import, and states in the order of its file.

use crate::error::guarded;
use crate::import;
use crate::mechanism::Mechanism;
use pyo3::prelude::*;

#[pymethods]
impl Mechanism {
    /// What became of the elements of a model: the object of `mbs import --json`. None where the mechanism comes from a scene.
    #[getter]
    fn import_report<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let model = self.shared.model.as_deref();
        model.map(|model| guarded(py, || import::report(py, model))).transpose()
    }

    /// The state of an MJCF's `qpos` and `qvel`, as MuJoCo orders them; without `qvel` at rest.
    #[pyo3(signature = (qpos, qvel = None))]
    fn from_qpos<'py>(
        slf: &Bound<'py, Self>,
        qpos: &Bound<'py, PyAny>,
        qvel: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("multibody.qpos")?.getattr("state")?.call1((slf, qpos, qvel))
    }

    /// `qpos` and `qvel` of an MJCF, as MuJoCo orders them, of q and v; without v at rest.
    #[pyo3(signature = (q, v = None))]
    fn to_qpos<'py>(
        slf: &Bound<'py, Self>,
        q: &Bound<'py, PyAny>,
        v: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("multibody.qpos")?.getattr("qpos")?.call1((slf, q, v))
    }

    /// The coordinates of an MJCF in its own order; None where the mechanism comes from something else.
    fn _file_coordinates<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.shared.model.as_deref().and_then(|model| import::coordinates(py, model)).transpose()
    }
}
