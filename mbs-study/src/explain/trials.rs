//! Runs of a scene for its prices: how much may be measured, and what a run without some effects gives.

use mbs::ResolvedMethod;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Limits of what is measured. A scene that asks for more is measured over a shorter part of its run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Steps of a timed run at most. `≥ 1`.
    pub timed_steps: u64,
    /// Number of timings of each run, one after the other in turn. `≥ 2`, so that there is a spread.
    pub repeats: u32,
    /// Time for everything [s]; what no time is left for is said to be not measured. `> 0`.
    pub seconds: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { timed_steps: 2000, repeats: 5, seconds: 10.0 }
    }
}

/// The scene with some effects switched off.
pub(super) fn without<T: Real>(scene: &Scene<T>, effects: &[usize]) -> Scene<T> {
    let mut scene = scene.clone();
    for &i in effects {
        scene.effects[i].enabled = false;
    }
    scene
}

/// The run of a scene as `mbs run` makes it, over another duration or with another step.
pub(super) fn outcome<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    (times_step, duration): (f64, f64),
) -> mbs::Outcome {
    let settings = ResolvedMethod {
        step: settings.step * times_step,
        step_max: settings.step_max * times_step,
        duration,
        ..settings.clone()
    };
    mbs::typed::run::<T, D>(scene, &settings, &mut ())
}
