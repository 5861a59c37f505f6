//! One run of a case's scene. It is completed, stops with a typed error, or shows a fault.

use crate::gauntlet::case::Options;
use mbs::scene_file::SceneFile;
use mbs::{FormulationKind, Mechanism, Method, Run};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Names of the formulations under test. They run with the trapezoidal rule; those that control their steps keep that control.
pub fn methods() -> impl Iterator<Item = &'static str> {
    FormulationKind::listed().map(FormulationKind::name)
}

/// Largest error of the energy balance at the end of a run, relative to the exchanged energy [-]. Chosen, not tuned.
const MOST_ENERGY: f64 = 0.1;

/// Outcome of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Ran {
    /// Run that is completed.
    Completed {
        /// Rows of time and outputs.
        rows: Vec<(f64, Vec<f64>)>,
        /// Largest residual of joints [m, rad].
        violation: f64,
        /// Largest error of the energy balance at any time, relative to the exchanged energy [-].
        energy: f64,
    },
    /// Run that stops with a typed error.
    Stopped {
        /// Code of the error.
        code: String,
        /// Time of the stop [s].
        time: f64,
    },
    /// Run with a fault: a panic, a number that is not finite, energy from nothing, an error without a message.
    Broken(String),
}

impl Ran {
    /// The rows of a completed run.
    #[must_use]
    pub fn rows(&self) -> Option<&[(f64, Vec<f64>)]> {
        match self {
            Self::Completed { rows, .. } => Some(rows),
            _ => None,
        }
    }
}

thread_local! {
    /// Message of the last panic of this thread.
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Stores messages of panics instead of printing them, for the whole program.
pub fn keep_panics() {
    std::panic::set_hook(Box::new(|info| {
        LAST_PANIC.with(|last| *last.borrow_mut() = info.to_string().replace('\n', " "));
    }));
}

/// Runs a scene with a method and a step [s].
#[must_use]
pub fn run(scene: &str, method: &str, step: f64, options: Options) -> Ran {
    let integrator = if method == EXTRAPOLATED { "gbs" } else { "trapezoidal" };
    let is_extrapolated = method == EXTRAPOLATED;
    let formulation = if is_extrapolated { FormulationKind::RELATIVE.name() } else { method };
    let takes_penalty = FormulationKind::of_name(formulation).and_then(|f| f.scene_penalty());
    let overrides = Method {
        formulation: Some(formulation.to_owned()),
        integrator: Some(integrator.to_owned()),
        precision: options.is_single.then(|| "f32".to_owned()),
        step: Some(step),
        tolerance: is_extrapolated.then_some(1e-13),
        penalty: options.penalty.filter(|_| takes_penalty.is_some()),
        ..Method::default()
    };
    match catch_unwind(AssertUnwindSafe(|| go(scene, &overrides))) {
        Ok(ran) => ran,
        Err(_) => {
            Ran::Broken(format!("a panic: {}", LAST_PANIC.with(|last| last.borrow().clone())))
        }
    }
}

/// Name of the method of extrapolated reference runs.
pub const EXTRAPOLATED: &str = "extrapolated";

fn go(scene: &str, overrides: &Method) -> Ran {
    let document = match SceneFile::from_bytes(scene.as_bytes(), "case.toml") {
        Ok(document) => document,
        Err(error) => return Ran::Broken(format!("refused: {}", error.render())),
    };
    let mechanism = match Mechanism::of_file(document) {
        Ok(mechanism) => mechanism,
        Err(error) => return Ran::Broken(format!("refused: {}", error.render())),
    };
    let result = match mbs::run(&mechanism, &Run::new().method(overrides.clone())) {
        Ok(result) => result,
        Err(error) => return Ran::Broken(format!("refused: {error}")),
    };
    let outcome = result.outcome();
    if !outcome.rows().iter().flat_map(|(_, row)| row).all(|x| x.is_finite()) {
        return Ran::Broken("a row that is not finite".to_owned());
    }
    let summary = &outcome.summary;
    match (&summary.error, summary.completed) {
        (Some(error), false) if error.message.is_empty() || error.hint.is_empty() => {
            Ran::Broken(format!("the error `{}` does not say what to do", error.code))
        }
        (Some(error), false) => Ran::Stopped { code: error.code.clone(), time: summary.end_time },
        (None, true) => {
            let balance = &summary.energy;
            let rounding = 1e-6 * balance.initial.abs();
            if balance.final_error > MOST_ENERGY * balance.turned_over + rounding {
                let (error, turned) = (balance.final_error, balance.turned_over);
                return Ran::Broken(format!("the energy is off by {error:e} of {turned:e} J"));
            }
            let is_off = balance.max_error > rounding;
            let energy = if is_off { balance.max_error / balance.turned_over } else { 0.0 };
            let violation = summary.violation.position;
            Ran::Completed { rows: outcome.rows().to_vec(), violation, energy }
        }
        (error, _) => Ran::Broken(format!("completed and not: {error:?}")),
    }
}
