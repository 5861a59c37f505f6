//! Coefficients, order, stiffness, counts and memory of the implicit method, on problems with closed forms.

use super::complex::Complex;
use super::*;
use crate::ode::{Adaptive, EndState, OdeError};
use crate::real::DoubleDouble as Pair;
use alloc::boxed::Box;
use core::convert::Infallible;

type Law<T> = dyn Fn(T, &[T], &mut [T]);

/// A problem by its rates, which counts how often they are asked for.
struct Problem<T> {
    rates: Box<Law<T>>,
    evaluations: u64,
}

impl<T: Real> Problem<T> {
    fn new(rates: impl Fn(T, &[T], &mut [T]) + 'static) -> Self {
        Self { rates: Box::new(rates), evaluations: 0 }
    }
}

impl<T: Real> Rates<T> for Problem<T> {
    type Error = Infallible;
    fn n(&self) -> usize {
        2
    }
    fn rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Infallible> {
        self.evaluations += 1;
        (self.rates)(t, y, dy);
        Ok(())
    }
}

/// A pendulum's oscillation written with position and velocity, x'' = −x³: no closed form is needed, its energy is kept.
fn duffing<T: Real>() -> Problem<T> {
    Problem::new(|_, y: &[T], dy: &mut [T]| (dy[0], dy[1]) = (y[1], -y[0] * y[0] * y[0]))
}

/// x = sin t by a spring of stiffness k and a damper that is critical: x'' = −sin t − k (x − sin t) − 2 √k (x' − cos t).
fn led(k: f64) -> Problem<f64> {
    Problem::new(move |t, y: &[f64], dy: &mut [f64]| {
        let (s, c) = (libm::sin(t), libm::cos(t));
        (dy[0], dy[1]) = (y[1], -s - k * (y[0] - s) - 2.0 * libm::sqrt(k) * (y[1] - c));
    })
}

/// Runs to `end` with a tolerance; returns the state, and the driver.
fn run<T: Real>(
    problem: &mut Problem<T>,
    (tolerance, first): (f64, f64),
    (end, parts): (f64, u32),
    y: &mut [T; 2],
) -> Result<Adaptive<T, Radau<T>>, OdeError<Infallible>> {
    let mut driver = Adaptive::new(Radau::new(2, 1), T::from_f64(first));
    let options = Options::new(T::from_f64(tolerance));
    let mut scratch = [T::ZERO; 6];
    let dt = T::from_f64(end / f64::from(parts));
    for k in 0..parts {
        let from = T::from_f64(f64::from(k)) * dt;
        driver.advance(problem, (from, dt), (y, &mut scratch), &options, |_, _, _| {
            Ok(EndState::Kept)
        })?;
    }
    Ok(driver)
}

/// Error of x'' = −x after one step of h from (1, 0), whose stages are found to rounding.
fn one_step(h: f64) -> f64 {
    let mut problem = Problem::new(|_, y: &[Pair], dy: &mut [Pair]| (dy[0], dy[1]) = (y[1], -y[0]));
    let (mut method, mut scratch) = (Radau::new(2, 1), [Pair::ZERO; 6]);
    let options = Options::new(Pair::from_f64(1e-25));
    let (h, start) = (Pair::from_f64(h), [Pair::ONE, Pair::ZERO]);
    let step = (Pair::ZERO, h);
    let Ok(_) = method.trial(&mut problem, step, &start, false, (&options, &mut scratch));
    let end = method.new_state(2, &scratch);
    let (sine, cosine) = h.sin_cos();
    (end[0] - cosine).abs().max((end[1] + sine).abs()).to_f64()
}

/// The error of one step goes with h⁶; later terms change the ratio by less than a tenth at these steps.
#[test]
fn the_method_is_of_order_5() {
    for h in [0.2, 0.1] {
        let ratio = one_step(h) / one_step(0.5 * h) / 64.0;
        assert!((ratio - 1.0).abs() < 0.1, "h = {h}: {ratio} of 2^6");
    }
}

/// Σⱼ aᵢⱼ cⱼ^k = cᵢ^(k+1)/(k+1) for k < 3 says that A is that of the collocation. Here it is tried of what is made of it: A = T Λ⁻¹ T⁻¹, to
/// some roundings of pairs.
#[test]
fn the_basis_is_that_of_the_collocation_in_32_digits() {
    let c = Coefficients::<Pair>::new();
    let Complex { re, im } = c.complex;
    let size = re * re + im * im;
    for k in 0..3_u8 {
        let power = |x: Pair, k: u8| (0..k).fold(Pair::ONE, |p, _| p * x);
        let given = c.nodes.map(|c| power(c, k));
        let w = c.inverse.map(|row| row[0] * given[0] + row[1] * given[1] + row[2] * given[2]);
        // Λ has the block [α −β; β α].
        let u = [w[0] / c.real, (re * w[1] + im * w[2]) / size, (re * w[2] - im * w[1]) / size];
        for (i, row) in c.basis.iter().enumerate() {
            let integral = row[0] * u[0] + row[1] * u[1] + row[2] * u[2];
            let exact = power(c.nodes[i], k + 1) / Pair::from_f64(f64::from(k) + 1.0);
            assert!((integral - exact).abs().to_f64() < 1e-29, "{i}, {k}: {integral:?}");
        }
    }
}

/// A spring of 1e10 per second squared: explicit methods are stable with half a million steps. The order of velocities falls to that
/// of the stages, and steps with it, once. 30 tolerances are what the sum of all steps may make of one.
#[test]
fn stiff_springs_hardly_cost_steps() {
    for k in [1e2, 1e6, 1e10] {
        let mut y = [0.0, 1.0];
        let mut problem = led(k);
        let driver = run(&mut problem, (1e-7, 1e-2), (10.0, 1), &mut y).expect("a run");
        let off = (y[0] - libm::sin(10.0)).abs();
        assert!(off < 3e-6, "k = {k:e}: {off:e}");
        assert!(driver.counts().accepted < 600, "k = {k:e}: {:?}", driver.counts());
        assert_eq!(driver.counts().evaluations, problem.evaluations);
    }
}

/// The energy of a nonlinear oscillator follows the tolerance.
#[test]
fn errors_follow_the_tolerance() {
    let off = |tolerance: f64| {
        let mut y = [1.0, 0.0];
        run(&mut duffing(), (tolerance, 0.01), (10.0, 7), &mut y).expect("a run");
        let energy: f64 = 0.5 * y[1] * y[1] + 0.25 * libm::pow(y[0], 4.0);
        (energy - 0.25).abs() / tolerance
    };
    let shares = [1e-4, 1e-6, 1e-8, 1e-10].map(off);
    for share in shares {
        assert!(share > 1e-3 && share < 30.0, "{shares:?} tolerances");
    }
}

/// In pairs of doubles slopes by differences have 16 digits, and the tolerance may be below the rounding of doubles.
#[test]
fn pairs_reach_20_digits() {
    let mut y = [Pair::ONE, Pair::ZERO];
    run(&mut duffing(), (1e-20, 1e-4), (0.1, 1), &mut y).expect("a run");
    let quarter = Pair::from_f64(0.25);
    let squares = [y[1] * y[1] * Pair::HALF, y[0] * y[0] * y[0] * y[0] * quarter];
    let off = (squares[0] + squares[1] - quarter).abs().to_f64();
    assert!(off < 1e-19, "{off:e}");
}

/// Slopes that are those of the whole motion are found once, and the matrices of one length of step made once.
#[test]
fn slopes_and_factors_are_kept_while_they_serve() {
    let mut y = [0.0, 1.0];
    let mut problem = led(1e4);
    let driver = run(&mut problem, (1e-6, 0.05), (5.0, 100), &mut y).expect("a run");
    let counts = driver.counts();
    let steps = counts.accepted + counts.rejected;
    // One evaluation at the beginning of each step, three for each of at most two iterations, and three for the slopes, once.
    assert!(counts.evaluations <= 7 * steps + 6, "{counts:?}");
}

/// Another that is restored from the history makes the same step, bit for bit.
#[test]
fn a_history_makes_the_same_step() {
    let mut y = [1.0, 0.0];
    let driver = run(&mut duffing(), (1e-7, 0.01), (2.0, 3), &mut y).expect("a run");
    let history = driver.method().history();
    let mut twin = Radau::new(2, 1);
    assert!(twin.set_history(&history) && !Radau::<f64>::new(3, 1).set_history(&history));
    let ends = [driver.method().clone(), twin].map(|mut method| {
        let mut scratch = [0.0; 6];
        let options = Options::new(1e-7);
        let Ok(error) =
            method.trial(&mut duffing(), (2.0, 0.1), &y, false, (&options, &mut scratch));
        (error.to_bits(), method.new_state(2, &scratch).to_vec())
    });
    assert_eq!(ends[0], ends[1]);
}

/// A rate that is no number from some place on ends the run with a typed error, not with numbers.
#[test]
fn a_wall_of_no_numbers_is_reported() {
    let mut problem = Problem::new(|_, y: &[f64], dy: &mut [f64]| {
        (dy[0], dy[1]) = (1.0, if y[0] > 0.5 { f64::NAN } else { -y[1] });
    });
    let mut y = [0.0, 1.0];
    let error = run(&mut problem, (1e-6, 0.01), (1.0, 1), &mut y).expect_err("a wall");
    assert!(matches!(error, OdeError::StepTooSmall { .. }), "{error}");
    assert!((y[0] - 0.5).abs() < 1e-3, "{y:?} {error}");
}

/// A mass that is pressed on a stiff stop and pulled off it: x'' = p(t) + k max(−x, 0) − 2 √k v there. At rest the steps grow, and the
/// slopes of the stop stand in the matrices when it is gone: all that it hides must be seen. It lifts off where the pull is zero and
/// falls freely from then on. The way after that is the integral of the pull, but for what a stop of k lets through.
#[test]
fn a_stiff_contact_that_ends_is_not_held_by_its_slopes() {
    for (k, tolerance, most) in [(1e6, 1e-6, 1e-3), (1e8, 1e-8, 1e-4)] {
        let mut problem = Problem::new(move |t: f64, y: &[f64], dy: &mut [f64]| {
            let stop = if y[0] < 0.0 { -k * y[0] - 2.0 * libm::sqrt(k) * y[1] } else { 0.0 };
            (dy[0], dy[1]) = (y[1], t - 2.0 + stop.max(0.0));
        });
        let mut y = [-2.0 / k, 0.0];
        run(&mut problem, (tolerance, 1e-3), (5.0, 1), &mut y).expect("a run");
        // (t − 2)³/6 at t = 5
        assert!((y[0] - 4.5).abs() < most, "k = {k:e}, {tolerance:e}: {} m", y[0]);
    }
}

/// A component that begins with nothing has no tolerance yet, where nothing is absolute.
#[test]
fn a_relative_tolerance_alone_is_one() {
    let (mut driver, mut y) = (Adaptive::new(Radau::new(2, 1), 1e-3), [1.0, 0.0]);
    let options = Options { absolute: 0.0, ..Options::new(1e-6) };
    let memory = (&mut y[..], &mut [0.0; 6][..]);
    let kept = |_: &mut Problem<f64>, _, _: &mut [f64]| Ok(EndState::Kept);
    driver.advance(&mut duffing(), (0.0, 1.0), memory, &options, kept).expect("a run");
    let energy: f64 = 0.5 * y[1] * y[1] + 0.25 * libm::pow(y[0], 4.0);
    assert!((energy - 0.25).abs() < 1e-5, "{energy}");
}
