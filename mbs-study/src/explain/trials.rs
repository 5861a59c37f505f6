//! Runs of a scene for the costs of its effects: limits of the effort, and runs without some effects.

use mbs::ResolvedMethod;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Limits of the measurements. If a scene would take more, a shorter part of its run is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Largest number of steps of a timed run, at least 1.
    pub timed_steps: u64,
    /// Number of timings of each run, interleaved with those of the other runs. At least 2 timings are needed to measure the noise.
    pub repeats: u32,
    /// Time limit of all measurements [s]. Results for which no time is left are reported as not measured. The limit must be positive.
    pub seconds: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { timed_steps: 2000, repeats: 5, seconds: 10.0 }
    }
}

/// Returns the scene with some effects switched off.
pub(super) fn without<T: Real>(scene: &Scene<T>, effects: &[usize]) -> Scene<T> {
    let mut scene = scene.clone();
    for &i in effects {
        scene.effects[i].enabled = false;
    }
    scene
}

/// Runs a scene as `mbs run` does, with another duration or step.
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
