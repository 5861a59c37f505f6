//! CPU time at an error, between the runs of one method.

/// Point of a completed run: its error, and CPU times that are to be interpolated [s].
pub(super) type Point<const N: usize> = (f64, [f64; N]);

/// The runs beside an error: the last that misses it, the first that reaches it, by their indices, and where between them it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// The last run that misses it.
    pub misses: Option<usize>,
    /// The first run that reaches it.
    pub reaches: usize,
    /// 1 at the run that reaches it.
    share: f64,
}

/// The runs beside an error on the front of runs with these errors, which go from the coarsest to the finest. Where no run misses
/// it, the coarsest one reaches it. Nothing where none does.
///
/// An error that is smaller by luck counts for nothing: a run is credited with that of the next finer one if that is larger. The
/// front is chosen by the errors and by that order alone: times have noise, and would choose another one each time.
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
        // an error of zero lies at the end of every line
        if fine > 0.0 { libm::log(coarse / level) / libm::log(coarse / fine) } else { 1.0 }
    });
    Some(Beside { misses, reaches, share })
}

/// The error that a run counts with.
pub(super) fn credited(errors: &[f64], i: usize) -> f64 {
    errors[i].max(errors.get(i + 1).copied().unwrap_or(0.0))
}

/// CPU times at an error, by interpolation of logarithms between the runs beside it, where there are others between these two
/// (`has_between`, of their indices). Else they are those of the run that reaches it.
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
