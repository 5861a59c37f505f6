//! CPU time at an error, between the runs of one method.

/// A completed run: its error, and CPU times that are to be interpolated [s].
pub(super) type Point<const N: usize> = (f64, [f64; N]);

/// The runs beside an error: the last that misses it, the first that reaches it, by their indices, and where between them it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beside {
    pub(super) misses: Option<usize>,
    pub(super) reaches: usize,
    /// 1 at the run that reaches it.
    share: f64,
}

/// The runs beside an error on the front of runs with these errors, which go from the coarsest to the finest. Where no run misses
/// it, the coarsest one reaches it. Nothing where none does.
///
/// An error that is smaller by luck counts for nothing: a run is credited with that of the next finer one if that is larger. The
/// front is chosen by the errors and by that order alone: times have noise, and would choose another one each time.
pub(super) fn beside(errors: &[f64], level: f64) -> Option<Beside> {
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
pub(super) fn at_error<const N: usize>(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_interpolated_between_the_runs_beside_the_error() {
        // error h^2, time 1/h
        let points: Vec<Point<1>> = [1e-1, 1e-2, 1e-3].map(|h| (h * h, [1.0 / h])).to_vec();
        let [t] = at_error(&points, 1e-5, |_, _| true).unwrap();
        assert!((t - 10.0 * f64::sqrt(10.0) * 10.0).abs() < 1e-9 * t, "{t}");
        let [t] = at_error(&points, 0.5, |_, _| true).unwrap();
        assert!((t - 10.0).abs() < 1e-9, "the coarsest run reaches it: {t}");
        let [t] = at_error(&points, 1e-5, |_, _| false).unwrap();
        assert!((t - 1000.0).abs() < 1e-9, "nothing lies between the runs: {t}");
        assert_eq!(at_error(&points, 1e-7, |_, _| true), None);
    }

    #[test]
    fn an_error_that_is_small_by_luck_counts_for_nothing() {
        // the second run is better than its neighbours, the last two are on the way to rounding
        let errors = [1e-1, 1e-5, 2e-2, 1e-3, 1e-4, 2e-4];
        let of = |level| beside(&errors, level).map(|b| (b.misses, b.reaches));
        assert_eq!(of(1e-2), Some((Some(1), 3)));
        assert_eq!(of(3e-4), Some((Some(3), 4)));
        assert_eq!(of(1.5e-4), None);
        assert_eq!(of(0.5), Some((None, 0)));
        let [t] = at_error(&[(1e-2, [1.0]), (0.0, [3.0])], 1e-3, |_, _| true).unwrap();
        assert!((t - 3.0).abs() < 1e-12);
    }
}
