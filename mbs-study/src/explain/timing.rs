//! CPU time per step, the least of several interleaved repeats.

use cpu_time::ThreadTime;
use mbs::ResolvedMethod;
use mbs::typed::Simulation;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Least steps of a timing. Chosen, not tuned.
const FEWEST_STEPS: u64 = 10;
/// Most steps of a trial run [-], and its longest time [s]. Chosen, not tuned.
const TRIAL: (u64, f64) = (200, 0.05);

/// TrialTimes of one scene over the repeats.
#[derive(Debug, Clone, Default)]
pub struct TrialTimes(pub Vec<f64>);

impl TrialTimes {
    /// The least [s per step].
    pub fn best(&self) -> Option<f64> {
        self.0.iter().copied().min_by(f64::total_cmp)
    }

    /// Returns the distance of the second best time from the best, as a share of it.
    pub fn noise(&self) -> Option<f64> {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let [best, next] = *sorted.first_chunk()?;
        (best > 0.0).then(|| (next - best) / best)
    }
}

/// TrialTimes every scene for `n` steps from its start, `repeats` rounds in turn, so that what disturbs a while meets all alike.
pub(super) fn interleaved<T: Real, const D: usize>(
    scenes: &[Scene<T>],
    settings: &ResolvedMethod,
    (n, repeats): (u64, u32),
) -> Vec<TrialTimes> {
    let mut times = vec![TrialTimes::default(); scenes.len()];
    for _ in 0..repeats {
        for (scene, times) in scenes.iter().zip(&mut times) {
            times.0.extend(once::<T, D>(scene, settings, n));
        }
    }
    times
}

/// CPU time per step; nothing where there is no start or the run stops at once.
fn once<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    n: u64,
) -> Option<f64> {
    let mut simulation = Simulation::<T, D>::new(scene, settings).ok()?;
    let clock = ThreadTime::now();
    let done = steps(&mut simulation, settings.step_max, n, || true);
    let seconds = clock.elapsed().as_secs_f64();
    (done >= FEWEST_STEPS.min(n)).then(|| seconds / done as f64)
}

/// CPU time per step of watching the energy invariant, the least of the repeats: the energies of one state, taken again and
/// again.
pub(super) fn monitor<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    (n, repeats): (u64, u32),
) -> Option<f64> {
    let mut simulation = Simulation::<T, D>::new(scene, settings).ok()?;
    simulation.advance(T::from_f64(settings.step)).ok()?;
    let mut invariant = *simulation.invariant();
    let once = |_| {
        let clock = ThreadTime::now();
        for k in 0..n {
            let energies = core::hint::black_box(&mut simulation).watched_energies();
            core::hint::black_box(invariant.change(energies));
            invariant.mark(k as f64, energies);
        }
        clock.elapsed().as_secs_f64() / n.max(1) as f64
    };
    (0..repeats).map(once).min_by(f64::total_cmp)
}

/// CPU time that the start takes, and that of a step, roughly [s].
pub(super) fn trial<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
) -> Option<[f64; 2]> {
    let clock = ThreadTime::now();
    let mut simulation = Simulation::<T, D>::new(scene, settings).ok()?;
    let start = clock.elapsed().as_secs_f64();
    let clock = ThreadTime::now();
    let has_time = || clock.elapsed().as_secs_f64() < TRIAL.1;
    let n = TRIAL.0.min(settings.n_steps());
    let done = steps(&mut simulation, settings.step_max, n, has_time);
    Some([start, clock.elapsed().as_secs_f64() / done.max(1) as f64])
}

/// Steps until `n`, a failure or a word; gives the number of those made.
fn steps<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    h: f64,
    n: u64,
    has_time: impl Fn() -> bool,
) -> u64 {
    let dt = T::from_f64(h);
    for k in 0..n {
        if !has_time() || simulation.step(dt).is_err() {
            return k;
        }
        simulation.set_time(T::from_f64((k + 1) as f64 * h));
    }
    n
}
