//! The native part of the Python package `multibody`: its classes over the front door of `mbs`.

mod array;
mod batch;
mod each;
mod error;
mod external;
mod forces;
mod given;
mod import;
mod mechanism;
mod model;
mod readings;
mod recording;
mod robot;
mod run;
mod settings;
mod simulation;
mod stepping;
mod study;
mod sweep;
mod value;
mod values;
mod watch;

use pyo3::prelude::*;
use std::ffi::OsString;

/// Proposes the nearest of some names.
#[pyfunction]
fn nearest_name(name: &str, known: Vec<String>) -> String {
    mbs::scene_file::nearest_name(name, &known, "names")
}

/// Runs the command `mbs` and gives its exit status.
#[pyfunction]
fn command(py: Python<'_>, program: Vec<OsString>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| mbs_cli::run(program, arguments))
}

/// The native module.
#[pymodule(gil_used = false)]
fn _multibody(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<mechanism::Mechanism>()?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<recording::Recording>()?;
    module.add_class::<run::Record>()?;
    module.add_class::<sweep::Sweep>()?;
    module.add_class::<sweep::Collection>()?;
    module.add_function(wrap_pyfunction!(nearest_name, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    module.add_function(wrap_pyfunction!(mechanism::_restore, module)?)?;
    module.add_function(wrap_pyfunction!(simulation::_restore_simulation, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::_restore_sweep, module)?)
}
