//! Remedy for a run that stopped: other formulations, integrators and steps are tried, and the first that completes is named.
//!
//! Each trial has a limit of iterations and steps, by their nominal times. No clock is read, so every machine names the same method.

use crate::estimate::purse::nominal_step;
use crate::stretches::stretches;
use core::ops::ControlFlow;
use mbs::inside::{Alarm, continue_if, drive};
use mbs::typed::{Simulation, StepObserver};
use mbs::{FormulationKind, IntegratorKind, Method, Outcome, Precision, ResolvedMethod, StopError};
use mbs_core::control::Accepted;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::format::few;

/// Nominal time of a trial [s]. All trials together take about a second at most, which is acceptable after a run that stopped. Chosen, not
/// tuned.
const A_TRIAL: f64 = 0.15;
/// Step of the last trial, relative to that of the run [-].
const SHORTER: f64 = 0.1;

/// Methods that are tried, in this order. A spanning tree avoids errors of closing equations, and controlled steps resolve events that fixed
/// steps miss.
const OTHERS: [(FormulationKind, IntegratorKind); 7] = [
    (FormulationKind::RELATIVE, IntegratorKind::Trapezoidal),
    (FormulationKind::MultiIndex, IntegratorKind::Trapezoidal),
    (FormulationKind::RELATIVE, IntegratorKind::Radau5),
    (FormulationKind::StateSpace, IntegratorKind::Trapezoidal),
    (FormulationKind::Index3, IntegratorKind::Trapezoidal),
    (FormulationKind::Index1, IntegratorKind::Trapezoidal),
    (FormulationKind::Classical, IntegratorKind::Trapezoidal),
];

/// Tries other methods after a run has stopped in its motion. The first method that completes is named before the hint of the run's error.
///
/// `scene` is the scene in `f64`, `method` the requested method, and `settings` those of the run. Nothing is tried for a run in another
/// precision. Nothing is tried either if the start, the scene or an observer is the reason of the stop.
///
/// Cost: at most 0.15 s of nominal time for each of eight trials.
pub fn name_what_runs(
    scene: &Scene<f64>,
    (method, settings): (&Method, &ResolvedMethod),
    outcome: &mut Outcome,
) {
    let Some(StopError::Step(..) | StopError::Energy { .. } | StopError::Friction { .. }) =
        outcome.error
    else {
        return;
    };
    if settings.precision != Precision::F64 {
        return;
    }
    let end = outcome.summary.end_time;
    let tried = match scene.dimension {
        Dimension::Planar => first::<2>(scene, (method, settings), end),
        Dimension::Spatial => first::<3>(scene, (method, settings), end),
    };
    if let (Some(words), Some(error)) = (tried, &mut outcome.summary.error) {
        error.hint = format!("{words}; else {}", error.hint);
    }
}

/// Returns the first method that completes, otherwise the one that gets furthest beyond the time of the stop.
fn first<const D: usize>(
    scene: &Scene<f64>,
    (method, ran): (&Method, &ResolvedMethod),
    stopped: f64,
) -> Option<String> {
    let mut beyond: Option<(f64, String)> = None;
    for (name, settings) in candidates(scene, (method, ran)) {
        if ran.interrupt.is_set() {
            return None;
        }
        let (reached, ended) = trial::<D>(scene, &settings);
        if reached >= settings.duration && ended {
            return Some(format!("{name}, which was tried, runs to the end"));
        }
        let is_further = beyond.as_ref().is_none_or(|(t, _)| reached > *t);
        if ended && reached > stopped + settings.step_max && is_further {
            beyond = Some((reached, name));
        }
    }
    let (reached, name) = beyond?;
    let reached = few(reached);
    Some(format!("{name} was tried to t = {reached} s, and runs there"))
}

/// Methods that the scene allows, without the one that stopped, each with its name.
fn candidates(
    scene: &Scene<f64>,
    (method, ran): (&Method, &ResolvedMethod),
) -> Vec<(String, ResolvedMethod)> {
    let asked = |formulation: FormulationKind, integrator: IntegratorKind| Method {
        formulation: Some(formulation.name().to_owned()),
        integrator: Some(integrator.name().to_owned()),
        step_control: None,
        energy_tolerance: None,
        error_tolerance: None,
        penalty: None,
        tolerance: None,
        threads: None,
        ..method.clone()
    };
    let words = |(formulation, integrator): (FormulationKind, IntegratorKind)| match integrator {
        IntegratorKind::Trapezoidal => format!("formulation {}", formulation.name()),
        other => format!("formulation {} with integrator {}", formulation.name(), other.name()),
    };
    let is_other = |settings: &ResolvedMethod| {
        (settings.formulation, settings.integrator, settings.rule)
            != (ran.formulation, ran.integrator, ran.rule)
    };
    let others = OTHERS.iter().filter_map(|&(formulation, integrator)| {
        let settings = ResolvedMethod::new(scene, &asked(formulation, integrator)).ok()?;
        is_other(&settings).then(|| (words((formulation, integrator)), settings))
    });
    let shorter = Method {
        step: Some(SHORTER * ran.step),
        step_max: method.step_max.map(|step| SHORTER * step),
        ..method.clone()
    };
    let shorter = ResolvedMethod::new(scene, &shorter).ok();
    let shorter = shorter.map(|settings| (format!("step {} s", few(settings.step)), settings));
    others.chain(shorter).collect()
}

/// Returns the time that a method reaches [s], and true if it reached the end or its work limit without an error.
fn trial<const D: usize>(scene: &Scene<f64>, settings: &ResolvedMethod) -> (f64, bool) {
    let Ok(mut simulation) = Simulation::<f64, D>::new(scene, settings) else {
        return (0.0, false);
    };
    let [coordinates, constraints, _] = simulation.sizes();
    let one = nominal_step(settings.formulation, (coordinates + constraints) as f64);
    let stretches = stretches(scene, settings, simulation.is_controlled());
    let mut watch = Watch { alarm: Alarm::new(settings.energy_alarm), left: A_TRIAL / one };
    let end = drive(&mut simulation, stretches, &settings.interrupt, &mut watch);
    (simulation.state().t, end.is_ok())
}

/// Observer that counts the work of a trial and checks its energy alarm.
struct Watch {
    alarm: Alarm,
    /// Number of iterations and steps that are left.
    left: f64,
}

impl<const D: usize> StepObserver<f64, D> for Watch {
    fn step(
        &mut self,
        now: &Simulation<f64, D>,
        accepted: &Accepted<f64>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        if let Some(stop) = self.alarm.rings(now, is_last) {
            return Err(stop);
        }
        let report = &accepted.attempt.report;
        self.left -= f64::from(report.iterations) + f64::from(report.steps);
        Ok(continue_if(self.left > 0.0))
    }
}
