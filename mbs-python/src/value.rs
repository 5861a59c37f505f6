//! Values of JSON as objects of Python, and back to the text of a scene.

use crate::error::usage;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList};
use serde_json::Value;

/// An object of Python: dicts, lists, texts, numbers, None.
pub(crate) fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Null => Ok(py.None().into_bound(py)),
        Value::Bool(is) => is.into_bound_py_any(py),
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(whole), _) => whole.into_bound_py_any(py),
            (None, float) => float.into_bound_py_any(py),
        },
        Value::String(text) => text.into_bound_py_any(py),
        Value::Array(items) => {
            let items = items.iter().map(|item| object(py, item));
            PyList::new(py, items.collect::<PyResult<Vec<_>>>()?)?.into_bound_py_any(py)
        }
        Value::Object(members) => {
            let dict = PyDict::new(py);
            for (key, value) in members {
                dict.set_item(key, object(py, value)?)?;
            }
            dict.into_bound_py_any(py)
        }
    }
}

/// Returns the items of a dict by name; refuses an argument that is no dict.
pub(crate) fn items<'py>(
    dict: &Bound<'py, PyAny>,
    argument: &str,
    hint: &str,
) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
    let py = dict.py();
    let wrong = || {
        let message = format!("{argument} is no dict, but {}", dict.get_type());
        usage(py, "wrong-type", &message, hint, argument)
    };
    if !dict.hasattr("items")? {
        return Err(wrong());
    }
    let item = |item: PyResult<Bound<'py, PyAny>>| item?.extract().map_err(|_| wrong());
    dict.call_method0("items")?.try_iter()?.map(item).collect()
}

/// The text of JSON of an argument; numbers and arrays of numpy are taken too.
pub(crate) fn json(value: &Bound<'_, PyAny>, argument: &str) -> PyResult<String> {
    static DUMPS: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let py = value.py();
    let dumps = DUMPS.get_or_try_init(py, || {
        Ok::<_, PyErr>(py.import("multibody.values")?.getattr("dumps")?.unbind())
    })?;
    dumps.bind(py).call1((value, argument))?.extract()
}
