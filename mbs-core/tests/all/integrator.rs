//! Order and equations of the implicit integration rules, tested on an oscillator.

use mbs_core::integrator::{Integrator, Rule};

/// Rounding error of one step on numbers of order one.
const ROUNDING: f64 = 1e-13;

/// Step of the oscillator: the correction that satisfies a = -q at the end follows from one linear equation.
fn step(rule: &Rule<f64>, q: f64, v: f64, a: f64, aux: f64) -> (f64, f64, f64, f64) {
    let (dq, vp, ap) = rule.predict(v, a, aux);
    let d = -(ap + q + dq) / (1.0 + rule.acceleration);
    let q = q + dq + d;
    (q, vp + rule.velocity * d, ap + rule.acceleration * d, aux + rule.auxiliary * d)
}

fn error_at_one(integrator: Integrator<f64>, n: u32) -> f64 {
    let rule = integrator.rule(1.0 / f64::from(n));
    let (mut q, mut v, mut a, mut aux) = (1.0, 0.0, -1.0, -1.0);
    for _ in 0..n {
        (q, v, a, aux) = step(&rule, q, v, a, aux);
    }
    (q - libm::cos(1.0)).abs().max((v + libm::sin(1.0)).abs())
}

#[test]
fn every_member_of_the_family_is_of_second_order_on_the_oscillator() {
    for integrator in [
        Integrator::trapezoidal(),
        Integrator::newmark(1.0 / 6.0, 0.5),
        Integrator::generalised_alpha(0.8),
        Integrator::generalised_alpha(1.0),
        Integrator::hht(0.05),
    ] {
        let ratio = error_at_one(integrator, 100) / error_at_one(integrator, 200);
        assert!((3.6..4.4).contains(&ratio), "{integrator:?}: error ratio {ratio}");
    }
}

#[test]
fn trapezoidal_rule_is_the_printed_one() {
    let rule = Integrator::trapezoidal().rule(0.1);
    let (q, v, a) = (1.0, 0.5, -1.0);
    let (q1, v1, a1, aux) = step(&rule, q, v, a, a);
    assert!((q1 - q - 0.05 * (v + v1)).abs() < ROUNDING);
    assert!((v1 - v - 0.05 * (a + a1)).abs() < ROUNDING);
    assert!((a1 - aux).abs() < ROUNDING);
}
