//! Costs of effects, measured by the same run with and without an effect.

use super::explanation::{EffectCost, EffectCosts};
use super::reach::largest_step;
use super::timing::{TrialTimes, interleaved, monitor, trial};
use super::trials::{Effort, outcome, without};
use mbs::inside::OutputRanges;
use mbs::record::RunError;
use mbs::{Outcome, ResolvedMethod};
use mbs_core::Real;
use mbs_core::scene::Scene;
use std::time::Instant;

/// Ratio of the time of a recorded step to that of a step without recording [-]. Chosen, not tuned.
const RECORDED: f64 = 2.0;
/// Smallest number of steps of a shortened run. Chosen, not tuned.
const FEWEST_STEPS: u64 = 50;

/// Effects that are left out together.
struct Leave {
    effects: Vec<usize>,
    kind: &'static str,
    is_kind: bool,
}

/// Measures the costs of all effects. Also returns the reason if the run with all effects stopped.
pub(super) fn prices<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    effort: &Effort,
) -> (EffectCosts, Option<RunError>) {
    let clock = Instant::now();
    let has_time = || clock.elapsed().as_secs_f64() < effort.seconds;
    let leaves = leaves(scene);
    let mut scenes = vec![scene.clone()];
    scenes.extend(leaves.iter().map(|leave| without(scene, &leave.effects)));
    let plan = Plan::new::<T, D>(&scenes[0], settings, (effort, scenes.len()));

    let rounds = (plan.timed_steps, effort.repeats);
    let times = interleaved::<T, D>(&scenes, settings, rounds);
    let run = |scene| outcome::<T, D>(scene, settings, (1.0, plan.duration));
    let with_all = run(scene);
    let reach = |scene: &Scene<T>, run: &Outcome| {
        let run = (plan.duration, run.summary.completed);
        largest_step::<T, D>(scene, settings, run, &has_time)
    };
    let mut prices = EffectCosts {
        timed_steps: plan.timed_steps,
        repeats: effort.repeats,
        seconds_per_step: times[0].best(),
        monitor_seconds_per_step: monitor::<T, D>(&scenes[0], settings, rounds),
        compared_duration: plan.duration,
        completed: with_all.summary.completed,
        iterations_per_step: iterations(&with_all),
        largest_step: reach(scene, &with_all),
        ..EffectCosts::default()
    };
    let outputs = OutputRanges::new(scene, &with_all);
    for ((leave, scene), own) in leaves.iter().zip(&scenes[1..]).zip(&times[1..]) {
        let outcome = run(scene);
        let price = EffectCost {
            names: leave.effects.iter().map(|&i| scene.effects[i].name.clone()).collect(),
            kind: leave.kind.to_owned(),
            completed: outcome.summary.completed,
            iterations_per_step: iterations(&outcome),
            largest_step: reach(scene, &outcome),
            changes: outputs.changes(&outcome),
            error: outcome.summary.error,
            ..share(&times[0], own)
        };
        if leave.is_kind { &mut prices.kinds } else { &mut prices.effects }.push(price);
    }
    (prices, with_all.summary.error)
}

/// Lists each enabled effect alone, then each kind that has several effects.
fn leaves<T: Real>(scene: &Scene<T>) -> Vec<Leave> {
    let enabled = || scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled);
    let alone = |(i, effect): (usize, &mbs_core::scene::Effect<T>)| Leave {
        effects: vec![i],
        kind: effect.kind.name(),
        is_kind: false,
    };
    let mut leaves: Vec<Leave> = enabled().map(alone).collect();
    let mut seen: Vec<&str> = Vec::new();
    for (_, effect) in enabled() {
        let kind = effect.kind.name();
        let of_kind = enabled().filter(|(_, other)| other.kind.name() == kind);
        let effects: Vec<usize> = of_kind.map(|(i, _)| i).collect();
        if effects.len() > 1 && !seen.contains(&kind) {
            seen.push(kind);
            leaves.push(Leave { effects, kind, is_kind: true });
        }
    }
    leaves
}

/// Lengths of the runs: steps of a timed run, and duration of a compared run [s].
struct Plan {
    timed_steps: u64,
    duration: f64,
}

impl Plan {
    /// Divides the time into thirds: one for timing, one for the comparison, and one for longer steps.
    fn new<T: Real, const D: usize>(
        scene: &Scene<T>,
        settings: &ResolvedMethod,
        (effort, n_scenes): (&Effort, usize),
    ) -> Self {
        let n_steps = settings.n_steps();
        let [start, step] = trial::<T, D>(scene, settings).unwrap_or([0.0; 2]);
        let each = effort.seconds / 3.0 / n_scenes as f64;
        // the requested number of steps is halved until it fits; halving usually gives the same number on every machine
        let fit = |mut n: u64, takes: &dyn Fn(u64) -> f64| {
            while n > FEWEST_STEPS && takes(n) > each {
                n = n.div_ceil(2);
            }
            n
        };
        let repeats = f64::from(effort.repeats);
        let timed = fit(n_steps.min(effort.timed_steps), &|n| repeats * (start + n as f64 * step));
        let compared = fit(n_steps, &|n| start + RECORDED * n as f64 * step);
        let duration = if compared == n_steps {
            settings.duration
        } else {
            settings.duration.min(compared as f64 * settings.step_max)
        };
        Self { timed_steps: timed, duration }
    }
}

/// Computes the fraction 1 − without / with, and the larger noise of both times.
fn share(with_all: &TrialTimes, without: &TrialTimes) -> EffectCost {
    let share = with_all.best().zip(without.best()).map(|(with, without)| 1.0 - without / with);
    let noise = with_all.noise().zip(without.noise()).map(|(a, b)| a.max(b));
    EffectCost {
        seconds_per_step: without.best(),
        share,
        noise,
        below_noise: share.zip(noise).map(|(share, noise)| share.abs() <= noise),
        ..EffectCost::default()
    }
}

/// Returns the mean iterations per step.
fn iterations(outcome: &Outcome) -> f64 {
    outcome.summary.iterations as f64 / outcome.summary.steps.max(1) as f64
}
