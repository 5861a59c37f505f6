//! Letters by rule, from the ratio of a method's number to the best one.

/// A grade. "A means outstanding, B good, C fair, D poor and F signifies a failure" (the report).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Letter {
    A,
    B,
    C,
    D,
    F,
}

impl Letter {
    /// Returns the letter as it is printed.
    pub(crate) const fn symbol(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::D => "D",
            Self::F => "F",
        }
    }

    /// Letter of a ratio to the best number, where smaller is better. A is up to the first limit, B up to the second, and so on. A
    /// missing ratio is a failure.
    pub(crate) fn of_ratio(ratio: Option<f64>, limits: [f64; 3]) -> Self {
        let Some(ratio) = ratio.filter(|ratio| ratio.is_finite()) else { return Self::F };
        let [a, b, c] = limits;
        if ratio <= a {
            Self::A
        } else if ratio <= b {
            Self::B
        } else if ratio <= c {
            Self::C
        } else {
            Self::D
        }
    }
}

/// Ratios of the numbers to the smallest of all, where each number counts as at least `floor`; `None` for a method without a number.
pub(crate) fn over_best(numbers: &[Option<f64>], floor: f64) -> Vec<Option<f64>> {
    let lifted = |x: &Option<f64>| x.filter(|x| x.is_finite()).map(|x| x.max(floor));
    let best = numbers.iter().filter_map(lifted).fold(f64::INFINITY, f64::min);
    numbers.iter().map(|x| lifted(x).map(|x| x / best)).collect()
}

/// Geometric mean of the ratios; `None` if a number is missing.
pub(crate) fn mean(ratios: &[Option<f64>]) -> Option<f64> {
    let logs = ratios.iter().map(|x| x.map(f64::ln)).collect::<Option<Vec<_>>>()?;
    #[allow(clippy::cast_precision_loss, reason = "some scenes")]
    let n = logs.len() as f64;
    (n > 0.0).then(|| (logs.iter().sum::<f64>() / n).exp())
}

/// Largest of the ratios; `None` if a number is missing.
pub(crate) fn worst(ratios: &[Option<f64>]) -> Option<f64> {
    ratios.iter().copied().collect::<Option<Vec<_>>>()?.into_iter().reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_fall_at_their_limits_and_a_missing_number_is_a_failure() {
        let letter = |x| Letter::of_ratio(x, [2.0, 4.0, 8.0]).symbol();
        let ratios = [Some(1.0), Some(2.0), Some(2.1), Some(8.0), Some(9.0), None, Some(f64::NAN)];
        assert_eq!(ratios.map(letter), ["A", "A", "B", "C", "D", "F", "F"]);
    }

    #[test]
    fn numbers_below_the_floor_are_equal() {
        let ratios = over_best(&[Some(1e-14), Some(1e-12), Some(4e-12), None], 1e-12);
        assert_eq!(ratios, [Some(1.0), Some(1.0), Some(4.0), None]);
    }

    #[test]
    fn a_missing_number_leaves_no_mean_and_no_worst() {
        assert!((mean(&[Some(2.0), Some(8.0)]).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(worst(&[Some(2.0), Some(8.0)]), Some(8.0));
        assert_eq!((mean(&[Some(2.0), None]), worst(&[None]), mean(&[])), (None, None, None));
    }
}
