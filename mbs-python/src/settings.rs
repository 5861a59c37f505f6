//! How a mechanism is stepped, by keyword arguments.

use crate::error::{unknown_name, usage};
use mbs::core::scene::{SETTINGS, SettingSlot};
use mbs::{Interrupt, Method};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};

/// Argument that is no setting of a method: whether an estimate of the errors is asked for.
const ESTIMATE: &str = "estimate";

/// Names of the settings in the order of the alphabet, then that of the estimate.
static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let mut names: Vec<_> = SETTINGS.iter().map(|row| row.name).collect();
    names.sort_unstable();
    names.push(ESTIMATE);
    names
});

/// A method of keyword arguments, and whether an estimate of the errors is asked for. None leaves a setting to the scene.
pub(crate) fn method(settings: &Bound<'_, PyDict>) -> PyResult<(Method, bool)> {
    let (mut method, mut estimate) = (Method::default(), false);
    for (key, value) in settings.iter() {
        let name: String = key.extract()?;
        if value.is_none() {
            if NAMES.contains(&&*name) {
                continue;
            }
            return Err(unknown(value.py(), &name));
        }
        set(&mut method, &mut estimate, (&name, &value)).map_err(|error| {
            let py = value.py();
            if error.is_instance_of::<PyTypeError>(py)
                || error.is_instance_of::<PyOverflowError>(py)
            {
                let message = format!("{name} cannot be {value}");
                let hint = "settings are numbers, and names of methods texts";
                return usage(py, "settings-refused", &message, hint, &name);
            }
            error
        })?;
    }
    Ok((method, estimate))
}

fn set(
    method: &mut Method,
    estimate: &mut bool,
    (name, value): (&str, &Bound<'_, PyAny>),
) -> PyResult<()> {
    if name == ESTIMATE {
        *estimate = value.extract()?;
        return Ok(());
    }
    let slot = method.slot(name).ok_or_else(|| unknown(value.py(), name))?;
    match slot {
        SettingSlot::Word(field) => *field = Some(value.extract()?),
        SettingSlot::Number(field) => *field = Some(value.extract()?),
        SettingSlot::Pair(field) => *field = Some(value.extract()?),
        SettingSlot::Flag(field) => *field = Some(value.extract()?),
        SettingSlot::Count(field) => *field = Some(value.extract()?),
    }
    Ok(())
}

fn unknown(py: Python<'_>, name: &str) -> PyErr {
    unknown_name(py, ["setting", "settings"], (name, name), &NAMES)
}

/// The method, ended by a flag.
pub(crate) fn interruptible(method: Method) -> (Method, Arc<AtomicBool>) {
    let flag = Arc::new(AtomicBool::new(false));
    (Method { interrupt: Interrupt::new(flag.clone()), ..method }, flag)
}
