//! CPU time at an error, between the runs of one method.

/// A completed run: its error, and CPU times that are to be interpolated [s].
pub(super) type Point<const N: usize> = (f64, [f64; N]);

/// CPU times at an error, by interpolation of logarithms on the front of the runs, which go from the coarsest to the finest; the
/// times of the coarsest run that reaches the error where no coarser one misses it. Nothing where none reaches it.
///
/// The front is chosen by the errors and by that order alone: times have noise, and would choose another one each time.
pub(super) fn at_error<const N: usize>(points: &[Point<N>], level: f64) -> Option<[f64; N]> {
    let mut front: Vec<Point<N>> = Vec::new();
    for &(error, times) in points {
        if front.last().is_none_or(|(best, _)| error < *best) {
            front.push((error, times));
        }
    }
    let reached = front.iter().position(|(error, _)| *error <= level)?;
    let (fine, after) = front[reached];
    let Some((coarse, before)) = reached.checked_sub(1).map(|i| front[i]) else {
        return Some(after);
    };
    // an error of zero lies at the end of every line
    let share = if fine > 0.0 { libm::log(coarse / level) / libm::log(coarse / fine) } else { 1.0 };
    let mut times = after;
    for (time, start) in times.iter_mut().zip(before) {
        *time = libm::exp(libm::log(start) + share * (libm::log(*time) - libm::log(start)));
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
        let [t] = at_error(&points, 1e-5).unwrap();
        assert!((t - 10.0 * f64::sqrt(10.0) * 10.0).abs() < 1e-9 * t, "{t}");
        assert_eq!(at_error(&points, 0.5), Some([1.0 / 1e-1]));
        assert_eq!(at_error(&points, 1e-7), None);
    }

    #[test]
    fn a_run_that_is_no_better_than_a_coarser_one_is_not_on_the_front() {
        let points = [(1e-2, [1.0]), (1e-1, [2.0]), (1e-4, [4.0])];
        let [t] = at_error(&points, 1e-3).unwrap();
        assert!((t - 2.0).abs() < 1e-12, "{t}");
        let [t] = at_error(&[(1e-2, [1.0]), (0.0, [3.0])], 1e-3).unwrap();
        assert!((t - 3.0).abs() < 1e-12);
    }
}
