//! Step control, tested on a planar pendulum of 1 kg and 1 m whose steps are solved by fixed-point iteration.

use mbs_core::control::*;
use mbs_core::inside::Steering;
use mbs_core::integrator::Integrator;
use mbs_core::step::{StepError, StepReport};

/// Acceleration of gravity [m/s²].
const G: f64 = 9.81;

/// Pendulum by angle and rate, stepped by the trapezoidal rule. A step longer than `fails_from` fails, and `event` is the time of
/// an event.
#[derive(Debug, Clone)]
struct Pendulum {
    t: f64,
    x: [f64; 2],
    saved: (f64, [f64; 2]),
    fails_from: f64,
    event: Option<f64>,
    /// Length of each trial, and whether it was accepted.
    trials: Vec<(f64, bool)>,
    /// Energy error that no step reduces [J].
    leak: f64,
    /// Acceleration energies at both ends of a step, as the pendulum reports them [J/s^2].
    accelerating: [f64; 2],
}

impl Pendulum {
    fn new(angle: f64) -> Self {
        let x = [angle, 0.0];
        let (fails_from, trials) = (f64::INFINITY, Vec::new());
        Self {
            t: 0.0,
            x,
            saved: (0.0, x),
            fails_from,
            event: None,
            trials,
            leak: 0.0,
            accelerating: [0.0; 2],
        }
    }

    fn acceleration(angle: f64) -> f64 {
        -G * libm::sin(angle)
    }

    fn energies(&self) -> [f64; 3] {
        let leaked = self.leak * f64::from(u32::from(self.t > 1.0));
        [0.5 * self.x[1] * self.x[1], -G * libm::cos(self.x[0]) + leaked, 0.0]
    }

    fn step(&mut self, h: f64) {
        let [q, v] = self.x;
        let a = Self::acceleration(q);
        let mut end = [q + h * v, v + h * a];
        for _ in 0..200 {
            let next = [q + 0.5 * h * (v + end[1]), v + 0.5 * h * (a + Self::acceleration(end[0]))];
            if next.map(f64::to_bits) == end.map(f64::to_bits) {
                break;
            }
            end = next;
        }
        (self.t, self.x) = (self.t + h, end);
    }

    fn invariant(&self) -> Invariant {
        Invariant::new(self.energies(), G, f64::EPSILON)
    }

    fn run(&mut self, rules: Rules<f64>, first: f64, end: f64) -> Vec<Accepted<f64>> {
        let (mut driver, mut invariant) = (Driver::new(rules, first), self.invariant());
        let mut steps = Vec::new();
        while self.t < end {
            let rest = end - self.t;
            let clock = (self.t, rest);
            let accepted = driver.step(self, &mut invariant, clock).expect("the pendulum steps");
            steps.push(accepted);
            if accepted.is_last {
                self.t = end;
            }
        }
        steps
    }
}

impl Stepper<f64> for Pendulum {
    fn attempt(&mut self, h: f64) -> Result<TrialStep<f64>, StepError> {
        self.trials.push((h, false));
        if h > self.fails_from {
            return Err(StepError::NotConverged { iterations: 1, correction: 1.0, unknown: 0 });
        }
        self.saved = (self.t, self.x);
        self.step(h);
        let error = LocalError::new(&Integrator::trapezoidal());
        let [from, to] = [self.saved.1[0], self.x[0]].map(Self::acceleration);
        let error = error.of(h, &[from], &[to]);
        let energies = self.energies();
        let report = StepReport::default();
        Ok(TrialStep { report, t: self.t, energies, error, acceleration_energy: self.accelerating })
    }

    fn undo(&mut self) {
        (self.t, self.x) = self.saved;
    }

    fn first_event(&mut self, h: f64) -> Option<Event> {
        let event = self.event?;
        let from = self.saved.0;
        let is_inside = from < event && self.t >= event;
        is_inside.then(|| Event {
            share: (event - from) / h,
            is_landed: self.t <= event + 1e-12,
            is_too_stiff: false,
            effect: 0,
        })
    }

    fn keep(&mut self, _: bool) {
        if let Some(last) = self.trials.last_mut() {
            last.1 = true;
        }
    }
}

fn energy(limits: [f64; 2]) -> Rules<f64> {
    Rules { max_step: 0.1, energy: Some(EnergyRule::new(limits)), error: None }
}

#[test]
fn a_rejected_step_leaves_no_trace() {
    let mut pendulum = Pendulum::new(2.5);
    pendulum.fails_from = 0.03;
    let steps = pendulum.run(energy([1e-6, 1e-8]), 0.1, 5.0);
    assert!(steps.iter().map(|s| s.rejected).sum::<u32>() > 2);
    // The accepted steps alone, repeated in their order, give a bitwise equal end.
    let mut replay = Pendulum::new(2.5);
    steps.iter().for_each(|s| replay.step(s.step));
    assert_eq!(replay.x.map(f64::to_bits), pendulum.x.map(f64::to_bits));
}

#[test]
fn every_kept_step_changes_the_invariant_by_less_than_its_limit_and_none_is_longer_than_the_largest()
 {
    let mut pendulum = Pendulum::new(3.0);
    let invariant = pendulum.invariant();
    let limits = [1e-5, 1e-7];
    let steps = pendulum.run(energy(limits), 0.1, 20.0);
    // The exchanged energy is at most twice that of a height of 2 m.
    let scale = 4.0 * G;
    assert!(steps.iter().all(|s| s.change.abs() <= limits[0] * scale + invariant.rounding()));
    // At 20 s the time resolves a step to a few units of its last digits.
    assert!(steps.iter().all(|s| s.step <= 0.1 + 1e-14));
    // The pendulum is slow at the top and fast at the bottom: the lengths of steps differ by a factor above three.
    let lengths = steps[1..steps.len() - 1].iter().map(|s| s.step);
    let (least, most) = lengths.fold((1.0_f64, 0.0_f64), |(a, b), h| (a.min(h), b.max(h)));
    assert!(most > 3.0 * least, "{least} {most}");
}

#[test]
fn accelerations_that_are_huge_at_one_end_loosen_no_limit_once_energy_moves() {
    let steps = |accelerating| {
        let mut pendulum = Pendulum { accelerating, ..Pendulum::new(3.0) };
        pendulum.run(energy([1e-5, 1e-7]), 0.1, 20.0)
    };
    let plain = steps([0.0; 2]);
    for accelerating in [[0.0, 1e12], [1e12, 0.0]] {
        let (first, limit) = (usize::from(accelerating[1] > 0.0), 1e-5 * 4.0 * G);
        let steps = steps(accelerating);
        // the first step begins at rest, and its measure is the acceleration energy at its end
        assert!(steps[first..].iter().all(|s| s.change.abs() <= limit), "{accelerating:?}");
        assert!(steps.len() + 10 > plain.len(), "{accelerating:?}: {}", steps.len());
    }
    assert!(steps([1e12; 2]).len() * 2 < plain.len(), "huge at both ends they do");
}

#[test]
fn tighter_limits_give_smaller_errors_in_both_forms_of_the_rule() {
    let worst = |rule: EnergyRule| {
        let mut pendulum = Pendulum::new(3.0);
        let rules = Rules { max_step: 0.1, energy: Some(rule), error: None };
        let steps = pendulum.run(rules, 0.01, 20.0);
        let sums = steps.iter().scan(0.0, |sum, s| {
            *sum += s.change;
            Some(f64::abs(*sum))
        });
        (sums.fold(0.0, f64::max), steps.len())
    };
    let limits = [[1e-4, 1e-6], [1e-5, 1e-7], [1e-6, 1e-8]];
    for form in [EnergyRule::new, EnergyRule::printed] {
        let errors = limits.map(|limits| worst(form(limits)).0);
        // The energy change goes with h^3, and the error with h^2: a tenth of the change gives 10^(2/3) = 4.6 times less error.
        assert!(errors[1] < errors[0] / 2.0 && errors[2] < errors[1] / 2.0, "{errors:?}");
    }
    // Steering within the limits reduces cost. At order two the measure of cost is the number of steps times the square root of the
    // error.
    let merit = |rule| {
        let (error, steps) = worst(rule);
        f64::sqrt(error) * f64::from(u32::try_from(steps).unwrap_or(u32::MAX))
    };
    let [steered, printed] =
        [EnergyRule::new(limits[1]), EnergyRule::printed(limits[1])].map(merit);
    assert!(steered < printed, "{steered} {printed}");
}

#[test]
fn true_error_falls_with_the_tolerance_of_the_estimate() {
    let end = |tolerance| {
        let mut pendulum = Pendulum::new(2.0);
        let rules = Rules { max_step: 0.5, energy: None, error: Some((tolerance, 3)) };
        pendulum.run(rules, 0.01, 3.0);
        pendulum.x[0]
    };
    let exact = end(1e-13);
    let errors = [1e-4, 1e-5, 1e-6, 1e-7].map(|tolerance| (end(tolerance) - exact).abs());
    // Order two, with a step that goes with the cube root of the tolerance: a tenth gives 4.6 times less error, here at least two.
    assert!(errors.windows(2).all(|e| e[1] < e[0] / 2.0), "{errors:?}");
}

#[test]
fn a_step_ends_at_an_event_and_the_next_is_as_long_as_planned() {
    let mut pendulum = Pendulum::new(1.0);
    pendulum.event = Some(0.73);
    let steps = pendulum.run(Rules { max_step: 0.1, energy: None, error: None }, 0.1, 1.0);
    let at = steps.iter().position(|s| s.limit == Limit::Event).expect("it lands");
    assert!((steps[at].attempt.t - 0.73).abs() < 1e-12);
    assert!((steps[at + 1].step - 0.1).abs() < 1e-12, "{}", steps[at + 1].step);
    assert_eq!(steps.iter().filter(|s| s.limit == Limit::Event).count(), 1);
}

#[test]
fn failures_shorten_the_step_and_it_grows_again() {
    let mut pendulum = Pendulum::new(1.0);
    pendulum.fails_from = 1e-3;
    let (mut driver, mut invariant) =
        (Driver::new(energy([1e-3, 1e-5]), 0.1), pendulum.invariant());
    let accepted = driver.step(&mut pendulum, &mut invariant, (0.5, 10.0)).expect("short enough");
    assert_eq!((accepted.rejected, accepted.limit), (4, Limit::Failure));
    assert!((accepted.step - 0.1 / 256.0).abs() < 1e-15);
    pendulum.fails_from = f64::INFINITY;
    let lengths: [f64; 12] = core::array::from_fn(|_| {
        driver.step(&mut pendulum, &mut invariant, (0.5, 10.0)).expect("it steps").step
    });
    // The step after a failure is not longer. Then it grows by a fifth at each step.
    assert!((lengths[0] / accepted.step - 1.0).abs() < 1e-12, "{lengths:?}");
    assert!(lengths.windows(2).all(|h| (h[1] / h[0] - 1.2).abs() < 1e-9), "{lengths:?}");
}

#[test]
fn a_run_whose_steps_would_never_end_says_so() {
    let mut pendulum = Pendulum::new(1.0);
    // No trial longer than this succeeds, so that two hundred thousand steps are needed for a largest step.
    pendulum.fails_from = 5e-7;
    let (mut driver, mut invariant) =
        (Driver::new(energy([1e-2, 1e-4]), 0.1), pendulum.invariant());
    let mut is_resumed = false;
    let error = loop {
        let clock = (pendulum.t, 10.0);
        if let Err(error) = driver.step(&mut pendulum, &mut invariant, clock) {
            break error;
        }
        assert!(pendulum.trials.len() <= 100_000 && pendulum.t < 0.1);
        if !is_resumed && pendulum.trials.len() > 50_000 {
            is_resumed = true;
            // A driver that is restored from its history continues the count.
            let history = driver.history();
            driver = Driver::new(energy([1e-2, 1e-4]), 0.1);
            assert!(driver.set_history(history));
        }
    };
    assert!(
        matches!(error, StepError::StepTooSmall { step } if step > 1e-7 && step < 5e-7),
        "the mean step: {error:?}"
    );
    assert!(is_resumed && pendulum.t > 0.01, "the state is the last accepted one");
    // Short steps at one place, such as an impact, do not count.
    let mut pendulum = Pendulum::new(1.0);
    pendulum.event = Some(0.35);
    assert!(pendulum.run(energy([1e-6, 1e-8]), 0.1, 2.0).len() > 20);
}

#[test]
fn what_no_step_can_mend_ends_in_a_typed_error() {
    let mut pendulum = Pendulum::new(1.0);
    pendulum.leak = 1.0;
    let (mut driver, mut invariant) =
        (Driver::new(energy([1e-6, 1e-8]), 0.1), pendulum.invariant());
    let error = loop {
        match driver.step(&mut pendulum, &mut invariant, (0.5, 10.0)) {
            Ok(_) => assert!(pendulum.t < 2.0, "the leak passed"),
            Err(error) => break error,
        }
    };
    assert!(
        matches!(error, StepError::StepTooSmall { step } if step > 0.0 && step < 1e-9),
        "{error:?}"
    );
    assert!(pendulum.t <= 1.0 + 1e-9, "the state is the last accepted one");
    let mut pendulum = Pendulum::new(1.0);
    pendulum.fails_from = 0.0;
    let error =
        Driver::new(energy([1e-6, 1e-8]), 0.1).step(&mut pendulum, &mut invariant, (0.0, 1.0));
    assert!(matches!(error, Err(StepError::NotConverged { .. })));
}

#[test]
fn the_factor_is_the_printed_one() {
    let rule = EnergyRule { exponent: 0.5, ..EnergyRule::printed([1e-5, 1e-7]) };
    // (0.8 * 1e-5 / 3.2e-5)^(1/2) = 1/2 [P2 (33)]
    let wish = Steering::new(rule).judge(3.2e-5).expect_err("above U");
    assert!((wish - 0.5).abs() < 1e-12);
    let mut steering = Steering::new(rule);
    assert_eq!(steering.judge(1e-6), Ok(1.0));
    // One small change may be a zero crossing. After the second the step grows, at most by a factor of two.
    assert_eq!([1e-8, 1e-8].map(|e| steering.judge(e)), [Ok(1.0), Ok(2.0)]);
    assert_eq!(steering.judge(f64::NAN), Err(0.2));
}

#[test]
fn drift_and_scatter_are_those_of_a_line_with_a_ripple() {
    let mut invariant = Invariant::new([1.0, 2.0, 0.0], 0.0, f64::EPSILON);
    for k in 1..=1000_u32 {
        let ripple = if k % 2 == 0 { 1e-3 } else { -1e-3 };
        invariant.mark(0.01 * f64::from(k), [1.0, 2.0 + 1e-4 * f64::from(k) + ripple, 0.0]);
    }
    // Drift of 1e-4 J in each 0.01 s, and a ripple of 2e-3 J up and down. The ripple tilts the fitted line by 6 / n^2 of its
    // height.
    assert!((invariant.drift() - 1e-2).abs() < 1e-6, "{}", invariant.drift());
    assert!((invariant.scatter() - 2e-3).abs() < 1e-5, "{}", invariant.scatter());
    assert!((invariant.error() - 0.101).abs() < 1e-12);
    assert!((invariant.max_error() - 0.101).abs() < 1e-12);
}

#[test]
fn the_alarm_hears_what_is_beyond_its_share_and_what_is_no_number_but_not_rounding() {
    let mut invariant = Invariant::new([0.0, 1e5, 0.0], 1e5, f64::EPSILON);
    // No energy is exchanged: 1e-4 J is a rounding error of 1e5 J.
    invariant.mark(0.1, [0.0, 1e5 + 1e-4, 0.0]);
    assert!(!invariant.is_off(0.1));
    // 10 J are exchanged, 2 J are lost.
    invariant.mark(0.2, [10.0, 1e5 - 12.0, 0.0]);
    assert!(invariant.is_off(0.1) && !invariant.is_off(0.3));
    invariant.mark(0.3, [f64::NAN, 1e5, 0.0]);
    invariant.mark(0.4, [10.0, 1e5 - 10.0, 0.0]);
    assert!(invariant.max_error().is_nan(), "it stays");
}

#[test]
fn the_estimate_is_the_error_of_a_short_step_in_every_integrator() {
    for integrator in [
        Integrator::trapezoidal(),
        Integrator::newmark(0.3025, 0.5),
        Integrator::generalised_alpha(0.8),
        Integrator::hht(0.05),
    ] {
        let estimate = LocalError::new(&integrator);
        assert_eq!(estimate.power(), 3);
        // q'' = -q from (1, 0.5). The auxiliary accelerations start on the exact solution, shifted in time.
        let h = 1e-3;
        let shift = (integrator.alpha_m - integrator.alpha_f) * h;
        let exact = |t: f64| libm::cos(t) + 0.5 * libm::sin(t);
        let rule = integrator.rule(h);
        let (dq, _, ap) = rule.predict(0.5, -1.0, -exact(shift));
        let d = -(ap + 1.0 + dq) / (1.0 + rule.acceleration);
        let (q, a) = (1.0 + dq + d, ap + rule.acceleration * d);
        let (of, error) = (estimate.of(h, &[-1.0], &[a]), (q - exact(h)).abs());
        // The relative size of the next term of the error is h.
        assert!((of / error - 1.0).abs() < 1e-2, "{integrator:?}: {of} {error}");
    }
    assert_eq!(LocalError::new(&Integrator::newmark(0.3025, 0.6)).power(), 2);
    // A NaN is kept, whatever numbers follow it.
    let of = |to: [f64; 2]| LocalError::new(&Integrator::trapezoidal()).of(1.0, &[0.0; 2], &to);
    assert!(of([f64::NAN, 1.0]).is_nan() && of([1.0, f64::NAN]).is_nan());
    let single = Integrator::<f32>::generalised_alpha(0.8);
    assert_eq!(LocalError::new(&single).power(), 3);
}
