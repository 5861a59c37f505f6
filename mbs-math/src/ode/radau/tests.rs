//! Coefficients, order, stiffness, counts and history of the implicit method, mostly on problems with closed forms.

use super::complex::Complex;
use super::*;
use crate::ode::{Adaptive, EndState, OdeError};
use crate::real::DoubleDouble as Pair;
use alloc::boxed::Box;
use core::convert::Infallible;

type Law<T> = dyn Fn(T, &[T], &mut [T]);

/// A problem y' = f(t, y) that counts the evaluations of its rates.
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

/// The nonlinear oscillator x'' = −x³, with position and velocity. Its energy is constant, so no closed form is needed.
fn duffing<T: Real>() -> Problem<T> {
    Problem::new(|_, y: &[T], dy: &mut [T]| (dy[0], dy[1]) = (y[1], -y[0] * y[0] * y[0]))
}

/// The problem with the solution x = sin t, led by a spring of stiffness k and a critical damper: x'' = −sin t − k (x − sin t) − 2 √k (x' −
/// cos t).
fn led(k: f64) -> Problem<f64> {
    Problem::new(move |t, y: &[f64], dy: &mut [f64]| {
        let (s, c) = (libm::sin(t), libm::cos(t));
        (dy[0], dy[1]) = (y[1], -s - k * (y[0] - s) - 2.0 * libm::sqrt(k) * (y[1] - c));
    })
}

/// Integrates to `end` with a tolerance; returns the driver, and leaves the state in `y`.
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

/// Error of x'' = −x after one step h from (1, 0), with stages found to machine precision.
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

/// The error of one step is proportional to h⁶. Later terms change the ratio of errors by less than a tenth at these steps.
#[test]
fn the_method_is_of_order_5() {
    for h in [0.2, 0.1] {
        let ratio = one_step(h) / one_step(0.5 * h) / 64.0;
        assert!((ratio - 1.0).abs() < 0.1, "h = {h}: {ratio} of 2^6");
    }
}

/// Σⱼ aᵢⱼ cⱼ^k = cᵢ^(k+1)/(k+1) for k < 3 are the conditions of collocation on A. The test checks them for A = T Λ⁻¹ T⁻¹, computed from the
/// coefficients, up to some rounding errors of double-double numbers.
#[test]
fn the_basis_is_that_of_the_collocation_in_32_digits() {
    let c = Coefficients::<Pair>::new();
    let Complex { re, im } = c.complex;
    let size = re * re + im * im;
    for k in 0..3_u8 {
        let power = |x: Pair, k: u8| (0..k).fold(Pair::ONE, |p, _| p * x);
        let given = c.nodes.map(|c| power(c, k));
        let w = c.inverse.map(|row| row[0] * given[0] + row[1] * given[1] + row[2] * given[2]);
        // The matrix Λ has the block [α −β; β α].
        let u = [w[0] / c.real, (re * w[1] + im * w[2]) / size, (re * w[2] - im * w[1]) / size];
        for (i, row) in c.basis.iter().enumerate() {
            let integral = row[0] * u[0] + row[1] * u[1] + row[2] * u[2];
            let exact = power(c.nodes[i], k + 1) / Pair::from_f64(f64::from(k) + 1.0);
            assert!((integral - exact).abs().to_f64() < 1e-29, "{i}, {k}: {integral:?}");
        }
    }
}

/// The spring has a stiffness of up to 1e10 per second squared for a unit mass, for which explicit methods need half a million steps. On
/// stiff problems the order of the velocities drops to that of the stages. The step then becomes shorter, but only once. The bound of 30
/// tolerances allows for the sum over all steps.
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

/// The energy error of a nonlinear oscillator decreases with the tolerance.
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

/// In double-double arithmetic the finite differences have 16 digits, and the tolerance may be below the machine precision of doubles.
#[test]
fn pairs_reach_20_digits() {
    let mut y = [Pair::ONE, Pair::ZERO];
    run(&mut duffing(), (1e-20, 1e-4), (0.1, 1), &mut y).expect("a run");
    let quarter = Pair::from_f64(0.25);
    let squares = [y[1] * y[1] * Pair::HALF, y[0] * y[0] * y[0] * y[0] * quarter];
    let off = (squares[0] + squares[1] - quarter).abs().to_f64();
    assert!(off < 1e-19, "{off:e}");
}

/// The slopes of a linear problem are evaluated once, and the matrices of one step length are factored once.
#[test]
fn slopes_and_factors_are_kept_while_they_serve() {
    let mut y = [0.0, 1.0];
    let mut problem = led(1e4);
    let driver = run(&mut problem, (1e-6, 0.05), (5.0, 100), &mut y).expect("a run");
    let counts = driver.counts();
    let steps = counts.accepted + counts.rejected;
    // Each step has one evaluation at its beginning, and three for each of at most two iterations. The slopes take three evaluations in the
    // whole run.
    assert!(counts.evaluations <= 7 * steps + 6, "{counts:?}");
}

/// A method that is restored from the history makes the same step, bit for bit.
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

/// A rate that is NaN from some position on ends the run with an error, and no NaN reaches the state.
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

/// A mass is pressed onto a stiff stop and then pulled off it: x'' = p(t) + k max(−x, 0) − 2 √k v at the stop. In contact the steps grow.
/// When the contact ends, the matrices still contain the slopes of the stop, so the method must detect the defect that they hide. The mass
/// leaves the stop when p is zero, and then moves freely. Its displacement is the double integral of p, apart from the compression of the
/// stop.
#[test]
fn a_stiff_contact_that_ends_is_not_held_by_its_slopes() {
    for (k, tolerance, most) in [(1e6, 1e-6, 1e-3), (1e8, 1e-8, 1e-4)] {
        let mut problem = Problem::new(move |t: f64, y: &[f64], dy: &mut [f64]| {
            let stop = if y[0] < 0.0 { -k * y[0] - 2.0 * libm::sqrt(k) * y[1] } else { 0.0 };
            (dy[0], dy[1]) = (y[1], t - 2.0 + stop.max(0.0));
        });
        let mut y = [-2.0 / k, 0.0];
        run(&mut problem, (tolerance, 1e-3), (5.0, 1), &mut y).expect("a run");
        // The exact position is (t − 2)³/6 at t = 5.
        assert!((y[0] - 4.5).abs() < most, "k = {k:e}, {tolerance:e}: {} m", y[0]);
    }
}

/// With a relative tolerance alone, a component that begins at zero has the tolerance zero.
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
