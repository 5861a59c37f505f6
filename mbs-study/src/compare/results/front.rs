//! CPU time at an error, interpolated between runs of one method.

/// Completed run: its error, and its CPU times for interpolation [s].
pub(super) type Point<const N: usize> = (f64, [f64; N]);

/// Runs around an error, by their indices, and the position of the error between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// Last run whose error is too large, if there is one.
    pub misses: Option<usize>,
    /// First run that reaches the error.
    pub reaches: usize,
    /// Position of the error on the logarithmic line between the two runs [-]: 1 at the run that reaches it.
    share: f64,
}

/// Finds the runs around an error. `errors` are those of runs from the coarsest to the finest. If no run misses the error, the coarsest one
/// reaches it. `None` if no run reaches it.
///
/// An error that is small by chance does not count: a run is credited with at least the error of the next finer run. The selection depends on
/// errors and order only. With times it would depend on their noise.
pub fn beside(errors: &[f64], level: f64) -> Option<Beside> {
    let credited = |i: usize| credited(errors, i);
    let mut front: Vec<usize> = Vec::new();
    for i in 0..errors.len() {
        if front.last().is_none_or(|&best| credited(i) < credited(best)) {
            front.push(i);
        }
    }
    let place = front.iter().position(|&i| credited(i) <= level)?;
    let reaches = front[place];
    let misses = place.checked_sub(1).map(|before| front[before]);
    let share = misses.map_or(1.0, |coarse| {
        let (coarse, fine) = (credited(coarse), credited(reaches));
        // an error of zero is infinitely far on a logarithmic line: the time is that of the run that reaches it
        if fine > 0.0 { libm::log(coarse / level) / libm::log(coarse / fine) } else { 1.0 }
    });
    Some(Beside { misses, reaches, share })
}

/// Error that a run is credited with: at least that of the next finer run.
pub(super) fn credited(errors: &[f64], i: usize) -> f64 {
    errors[i].max(errors.get(i + 1).copied().unwrap_or(0.0))
}

/// CPU times at an error. They are interpolated logarithmically between the two runs around the error, if further runs are possible between
/// these (`has_between`, by their indices). Otherwise they are those of the run that reaches the error.
pub fn at_error<const N: usize>(
    points: &[Point<N>],
    level: f64,
    has_between: impl Fn(usize, usize) -> bool,
) -> Option<[f64; N]> {
    let errors: Vec<f64> = points.iter().map(|(error, _)| *error).collect();
    let beside = beside(&errors, level)?;
    let mut times = points[beside.reaches].1;
    let coarse = beside.misses.filter(|&i| has_between(i, beside.reaches));
    let before = coarse.map_or(times, |i| points[i].1);
    for (time, start) in times.iter_mut().zip(before) {
        *time = libm::exp(libm::log(start) + beside.share * (libm::log(*time) - libm::log(start)));
    }
    Some(times)
}
