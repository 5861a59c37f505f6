//! How a mechanism is stepped, by keyword arguments.

use crate::error::{unknown_name, usage};
use mbs::{Interrupt, Method};
use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Names of the settings.
const NAMES: [&str; 15] = [
    "duration",
    "energy_alarm",
    "energy_tolerance",
    "error_tolerance",
    "events",
    "formulation",
    "integrator",
    "penalty",
    "precision",
    "step",
    "step_control",
    "step_max",
    "threads",
    "tolerance",
    "estimate",
];

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
    match name {
        "duration" => method.duration = Some(value.extract()?),
        "energy_alarm" => method.energy_alarm = Some(value.extract()?),
        "energy_tolerance" => method.energy_tolerance = Some(value.extract()?),
        "error_tolerance" => method.error_tolerance = Some(value.extract()?),
        "events" => method.events = Some(value.extract()?),
        "formulation" => method.formulation = Some(value.extract()?),
        "integrator" => method.integrator = Some(value.extract()?),
        "penalty" => method.penalty = Some(value.extract()?),
        "precision" => method.precision = Some(value.extract()?),
        "step" => method.step = Some(value.extract()?),
        "step_control" => method.step_control = Some(value.extract()?),
        "step_max" => method.step_max = Some(value.extract()?),
        "threads" => method.threads = Some(value.extract()?),
        "tolerance" => method.tolerance = Some(value.extract()?),
        "estimate" => *estimate = value.extract()?,
        _ => return Err(unknown(value.py(), name)),
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
