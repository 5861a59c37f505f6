//! The method 8(5,3): its order conditions in 32 digits, its order, its error estimate, and its cost compared with the pair 5(4) for many
//! digits.

use core::convert::Infallible;
use mbs_math::Real;
use mbs_math::ode::{Adaptive, EndState, Method, Options, Rates, Tableau};
use mbs_math::real::DoubleDouble as Pair;

/// Precision of the coefficients [-], which are published with at least 28 digits.
const PRINTED: f64 = 1e-27;

fn size(x: Pair) -> f64 {
    x.abs().to_f64()
}

#[test]
fn printed_coefficients_fulfil_the_quadrature_conditions_of_all_three_orders() {
    let Tableau { a, b, c, e, coarse, .. } = Tableau::<Pair, 12>::dormand_prince_8();
    let moment = |w: &[Pair; 12], k: i32| {
        let power = |x: Pair| (0..k).fold(Pair::ONE, |p, _| p * x);
        w.iter().zip(&c).fold(Pair::ZERO, |sum, (&w, &c)| sum + w * power(c))
    };
    for (i, row) in a.iter().enumerate() {
        // Condition c_i = sum_j a_ij, with earlier stages alone.
        assert!(size(moment(row, 0) - c[i]) < PRINTED, "row {i}");
        assert!(row[i..].iter().all(|x| *x == Pair::ZERO), "row {i}");
    }
    let coarse = coarse.expect("a second estimate");
    for k in 0..9 {
        let whole = Pair::ONE / Pair::from_f64(f64::from(k + 1));
        assert_eq!(size(moment(&b, k) - whole) < PRINTED, k < 8, "b, power {k}");
        assert_eq!(size(moment(&e, k)) < PRINTED, k < 5, "e, power {k}");
        assert_eq!(size(moment(&coarse, k)) < PRINTED, k < 3, "coarse, power {k}");
    }
}

/// The problem with the solution y = 1/(1 + t²): y' = −2 t y², nonlinear and dependent on time. It counts the evaluations of its rates.
struct Witch(u64);

impl<T: Real> Rates<T> for Witch {
    type Error = Infallible;
    fn n(&self) -> usize {
        1
    }
    fn rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Infallible> {
        self.0 += 1;
        dy[0] = -T::TWO * t * y[0] * y[0];
        Ok(())
    }
}

fn witch(t: Pair) -> Pair {
    Pair::ONE / (Pair::ONE + t * t)
}

/// Error and error estimate of one step from t = 0.3.
fn one_step(h: f64) -> [f64; 2] {
    let (mut tableau, start, h) =
        (Tableau::<Pair, 12>::dormand_prince_8(), Pair::from_f64(0.3), Pair::from_f64(h));
    let (y, mut scratch) = ([witch(start)], [Pair::ZERO; Tableau::<Pair, 12>::scratch(1)]);
    let options = Options { relative: Pair::ZERO, ..Options::new(Pair::ONE) };
    let mut system = Witch(0);
    let Ok(estimate) = tableau.trial(&mut system, (start, h), &y, false, (&options, &mut scratch));
    assert_eq!(system.0, tableau.evaluations(false));
    [size(tableau.new_state(1, &scratch)[0] - witch(start + h)), estimate.to_f64()]
}

/// With half the step the error is smaller by 2^9 and the estimate by 2^8. Later terms change these ratios by up to a tenth.
#[test]
fn a_step_has_order_8_and_its_estimate_goes_with_the_eighth_power() {
    let (coarse, fine) = (one_step(0.004), one_step(0.002));
    for (i, power) in [9, 8].into_iter().enumerate() {
        let ratio = coarse[i] / fine[i] / 2f64.powi(power);
        assert!((ratio - 1.0).abs() < 0.1, "{ratio} of 2^{power}");
    }
}

/// Error at t = 2 with a tolerance, and the number of evaluations.
fn run<const S: usize>(tableau: Tableau<f64, S>, tolerance: f64) -> (f64, u64) {
    let (mut system, mut y) = (Witch(0), [1.0]);
    let mut scratch = vec![0.0; Tableau::<f64, S>::scratch(1)];
    let mut driver = Adaptive::new(tableau, 0.1);
    let work = (&mut y[..], &mut scratch[..]);
    let options = Options::new(tolerance);
    driver
        .advance(&mut system, (0.0, 2.0), work, &options, |_, _, _| Ok(EndState::Kept))
        .expect("steps");
    assert_eq!(system.0, driver.counts().evaluations);
    ((y[0] - 0.2).abs(), system.0)
}

/// The errors of about ten steps may add up, each of at most one tolerance.
#[test]
fn tolerances_are_kept_and_many_digits_take_fewer_evaluations_than_by_the_pair_of_order_5() {
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let (error, eighth) = run(Tableau::<f64, 12>::dormand_prince_8(), tolerance);
        assert!(error <= 10.0 * tolerance, "{tolerance:e}: {error:e}");
        let (_, fifth) = run(Tableau::<f64, 7>::dormand_prince(), tolerance);
        assert_eq!(eighth < fifth, tolerance < 1e-7, "{tolerance:e}: {eighth}, {fifth}");
    }
}
