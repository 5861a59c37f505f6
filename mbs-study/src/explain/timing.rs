//! CPU time per step, the shortest of several interleaved repeats.

use cpu_time::ThreadTime;
use mbs::ResolvedMethod;
use mbs::typed::Simulation;
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Smallest number of steps of a timing. Chosen, not tuned.
const FEWEST_STEPS: u64 = 10;
/// Largest number of steps of a trial run [-], and its longest time [s]. Chosen, not tuned.
const TRIAL: (u64, f64) = (200, 0.05);

/// CPU times per step of one scene, one for each repeat [s].
#[derive(Debug, Clone, Default)]
pub struct TrialTimes(pub Vec<f64>);

impl TrialTimes {
    /// Shortest time of a step [s].
    pub fn best(&self) -> Option<f64> {
        self.0.iter().copied().min_by(f64::total_cmp)
    }

    /// Returns the relative difference of the second shortest time from the shortest [-].
    pub fn noise(&self) -> Option<f64> {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        let [best, next] = *sorted.first_chunk()?;
        (best > 0.0).then(|| (next - best) / best)
    }
}

/// Times every scene for `n` steps from its start, in `repeats` rounds over all scenes. A temporary disturbance then affects all scenes
/// equally.
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

/// CPU time per step [s]; `None` if the scene does not start or stops at once.
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

/// CPU time per step for the energy invariant, the shortest of the repeats [s]. The energies of one state are computed repeatedly.
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

/// Estimated CPU time of the start and of a step [s].
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

/// Makes at most `n` steps, until a step fails or `has_time` is false. Returns the number of steps made.
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
