//! Orders, error control, counts and failures of the explicit methods, on problems with closed forms.

use super::*;
use crate::Real;
use core::convert::Infallible;

/// A problem y' = f(t, y) that counts the evaluations of its rates.
struct Problem<const N: usize> {
    rates: fn(f64, &[f64; N]) -> [f64; N],
    evaluations: u64,
}

impl<const N: usize> Problem<N> {
    fn new(rates: fn(f64, &[f64; N]) -> [f64; N]) -> Self {
        Self { rates, evaluations: 0 }
    }
}

impl<const N: usize> Rates<f64> for Problem<N> {
    type Error = Infallible;
    fn n(&self) -> usize {
        N
    }
    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Infallible> {
        self.evaluations += 1;
        dy.copy_from_slice(&(self.rates)(t, y.try_into().unwrap()));
        Ok(())
    }
}

/// The oscillator with the solution y = (cos t, −sin t).
fn oscillator() -> Problem<2> {
    Problem::new(|_, y| [y[1], -y[0]])
}

/// The problem with the solution y = 1/(1 + t²): nonlinear, and dependent on time.
fn witch() -> Problem<2> {
    Problem::new(|t, y| [-2.0 * t * y[0] * y[0], 1.0])
}

fn oscillator_error(t: f64, y: &[f64; 2]) -> f64 {
    (y[0] - libm::cos(t)).abs().max((y[1] + libm::sin(t)).abs())
}

fn witch_error(t: f64, y: &[f64; 2]) -> f64 {
    (y[0] - 1.0 / (1.0 + t * t)).abs()
}

/// Start of the oscillator: the cosine and its rate.
const OSCILLATOR: [f64; 2] = [1.0, 0.0];
/// Start of the problem with the solution 1/(1 + t²): its value, and the time.
const WITCH: [f64; 2] = [1.0, 0.0];

/// Bound of the relative change of error ratios by the terms of the next order, at these steps [-].
const HIGHER_ORDER: f64 = 0.1;

#[track_caller]
fn assert_ratio(coarse: f64, fine: f64, expected: f64) {
    let ratio = coarse / fine;
    assert!((ratio / expected - 1.0).abs() <= HIGHER_ORDER, "{coarse:e} / {fine:e} = {ratio}");
}

type Error = fn(f64, &[f64; 2]) -> f64;

/// Error at t = 2 after `steps` equal steps of the classical method.
fn rk4(mut problem: Problem<2>, mut y: [f64; 2], error: Error, steps: u32) -> f64 {
    let h = 2.0 / f64::from(steps);
    for k in 0..steps {
        rk4_step(&mut problem, f64::from(k) * h, h, &mut y, &mut [0.0; 6]).unwrap();
    }
    assert_eq!(problem.evaluations, 4 * u64::from(steps));
    error(2.0, &y)
}

#[test]
fn classical_method_is_of_order_4() {
    let linear = |n| rk4(oscillator(), OSCILLATOR, oscillator_error, n);
    let nonlinear = |n| rk4(witch(), WITCH, witch_error, n);
    assert_ratio(linear(40), linear(80), 16.0);
    assert_ratio(nonlinear(40), nonlinear(80), 16.0);
}

/// Error at t = 1 after `steps` equal steps of the pair 5(4).
fn pair(mut problem: Problem<2>, mut y: [f64; 2], error: Error, steps: u32) -> f64 {
    let (tableau, mut scratch) = (Tableau::dormand_prince(), [0.0; 18]);
    let h = 1.0 / f64::from(steps);
    for k in 0..steps {
        tableau.stages(&mut problem, (f64::from(k) * h, h), &y, false, &mut scratch).unwrap();
        y.copy_from_slice(Tableau::<f64, 7>::end_state(2, &scratch));
    }
    error(1.0, &y)
}

#[test]
fn dormand_prince_is_of_order_5() {
    let linear = |n| pair(oscillator(), OSCILLATOR, oscillator_error, n);
    let nonlinear = |n| pair(witch(), WITCH, witch_error, n);
    assert_ratio(linear(20), linear(40), 32.0);
    assert_ratio(nonlinear(40), nonlinear(80), 32.0);
}

#[test]
fn embedded_estimate_goes_with_the_fifth_power_of_the_step() {
    let options = Options { relative: 0.0, ..Options::new(1.0) };
    let tableau = Tableau::dormand_prince();
    let estimate = |mut problem: Problem<2>, y: [f64; 2], h: f64| {
        let mut scratch = [0.0; 18];
        tableau.stages(&mut problem, (0.3, h), &y, false, &mut scratch).unwrap();
        tableau.error(&mut problem, h, &y, (&options, &mut scratch)).unwrap()
    };
    let linear = |h| estimate(oscillator(), [0.6, 0.8], h);
    let nonlinear = |h| estimate(witch(), [1.0 / 1.09, 0.3], h);
    assert_ratio(linear(0.02), linear(0.01), 32.0);
    assert_ratio(nonlinear(0.02), nonlinear(0.01), 32.0);
}

/// Bound of the rounding errors in sums of about ten coefficients [-].
const ROUNDING: f64 = 1e-14;

#[test]
fn coefficients_fulfil_the_quadrature_conditions_of_both_orders() {
    let Tableau { a, b, c, e, .. } = Tableau::<f64, 7>::dormand_prince();
    for i in 0..7 {
        // cᵢ = Σⱼ aᵢⱼ
        assert!((a[i].iter().sum::<f64>() - c[i]).abs() < ROUNDING, "row {i}");
    }
    assert_eq!(a[6].map(f64::to_bits), b.map(f64::to_bits), "the last stage is the new state");
    let moment = |w: &[f64; 7], k: i32| -> f64 {
        w.iter().zip(&c).map(|(w, c)| w * (0..k).fold(1.0, |p, _| p * c)).sum()
    };
    for k in 0..5 {
        // Order conditions: Σ bᵢ cᵢᵏ = 1/(k + 1) up to order 5, and Σ eᵢ cᵢᵏ = 0 up to order 4 but not 5.
        assert!((moment(&b, k) - 1.0 / f64::from(k + 1)).abs() < ROUNDING, "b, power {k}");
        assert_eq!(moment(&e, k).abs() < ROUNDING, k < 4, "e, power {k}");
    }
}

/// A driver after ten seconds of the oscillator, with the problem and the state. The hook returns `end` after every step.
fn drive(
    tolerance: f64,
    first_step: f64,
    end: EndState,
) -> (Adaptive<f64, Tableau<f64, 7>>, Problem<2>, [f64; 2]) {
    let (mut problem, mut y, mut scratch) = (oscillator(), OSCILLATOR, [0.0; 18]);
    let mut driver = Adaptive::new(Tableau::dormand_prince(), first_step);
    let options = Options::new(tolerance);
    driver
        .advance(&mut problem, (0.0, 10.0), (&mut y, &mut scratch), &options, |_, _, _| Ok(end))
        .unwrap();
    (driver, problem, y)
}

/// Bound of the error after ten radians, in tolerances [-]: it sums the errors of all steps, each of at most about one tolerance.
const ADDED_UP: f64 = 100.0;

#[test]
fn true_error_falls_with_the_tolerance_over_six_decades() {
    let mut last = f64::INFINITY;
    for decade in 4..=10 {
        let tolerance = libm::pow(10.0, -f64::from(decade));
        let (_, _, y) = drive(tolerance, 1e-2, EndState::Kept);
        let error = oscillator_error(10.0, &y);
        assert!(error <= ADDED_UP * tolerance, "{tolerance:e}: {error:e}");
        // A tenth of the tolerance gives nearly a tenth of the error: the step is proportional to tolerance^(1/5), the error to step^5.
        assert!(error <= last / 4.0, "{tolerance:e}: {error:e} after {last:e}");
        last = error;
    }
}

#[test]
fn counts_are_those_of_the_rates() {
    let (driver, problem, _) = drive(1e-8, 1.0, EndState::Kept);
    let Counts { accepted, rejected, evaluations } = driver.counts();
    assert_eq!(evaluations, problem.evaluations);
    assert_eq!(evaluations, 1 + 6 * (accepted + rejected));
    assert!(rejected > 0, "the first step is too long");

    let (driver, problem, _) = drive(1e-8, 1.0, EndState::Changed);
    let changed = driver.counts();
    assert_eq!(changed.evaluations, problem.evaluations);
    assert_eq!((changed.accepted, changed.rejected), (accepted, rejected));
    assert_eq!(changed.evaluations, evaluations + accepted - 1);
}

/// Evaluations per accepted step, when the hook moves the second component by this many tolerances and returns `Projected`.
fn projected_by(tolerances: f64) -> u64 {
    let (mut problem, mut y, mut scratch) = (oscillator(), OSCILLATOR, [0.0; 18]);
    let mut driver = Adaptive::new(Tableau::dormand_prince(), 0.1);
    let options = Options { relative: 0.0, max_step: 0.1, ..Options::new(1e-4) };
    driver
        .advance(&mut problem, (0.0, 1.0), (&mut y, &mut scratch), &options, |_, _, y| {
            y[1] += tolerances * 1e-4;
            Ok(EndState::Projected)
        })
        .unwrap();
    assert_eq!(driver.counts().evaluations, problem.evaluations);
    assert_eq!((driver.counts().accepted, driver.counts().rejected), (10, 0));
    problem.evaluations
}

/// The size of a displacement is the root mean square of both components, hence the factor √2.
#[test]
fn rates_are_found_anew_where_a_projection_moved_the_state_by_more_than_a_tenth_of_the_tolerance() {
    let tenth = 0.1 * 2.0_f64.sqrt();
    assert_eq!(projected_by(0.9 * tenth), 1 + 6 * 10);
    assert_eq!(projected_by(1.1 * tenth), 1 + 6 * 10 + 9);
}

#[test]
fn calls_end_exactly_and_the_planned_step_survives_them() {
    let (mut problem, mut y, mut scratch) = (oscillator(), OSCILLATOR, [0.0; 18]);
    let mut driver = Adaptive::new(Tableau::dormand_prince(), 1e-2);
    let options = Options { max_step: 0.3, ..Options::new(1e-8) };
    let mut hooks = 0;
    for call in 0..200 {
        let start = f64::from(call) * 0.05;
        let mut at = start;
        driver
            .advance(&mut problem, (start, 0.05), (&mut y, &mut scratch), &options, |_, t, _| {
                assert!(t > at && t <= start + 0.05);
                at = t;
                hooks += 1;
                Ok(EndState::Kept)
            })
            .unwrap();
        assert_eq!(at.to_bits(), (start + 0.05).to_bits());
    }
    assert_eq!(hooks, driver.counts().accepted);
    assert_eq!(driver.counts().evaluations, problem.evaluations);
    // When the step exceeds the length of a call, each call is one step.
    assert!(driver.step() > 0.05 && driver.counts().accepted < 210, "{driver:?}");
    assert!(oscillator_error(10.0, &y) < 1e-6);
}

/// The hook projects the state onto the circle after every step.
#[test]
fn hook_projects_the_state_and_the_order_stays() {
    let solve = |tolerance: f64| {
        let (mut problem, mut y, mut scratch) = (oscillator(), OSCILLATOR, [0.0; 18]);
        let mut driver = Adaptive::new(Tableau::dormand_prince(), 1e-2);
        driver
            .advance(
                &mut problem,
                (0.0, 10.0),
                (&mut y, &mut scratch),
                &Options::new(tolerance),
                |_, _, y| {
                    let size = (y[0] * y[0] + y[1] * y[1]).sqrt();
                    y[0] /= size;
                    y[1] /= size;
                    Ok(EndState::Changed)
                },
            )
            .unwrap();
        assert!((y[0] * y[0] + y[1] * y[1] - 1.0).abs() < ROUNDING);
        oscillator_error(10.0, &y)
    };
    for tolerance in [1e-5, 1e-7, 1e-9] {
        assert!(solve(tolerance) <= ADDED_UP * tolerance, "{tolerance:e}");
    }
}

/// Advances by 10 s from zero; returns the error and the last state.
fn failure<const N: usize, const W: usize>(
    mut problem: Problem<N>,
    mut y: [f64; N],
    options: &Options<'_, f64>,
) -> (Option<OdeError<Infallible>>, [f64; N]) {
    let mut scratch = [0.0; W];
    let mut driver = Adaptive::new(Tableau::dormand_prince(), 1e-3);
    let work = (&mut y[..], &mut scratch[..]);
    let end =
        driver.advance(&mut problem, (0.0, 10.0), work, options, |_, _, _| Ok(EndState::Kept));
    (end.err(), y)
}

#[test]
fn stiffness_ends_with_the_steps_used_up() {
    let stiff = Problem::new(|t, y: &[f64; 1]| [-1e6 * (y[0] - libm::cos(t))]);
    let options = Options { max_steps: 1000, ..Options::new(1e-6) };
    let (error, _) = failure::<1, 9>(stiff, [1.0], &options);
    let Some(OdeError::TooManySteps { time, steps: 1000 }) = error else { panic!("{error:?}") };
    // Stability limits the step to 3.3e-6 s.
    assert!(time > 0.0 && time < 1000.0 * 3.4e-6 + 1e-3, "{time}");
}

#[test]
fn stiffness_out_of_all_proportion_is_reported_after_a_tenth_of_the_steps() {
    // Stability limits the step to 3.3e-12 s, so 10 s would take three million times the allowed million steps.
    let stiff = Problem::new(|t, y: &[f64; 1]| [-1e12 * (y[0] - libm::cos(t))]);
    let (error, _) = failure::<1, 9>(stiff, [1.0], &Options::new(1e-6));
    let Some(OdeError::TooManySteps { time, steps: 100_001 }) = error else { panic!("{error:?}") };
    assert!(time > 0.0 && time < 1e-5, "{time}");
}

#[test]
fn pole_ends_with_the_smallest_step_before_it() {
    let pole = Problem::new(|_, y: &[f64; 1]| [y[0] * y[0]]);
    let (error, y) = failure::<1, 9>(pole, [1.0], &Options::new(1e-6));
    let Some(OdeError::StepTooSmall { time, step }) = error else { panic!("{error:?}") };
    assert!((time - 1.0).abs() < 1e-3 && step < 1e-13 && y[0] > 1e3, "{time} {step:e} {y:?}");
}

#[test]
fn rates_that_are_no_numbers_are_rejected_and_named() {
    for bad in [f64::NAN, f64::INFINITY] {
        let (mut problem, mut y, mut scratch) = (oscillator(), OSCILLATOR, [0.0; 18]);
        problem.rates = if bad.is_nan() {
            |t, y| if t > 0.5 { [f64::NAN; 2] } else { [y[1], -y[0]] }
        } else {
            |t, y| if t > 0.5 { [f64::INFINITY, 0.0] } else { [y[1], -y[0]] }
        };
        let mut driver = Adaptive::new(Tableau::dormand_prince(), 1e-2);
        let work = (&mut y[..], &mut scratch[..]);
        let options = Options::new(1e-8);
        let end = driver
            .advance(&mut problem, (0.0, 1.0), work, &options, |_, _, _| Ok(EndState::Kept))
            .unwrap_err();
        let OdeError::StepTooSmall { time, .. } = end else { panic!("{end:?}") };
        assert!((time - 0.5).abs() < 1e-12, "{time}");
        assert!(oscillator_error(time, &y) < 1e-7, "the state before it is kept: {y:?}");
    }
}

/// A problem that returns an error from one second on.
struct Wall;
#[derive(Debug, PartialEq)]
struct Stop;
impl Rates<f64> for Wall {
    type Error = Stop;
    fn n(&self) -> usize {
        1
    }
    fn rates(&mut self, t: f64, _: &[f64], dy: &mut [f64]) -> Result<(), Stop> {
        dy[0] = 1.0;
        if t < 1.0 { Ok(()) } else { Err(Stop) }
    }
}

#[test]
fn failing_rates_and_hooks_come_back_with_the_time_of_the_state() {
    let mut driver = Adaptive::new(Tableau::dormand_prince(), 0.25);
    let options = Options { max_step: 0.25, ..Options::new(1e-6) };
    let (mut y, mut scratch) = ([0.0], [0.0; 9]);
    let work = (&mut y[..], &mut scratch[..]);
    let end = driver.advance(&mut Wall, (0.0, 2.0), work, &options, |_, _, _| Ok(EndState::Kept));
    assert_eq!(end, Err(OdeError::Rates { time: 0.75, error: Stop }));
    assert!((y[0] - 0.75).abs() < ROUNDING);

    let work = (&mut y[..], &mut scratch[..]);
    let end = driver.advance(&mut Wall, (0.0, 0.5), work, &options, |_, _, _| Err(Stop));
    assert_eq!(end, Err(OdeError::Rates { time: 0.25, error: Stop }));

    assert_eq!(rk4_step(&mut Wall, 0.9, 0.2, &mut y, &mut [0.0; 3]), Err(Stop));
}

#[test]
fn controller_follows_its_formulas() {
    let mut control = StepControl::<f64>::new(5);
    let close = |x: f64, y: f64| (x - y).abs() < ROUNDING;
    // First factor 0.9 · 0.5^(−1/5), second factor 0.9 · 0.25^(−0.14) 0.5^0.08.
    assert!(close(control.accepted(0.5), 0.9 * libm::pow(0.5, -0.2)));
    assert!(close(control.accepted(0.25), 0.9 * libm::pow(0.25, -0.14) * libm::pow(0.5, 0.08)));
    assert!(close(control.rejected(2.0), 0.9 * libm::pow(2.0, -0.2)));
    assert!(close(control.accepted(1e-3), 1.0), "no growth right after a rejection");
    assert!(close(control.accepted(0.0), 5.0));
    for hopeless in [1e9, f64::INFINITY, f64::NAN] {
        assert!(close(control.rejected(hopeless), 0.2), "{hopeless}");
    }
}

#[test]
fn sizes_weigh_the_components() {
    // In a unit 1024 times smaller, with sizes to match, the state has the same error size.
    let tableau = Tableau::dormand_prince();
    let norm = |scale: f64, sizes: &[f64]| {
        let mut problem = oscillator();
        let (y, mut scratch) = ([scale, 0.0], [0.0; 18]);
        tableau.stages(&mut problem, (0.0, 0.1), &y, false, &mut scratch).unwrap();
        let options = Options { relative: 0.0, absolute: 1e-8, sizes, ..Options::new(0.0) };
        tableau.error(&mut problem, 0.1, &y, (&options, &mut scratch)).unwrap()
    };
    let (plain, weighed) = (norm(1.0, &[]), norm(1024.0, &[1024.0, 1024.0]));
    assert!((plain / weighed - 1.0).abs() < ROUNDING, "{plain} {weighed}");
}

/// Oscillator y'' = −y, for any scalar.
struct Generic;
impl<T: Real> Rates<T> for Generic {
    type Error = Infallible;
    fn n(&self) -> usize {
        2
    }
    fn rates(&mut self, _: T, y: &[T], dy: &mut [T]) -> Result<(), Infallible> {
        dy[0] = y[1];
        dy[1] = -y[0];
        Ok(())
    }
}

#[test]
fn single_precision_reaches_its_own_tolerance() {
    let mut driver = Adaptive::<f32, _>::new(Tableau::dormand_prince(), 0.01);
    let (mut y, mut scratch) = ([1.0_f32, 0.0], [0.0; 18]);
    let work = (&mut y[..], &mut scratch[..]);
    driver
        .advance(&mut Generic, (0.0, 1.0), work, &Options::new(1e-5), |_, _, _| Ok(EndState::Kept))
        .unwrap();
    assert!(oscillator_error(1.0, &[y[0].into(), y[1].into()]) < 1e-5);
}
