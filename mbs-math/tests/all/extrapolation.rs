//! Extrapolation of the midpoint rule: its order, its number of evaluations, and the digits that it reaches.

use core::convert::Infallible;
use mbs_math::Real;
use mbs_math::ode::{Adaptive, EndState, Extrapolation, Method, Options, Rates};
use mbs_math::real::DoubleDouble as Pair;

/// The oscillator with the solution y = (cos t, −sin t). It counts the evaluations of its rates.
struct Oscillator(u64);

impl Rates<Pair> for Oscillator {
    type Error = Infallible;
    fn n(&self) -> usize {
        2
    }
    fn rates(&mut self, _: Pair, y: &[Pair], dy: &mut [Pair]) -> Result<(), Infallible> {
        self.0 += 1;
        (dy[0], dy[1]) = (y[1], -y[0]);
        Ok(())
    }
}

const START: [Pair; 2] = [Pair::ONE, Pair::ZERO];

fn off(t: Pair, y: &[Pair]) -> f64 {
    let (sine, cosine) = t.sin_cos();
    (y[0] - cosine).abs().max((y[1] + sine).abs()).to_f64()
}

/// Error of one step with `k` columns, and its error estimate for tolerances of one.
fn one_step(k: usize, h: f64) -> [f64; 2] {
    let (mut method, h) = (Extrapolation::new(k), Pair::from_f64(h));
    let mut scratch = vec![Pair::ZERO; Method::<Pair>::n_scratch(&method, 2)];
    let (mut system, options) =
        (Oscillator(0), Options { relative: Pair::ZERO, ..Options::new(Pair::ONE) });
    let step = (Pair::ZERO, h);
    let Ok(estimate) = method.trial(&mut system, step, &START, false, (&options, &mut scratch));
    assert_eq!(system.0, Method::<Pair>::evaluations(&method, false));
    [off(h, method.new_state(2, &scratch)), estimate.to_f64()]
}

/// With half the step the error is smaller by 2^(2k+1) and the estimate by 2^(2k−1). Later terms change these ratios by up to a tenth. With
/// 8 columns the error would be 1e-31, where rounding errors dominate.
#[test]
fn k_columns_have_order_2k_and_an_estimate_of_order_2k_less_two() {
    for k in 3..=7 {
        let (coarse, fine) = (one_step(k, 0.2), one_step(k, 0.1));
        let power = 2 * k as i32;
        for (i, power) in [power + 1, power - 1].into_iter().enumerate() {
            let ratio = coarse[i] / fine[i] / 2f64.powi(power);
            assert!((ratio - 1.0).abs() < 0.1, "{k} columns: {ratio} of 2^{power}");
        }
    }
}

/// Integrates ten units of time with all digits of double-double numbers, except those lost by some hundred roundings.
#[test]
fn the_last_digits_of_pairs_are_reached() {
    let tolerance = Pair::from_f64(1e-28);
    let method = Extrapolation::for_tolerance(tolerance);
    let mut driver = Adaptive::new(method, Pair::from_f64(0.1));
    let (mut system, mut y) = (Oscillator(0), START);
    let mut scratch = vec![Pair::ZERO; Extrapolation::most_scratch(2)];
    let length = Pair::from_f64(10.0);
    driver
        .advance(
            &mut system,
            (Pair::ZERO, length),
            (&mut y, &mut scratch),
            &Options::new(tolerance),
            |_, _, _| Ok(EndState::Kept),
        )
        .expect("steps");
    let (error, counts) = (off(length, &y), driver.counts());
    assert!(error < 1e-27, "{error:e} in {counts:?}");
    assert_eq!(system.0, counts.evaluations);
}

/// The orders are those in the documentation, for any requested tolerance.
#[test]
fn columns_follow_the_digits_within_their_limits() {
    let order = |tolerance: f64| Method::<f64>::power(&Extrapolation::for_tolerance(tolerance)) + 1;
    assert_eq!([1.0, 1e-4, 1e-8, 1e-14, 1e-28, 0.0].map(order), [6, 8, 12, 16, 30, 32]);
}
