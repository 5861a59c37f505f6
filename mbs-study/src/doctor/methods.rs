//! Formulations that can step a scene with dependent equations. Each makes one step.

use super::finding::{Finding, Severity, Topic};
use mbs::typed::Simulation;
use mbs::{FormulationKind, IntegratorKind, ResolvedMethod, StepRule, StopError};
use mbs_core::scene::Scene;

/// First step by one formulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// Name of the formulation.
    pub formulation: &'static str,
    /// Reason why the formulation could not make the step: code and message.
    pub error: Option<(&'static str, String)>,
}

/// Largest number of bodies of a scene for which methods are tried; larger ones take too long. Chosen, not tuned.
const LARGEST: usize = 300;

pub(super) fn try_all<const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
) -> Vec<Attempt> {
    if scene.bodies.len() > LARGEST {
        return Vec::new();
    }
    let attempt = |formulation: FormulationKind| {
        let settings = ResolvedMethod {
            formulation,
            integrator: IntegratorKind::Trapezoidal,
            rule: StepRule::Fixed,
            step_max: settings.step,
            penalty: None,
            threads: 1,
            ..settings.clone()
        };
        let error = first_step::<D>(scene, &settings).err();
        Attempt { formulation: formulation.name(), error: error.map(|e| (e.code(), e.to_string())) }
    };
    FormulationKind::ALL.map(attempt).to_vec()
}

fn first_step<const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
) -> Result<(), StopError> {
    let mut simulation = Simulation::<f64, D>::new(scene, settings)?;
    let step = simulation.advance(settings.step);
    step.map(drop).map_err(|error| simulation.explain(error))
}

/// Notes the formulations that run the scene in spite of dependent equations.
pub(super) fn findings(attempts: &[Attempt], findings: &mut Vec<Finding>) {
    let named = |is_refused: bool| {
        let of = attempts.iter().filter(|a| a.error.is_some() == is_refused);
        of.map(|a| a.formulation).collect::<Vec<_>>().join(", ")
    };
    let (run, refuse) = (named(false), named(true));
    if attempts.is_empty() {
        return;
    }
    if !run.is_empty() {
        for finding in findings.iter_mut().filter(|finding| finding.code == "singular-start") {
            finding.remedy += &format!(", or run it: a step was taken by {run}");
        }
    }
    let message = match (run.is_empty(), refuse.is_empty()) {
        (false, true) => format!("it is run anyway: a step was taken by {run}"),
        (false, false) => {
            format!("it is run anyway: a step was taken by {run}; refused by {refuse}")
        }
        (true, _) => format!("no formulation takes a step: refused by {refuse}"),
    };
    let severity = if run.is_empty() { Severity::Fault } else { Severity::Note };
    findings.push(Finding::new(severity, (Topic::Dependence, "who-runs-it"), message, ""));
}
