//! Explanation of a scene: simulated parts, missing effects, and the cost of each effect, measured by runs without it.
//!
//! ```text
//! share = 1 − (CPU time per step without it) / (CPU time per step with all effects)
//! ```

mod absent;
mod explanation;
mod price;
mod reach;
mod simulated;
pub(crate) mod timing;
mod trials;

pub use explanation::{
    ControllerStep, EffectCost, EffectCosts, EffectEntry, Explanation, GuideEntry, JointsByKind,
    LargestStep, MissingEffect, Relative, SearchEnd, Simulated, Sizes, ThinRod,
};
pub use trials::Effort;

use crate::auto::{Processor, plan};
use mbs::inside::{PreparedRun, SceneWork};
use mbs::typed::Simulation;
use mbs::{Mechanism, Names, ResolvedMethod, Run, SimulationError, StepRule, StopError};
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Explains the run of a mechanism. With a goal, the results of the pilot's trials are added. Returns `None` in double-double, because costs
/// are measured in numbers of the hardware only.
///
/// Cost: two assemblies for the sizes, and about `effort.seconds` for the costs of effects, less for small scenes.
///
/// # Errors
/// [`SimulationError`] for a mechanism or options that are refused.
pub fn explain_run(
    m: &Mechanism,
    options: &Run,
    effort: &Effort,
) -> Result<Option<Explanation>, SimulationError> {
    let run = PreparedRun::new(m, options)?;
    let plan = plan(&run, &mut Processor::new(run.settings.threads))?;
    let work = Explained { settings: &run.settings, effort };
    let explained = run.read()?.work_in_hardware(work);
    let choice = plan.first().choice.as_deref().cloned();
    Ok(explained.map(|explanation| match choice {
        Some(_) => Explanation { choice, ..explanation },
        None => explanation,
    }))
}

/// Task that explains a scene of any precision and dimension.
struct Explained<'a> {
    settings: &'a ResolvedMethod,
    effort: &'a Effort,
}

impl SceneWork for Explained<'_> {
    type Done = Explanation;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Explanation {
        explain::<T, D>(scene, self.settings, self.effort)
    }
}

/// Explains a checked scene.
///
/// Cost: two assemblies for the sizes, and about `effort.seconds` for the costs of effects, less for small scenes.
pub fn explain<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    effort: &Effort,
) -> Explanation {
    let explanation = Explanation {
        scene: scene.name.clone(),
        formulation: settings.asked.clone(),
        chosen: settings.chosen(),
        choice: crate::auto::candidates::<T, D>(scene, settings),
        integrator: settings.integrator.name().to_owned(),
        precision: settings.precision.name().to_owned(),
        dimension: scene.dimension.count(),
        step: settings.step,
        duration: settings.duration,
        simulated: simulated::simulated::<T, D>(scene, settings),
        effects: effects(scene),
        absent: absent::absent(scene),
        ..Explanation::default()
    };
    // costs cannot be measured for a scene without a start
    if let Err(error) = start::<T, D>(scene, settings) {
        let error = Some(error.report(0.0, &Names::new(scene)));
        return Explanation { error, ..explanation };
    }
    // runs with fixed steps are used, since runs are compared row by row
    let fixed =
        ResolvedMethod { rule: StepRule::Fixed, step_max: settings.step, ..settings.clone() };
    let settings = if settings.rule == StepRule::Fixed { settings } else { &fixed };
    let (prices, error) = price::prices::<T, D>(scene, settings, effort);
    Explanation { prices: Some(prices), error, ..explanation }
}

/// Checks that the run starts, including its outputs.
fn start<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
) -> Result<(), StopError> {
    let simulation = Simulation::<T, D>::new(scene, settings)?;
    mbs::inside::Channels::new(scene, simulation.model()).map(drop)
}

fn effects<T: Real>(scene: &Scene<T>) -> Vec<EffectEntry> {
    let entry = |effect: &mbs_core::scene::Effect<T>| EffectEntry {
        name: effect.name.clone(),
        kind: effect.kind.name().to_owned(),
        enabled: effect.enabled,
    };
    scene.effects.iter().map(entry).collect()
}
