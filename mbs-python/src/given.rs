//! Values of inputs as arguments.

use crate::array::Numbers;
use crate::mechanism::Mechanism;
use pyo3::prelude::*;

impl Mechanism {
    /// Values of all inputs; another number of them is refused with their names.
    pub(crate) fn inputs_of(&self, u: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        let py = u.py();
        Numbers::row(u, "u", self.shared.inputs.len()).map_err(|error| self.about_inputs(py, error))
    }

    /// A refusal of the number of inputs, which names them.
    pub(crate) fn about_inputs(&self, py: Python<'_>, error: PyErr) -> PyErr {
        let value = error.value(py);
        let is = |field: &str, word: &str| {
            let found = value.getattr(field).and_then(|found| found.extract::<String>());
            found.is_ok_and(|found| found == word)
        };
        if is("code", "wrong-shape") && is("argument", "u") {
            let names: Vec<&str> = self.shared.inputs.iter().map(|info| &*info.name).collect();
            let hint = match names[..] {
                [] => "the mechanism has no inputs; a model gets some by motors=True".to_owned(),
                _ => format!("give a number for each of: {}", names.join(", ")),
            };
            // an exception of another class has no hint
            let _ = value.setattr("hint", hint);
        }
        error
    }
}
